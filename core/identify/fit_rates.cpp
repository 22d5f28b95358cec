// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/fit_rates.hpp"

#include "base/format.hpp"
#include "core/identify/rated_law.hpp"
#include "core/identify/shear_forms.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace plyform {
namespace {

constexpr double least_ratio = 2.0;   // of speeds
constexpr double least_warming = 3.0; // K, of temperatures that E can be found from
constexpr int most_viscous = 3;

std::vector<double> elastic_of(const RatedLaw& s, const RatedRows& all) {
  return unscaled(s.fit.k.head(s.size.elastic), all.end);
}

std::vector<double> viscous_of(const Eigen::VectorXd& k, const RatedRows& all) {
  std::vector<double> c;
  for (Eigen::Index i = 0; i < k.size(); ++i)
    c.push_back(k[i] / all.rate / std::pow(all.end, static_cast<double>(2 * i)));
  return c;
}

/// The least viscosity over the angles, over that at the largest.
bool viscosity_holds(const RatedLaw& s) {
  const auto at = [&](double u) {
    double sum = 0.0;
    for (int c = 0; c < s.size.viscous; ++c)
      sum += s.fit.k[s.size.elastic + c] * std::pow(u, 2 * c);
    return sum;
  };
  for (int i = 0; i <= 20; ++i)
    if (!(at(0.05 * i) > 0.0)) return false;
  return true;
}

bool torque_rises(const RatedLaw& s, const RatedRows& all) {
  const ShearLaw law{elastic_of(s, all), {}, {}};
  return invalid_at(law, 0.0, all.end) > all.end;
}

/// Fewer elastic coefficients where the torque of more falls, unless their number was asked for.
RatedLaw solve_rising(const RatedRows& all, RatedSize size, bool fixed, FlowForm form) {
  RatedLaw s = solve_rated(all, size, form);
  while (!fixed && size.elastic > 1 && !torque_rises(s, all)) {
    --size.elastic;
    s = solve_rated(all, size, form);
  }
  return s;
}

/// The numbers of coefficients.
RatedLaw chosen_size(const RatedRows& all, const FitOptions& options, int viscous, FlowForm form,
                     std::string& why) {
  const bool fixed = options.coefficients > 0;
  const int elastic = fixed ? options.coefficients : 3;
  RatedLaw s = solve_rising(all, {elastic, viscous > 0 ? viscous : 1}, fixed, form);
  why = viscous > 0 ? "as asked for" : "a viscosity of one number explains the rows as well";
  if (viscous > 0) return s;
  for (int more = 2; more <= most_viscous; ++more) {
    RatedLaw next = solve_rising(all, {elastic, more}, fixed, form);
    const double freedom = freedom_of(next.fit.residuals, next.unknowns());
    const double chance = chance_of_gain(s.fit.squares, next.fit.squares, freedom);
    if (!(chance < by_chance) || !viscosity_holds(next)) break;
    s = std::move(next);
    why = fmt::format("a viscosity that depends on the angle: chance would gain as much once in "
                      "{:.0f}",
                      std::min(1e9, 1.0 / std::max(chance, 1e-9)));
  }
  return s;
}

/// Root mean square of the residuals over the weights' floors.
double rms_of(const RatedLaw& law) {
  return std::sqrt(law.fit.squares / static_cast<double>(law.fit.residuals.size()));
}

/// The form of f(T), unless it is asked for: Arrhenius, or the two constants of WLF where chance
/// would hardly gain as much. The size is that which one temperature by itself each asks for, so
/// that it does not make up for a form that does not fit.
RatedLaw chosen(const RatedRows& all, const FitOptions& options, const RatedOptions& rated,
                RatesFit& fit) {
  const RatedLaw each = chosen_size(all, options, rated.viscous, FlowForm::table, fit.why);
  if (!all.warm) return each;
  const auto of = [&](FlowForm form) {
    RatedLaw law = solve_rated(all, each.size, form);
    fit.tried.push_back({form, rms_of(law)});
    return law;
  };
  fit.tried.push_back({FlowForm::table, rms_of(each)});
  RatedLaw arrhenius = of(FlowForm::arrhenius);
  const bool bear_two = each.flow.temperatures().size() > 2;
  RatedLaw wlf = bear_two ? of(FlowForm::wlf) : arrhenius;
  fit.flow_why = "as asked for";
  if (rated.form == FlowForm::table) return each;
  if (rated.form == FlowForm::wlf) return wlf;
  if (rated.form == FlowForm::arrhenius) return arrhenius;
  fit.flow_why = bear_two ? "the two constants of WLF gain no more than chance"
                          : "two temperatures bear no other form";
  if (!bear_two) return arrhenius;
  const double chance = chance_of_gain(arrhenius.fit.squares, wlf.fit.squares,
                                       freedom_of(wlf.fit.residuals, wlf.unknowns()));
  if (!(chance < by_chance)) return arrhenius;
  fit.flow_why = fmt::format("chance would gain as much over Arrhenius once in {:.0f}",
                             std::min(1e9, 1.0 / std::max(chance, 1e-9)));
  return wlf;
}

bool check_speeds(const std::vector<RatedCurve>& curves, Diagnostics& diagnostics) {
  double least = curves.front().speed, most = least;
  for (const RatedCurve& one : curves)
    least = std::min(least, one.speed), most = std::max(most, one.speed);
  if (most >= least_ratio * least) return true;
  diagnostics.error(place_of(curves.front().curve), "--speeds", fmt::format("{:g}", least),
                    fmt::format("speeds up to {:g} mm/s: they must differ by a factor of {:g} at "
                                "least, or nothing tells viscous from elastic torque",
                                most, least_ratio),
                    "add a test that is slower or faster, best by ten times");
  return false;
}

/// A form that is asked for, and temperatures enough to find it.
bool check_temperatures(const std::vector<RatedCurve>& curves, FlowForm form,
                        Diagnostics& diagnostics) {
  std::vector<double> apart; // degC
  std::vector<double> all;
  for (const RatedCurve& one : curves)
    if (one.temperature) all.push_back(*one.temperature);
  std::sort(all.begin(), all.end());
  for (const double celsius : all)
    if (apart.empty() || celsius - apart.back() >= least_warming) apart.push_back(celsius);
  const std::size_t needed = form == FlowForm::none ? 0 : form == FlowForm::wlf ? 3 : 2;
  if (apart.size() >= needed) return true;
  diagnostics.error(
      place_of(curves.front().curve), "--temperature-law", "",
      fmt::format("needs tests at {} temperatures that are {:g} K apart", needed, least_warming),
      "add tests, give --temperatures, or leave the form out");
  return false;
}

std::optional<RatedRows> rows_of(const std::vector<RatedCurve>& curves, const ShearTest& test,
                                 const Fabric& fabric, FitOptions options,
                                 std::vector<Corrected>& corrected, Diagnostics& diagnostics) {
  options.flows = true;
  RatedRows all;
  std::vector<std::size_t> count;
  double log_rates = 0.0, coldest = 1e9, hottest = -1e9;
  for (const RatedCurve& one : curves) {
    const auto specimen = shear_specimen(one.curve, test, fabric, options, diagnostics);
    if (!specimen) return std::nullopt;
    corrected.push_back(specimen->corrected);
    const double floor = load_floor * specimen->rows.y.maxCoeff();
    for (Eigen::Index i = 0; i < specimen->rows.x.size(); ++i) {
      RatedRow row{};
      row.extension = specimen->rows.x[i], row.measured = specimen->rows.y[i];
      row.weights = torque_weights(test, fabric, row.extension);
      row.angle = row.weights.angle;
      row.rate = one.speed * 2.0 * (1.0 + row.extension / test.diagonal) /
                 (test.diagonal * std::cos(row.angle)); // (b)
      row.temperature = one.temperature.value_or(0.0);
      row.floor = floor, row.specimen = count.size();
      log_rates += std::log(row.rate);
      all.end = std::max(all.end, row.angle);
      all.rows.push_back(row);
    }
    all.temperatures.push_back(one.temperature.value_or(0.0));
    coldest = std::min(coldest, one.temperature.value_or(0.0));
    hottest = std::max(hottest, one.temperature.value_or(0.0));
    count.push_back(static_cast<std::size_t>(specimen->rows.x.size()));
  }
  const double n = static_cast<double>(all.rows.size());
  for (RatedRow& row : all.rows)
    row.share = std::sqrt(n / static_cast<double>(count.size() * count[row.specimen]));
  all.rate = std::exp(log_rates / n);
  all.reference = curves.front().temperature.value_or(0.0);
  all.warm = hottest - coldest >= least_warming;
  return all;
}

/// Fills what is told of each specimen.
void add_specimens(const std::vector<RatedCurve>& curves, const RatedRows& all, const RatedLaw& s,
                   RatesFit& fit) {
  const Eigen::VectorXd viscous = s.viscous_load();
  double fastest = 0.0;
  for (std::size_t p = 0; p < curves.size(); ++p) {
    std::vector<double> angle, measured, fitted;
    double rates = 0.0, excess = 0.0, flow = 0.0, load = 0.0;
    for (std::size_t i = 0; i < all.rows.size(); ++i) {
      if (all.rows[i].specimen != p) continue;
      const auto r = static_cast<Eigen::Index>(i);
      angle.push_back(all.rows[i].angle), measured.push_back(all.rows[i].measured);
      fitted.push_back(fit.fitted[i]), rates += all.rows[i].rate;
      excess += all.rows[i].measured - (fit.fitted[i] - viscous[r]);
      flow += viscous[r], load += fit.fitted[i];
    }
    const double mean = rates / static_cast<double>(angle.size());
    fit.specimens.push_back({curves[p].curve.file, curves[p].speed, mean, curves[p].temperature,
                             quality_of(angle, measured, fitted), excess / flow});
    if (mean > fastest) fastest = mean, fit.viscous_share = flow / load;
  }
}

void put_flow(const RatedLaw& s, const Eigen::VectorXd& limits, RatesFit& fit) {
  const Eigen::VectorXd numbers = s.flow.numbers(s.p);
  fit.form = s.flow.form();
  fit.flow.assign(numbers.begin(), numbers.end());
  fit.flow_limits.assign(limits.begin(), limits.end());
  for (const double celsius : s.flow.temperatures())
    if (fit.form != FlowForm::none) fit.factors.push_back({celsius, s.flow.factor(s.p, celsius)});
}

void fill(const std::vector<RatedCurve>& curves, const RatedRows& all, const RatedLaw& s,
          RatesFit& fit) {
  fit.elastic = elastic_of(s, all);
  fit.viscous = viscous_of(s.fit.k.tail(s.size.viscous), all);
  const Eigen::VectorXd limits = limits_of(all, s);
  fit.elastic_limits = unscaled(limits.head(s.size.elastic), all.end);
  fit.viscous_limits = viscous_of(limits.segment(s.size.elastic, s.size.viscous), all);
  fit.reference = curves.front().temperature;
  put_flow(s, limits.tail(s.p.size()), fit);
  const Eigen::VectorXd fitted = s.a * s.fit.k;
  fit.rates = {all.rows.front().rate, all.rows.front().rate};
  fit.temperatures = {all.rows.front().temperature, all.rows.front().temperature};
  for (std::size_t i = 0; i < all.rows.size(); ++i) {
    const RatedRow& row = all.rows[i];
    fit.extension.push_back(row.extension), fit.angle.push_back(row.angle);
    fit.rate.push_back(row.rate), fit.measured.push_back(row.measured);
    fit.fitted.push_back(fitted[static_cast<Eigen::Index>(i)]);
    fit.specimen.push_back(row.specimen);
    fit.rates = {std::min(fit.rates[0], row.rate), std::max(fit.rates[1], row.rate)};
    fit.temperatures = {std::min(fit.temperatures[0], row.temperature),
                        std::max(fit.temperatures[1], row.temperature)};
  }
  add_specimens(curves, all, s, fit);
  // of each row over its own specimen's floor
  double squares = 0.0;
  fit.quality = quality_of(fit.angle, fit.measured, fit.fitted);
  fit.quality.largest = 0.0;
  for (std::size_t i = 0; i < all.rows.size(); ++i) {
    const double residual =
        std::abs(fit.measured[i] - fit.fitted[i]) / std::max(fit.fitted[i], all.rows[i].floor);
    squares += residual * residual;
    if (residual > fit.quality.largest)
      fit.quality.largest = residual, fit.quality.largest_at = fit.angle[i];
  }
  fit.quality.rms = std::sqrt(squares / static_cast<double>(all.rows.size()));
}

/// A viscosity that the rows bear.
bool check_law(const RatedRows& all, const RatedLaw& s, const std::vector<RatedCurve>& curves,
               Diagnostics& diagnostics) {
  const Place at = place_of(curves.front().curve);
  if (!viscosity_holds(s)) {
    diagnostics.error(at, "viscosity", "",
                      "comes out negative: faster tests have smaller loads somewhere",
                      "check that --speeds (mm/s) and --temperatures stand in the order of the "
                      "curves; end the curves with --to where loads of different speeds cross");
    return false;
  }
  if (torque_rises(s, all)) return true;
  diagnostics.error(at, "shear", "", "the elastic torque falls within the range",
                    "ask for fewer --coefficients, or end the curves with --to");
  return false;
}

} // namespace

std::optional<RatesFit> identify_rates(const std::vector<RatedCurve>& curves, const ShearTest& test,
                                       const Fabric& fabric, const FitOptions& options,
                                       const RatedOptions& rated, Diagnostics& diagnostics) {
  if (curves.empty() || rated.viscous < 0 || rated.viscous > most_viscous)
    throw std::invalid_argument("no curves, or a viscosity of no size");
  if (!check_speeds(curves, diagnostics) || !check_temperatures(curves, rated.form, diagnostics))
    return std::nullopt;
  std::vector<Corrected> corrected;
  const auto all = rows_of(curves, test, fabric, options, corrected, diagnostics);
  if (!all) return std::nullopt;
  RatesFit fit;
  const RatedLaw s = chosen(*all, options, rated, fit);
  if (!check_law(*all, s, curves, diagnostics)) return std::nullopt;
  fill(curves, *all, s, fit);
  fit.corrected = std::move(corrected);
  const std::string where = fmt::format("{:.3g} degrees", fit.quality.largest_at / degree);
  if (!check_quality(curves.front().curve, fit.quality, where,
                     "the torque does not rise in proportion to the rate, or the curves have "
                     "disturbances: see what each curve has",
                     diagnostics))
    return std::nullopt;
  return fit;
}

} // namespace plyform
