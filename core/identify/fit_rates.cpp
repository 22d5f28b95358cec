// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/fit_rates.hpp"

#include "core/identify/shear_forms.hpp"
#include "core/model/temperature.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace plyform {
namespace {

constexpr double least_ratio = 2.0;   // of speeds
constexpr double least_warming = 3.0; // K, of temperatures that E can be found from
constexpr double most_energy = 4e5;   // J/mol
constexpr double rated_gain = 1e-3;   // of one coefficient more
constexpr int most_viscous = 3;

/// One row of one specimen.
struct RatedRow {
  double extension, angle, rate, measured; ///< mm, rad, 1/s, N
  TorqueWeights weights;
  double temperature = 0.0;        ///< degC
  double share = 1.0, floor = 0.0; ///< of weights: of its specimen; N
  std::size_t specimen = 0;
};

struct RatedRows {
  std::vector<RatedRow> rows;
  double end = 0.0;       ///< rad, the largest angle
  double rate = 1.0;      ///< 1/s, by which viscous columns are scaled
  double reference = 0.0; ///< degC
  bool warm = false;      ///< whether E is looked for
};

struct Size {
  int elastic, viscous;
};

/// f(T) of a row.
double factor_of(const RatedRows& all, const RatedRow& row, double energy) {
  return all.warm ? TemperatureFactor(ArrheniusFactor{energy, all.reference}).at(row.temperature)
                  : 1.0;
}

/// (40, 41) of (R): elastic columns, then viscous ones.
Eigen::MatrixXd columns_of(const RatedRows& all, const Size& size, double energy) {
  Eigen::MatrixXd a(static_cast<Eigen::Index>(all.rows.size()), size.elastic + size.viscous);
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    const RatedRow& row = all.rows[static_cast<std::size_t>(i)];
    const double u = row.angle / all.end, whole = row.weights.whole, half = row.weights.half;
    for (int c = 0; c < size.elastic; ++c)
      a(i, c) = whole * std::pow(u, 2 * c + 1) + half * std::pow(0.5 * u, 2 * c + 1);
    const double rate = factor_of(all, row, energy) * row.rate / all.rate;
    for (int c = 0; c < size.viscous; ++c)
      a(i, size.elastic + c) =
          rate * (whole * std::pow(u, 2 * c) + 0.5 * half * std::pow(0.5 * u, 2 * c));
  }
  return a;
}

Eigen::VectorXd measured_of(const RatedRows& all) {
  Eigen::VectorXd y(static_cast<Eigen::Index>(all.rows.size()));
  for (Eigen::Index i = 0; i < y.size(); ++i)
    y[i] = all.rows[static_cast<std::size_t>(i)].measured;
  return y;
}

Eigen::ArrayXd weights_by(const RatedRows& all, const Eigen::VectorXd& fitted) {
  Eigen::ArrayXd w(fitted.size());
  for (Eigen::Index i = 0; i < w.size(); ++i) {
    const RatedRow& row = all.rows[static_cast<std::size_t>(i)];
    w[i] = row.share / std::max(fitted[i], row.floor);
  }
  return w;
}

/// The law of a size, with E if that is looked for.
struct Solution {
  Size size{};
  double energy = 0.0;
  FixedFit fit;
  Eigen::MatrixXd a;
  Eigen::ArrayXd weights;
};

Solution solve(const RatedRows& all, const Size& size) {
  const Eigen::VectorXd measured = measured_of(all);
  Solution s{size, 0.0, {}, {}, weights_by(all, measured)};
  constexpr int repeats = 12; // weights follow the fitted loads
  for (int i = 0; i < repeats; ++i) {
    const auto squares = [&](double energy) {
      return fit_fixed(columns_of(all, size, energy), measured, s.weights).squares;
    };
    if (all.warm) s.energy = minimum_of(squares, 0.0, most_energy);
    s.a = columns_of(all, size, s.energy);
    s.fit = fit_fixed(s.a, measured, s.weights);
    const Eigen::ArrayXd before = s.weights;
    s.weights = weights_by(all, s.a * s.fit.k);
    if (((s.weights - before) / before).abs().maxCoeff() < 1e-6) break;
  }
  return s;
}

std::vector<double> elastic_of(const Solution& s, const RatedRows& all) {
  return unscaled(s.fit.k.head(s.size.elastic), all.end);
}

std::vector<double> viscous_of(const Eigen::VectorXd& k, const RatedRows& all) {
  std::vector<double> c;
  for (Eigen::Index i = 0; i < k.size(); ++i)
    c.push_back(k[i] / all.rate / std::pow(all.end, static_cast<double>(2 * i)));
  return c;
}

/// The least viscosity over the angles, over that at the largest.
bool viscosity_holds(const Solution& s) {
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

bool torque_rises(const Solution& s, const RatedRows& all) {
  const ShearLaw law{elastic_of(s, all), {}, {}};
  return invalid_at(law, 0.0, all.end) > all.end;
}

/// Fewer elastic coefficients where the torque of more falls, unless their number was asked for.
Solution solve_rising(const RatedRows& all, Size size, bool fixed) {
  Solution s = solve(all, size);
  while (!fixed && size.elastic > 1 && !torque_rises(s, all)) {
    --size.elastic;
    s = solve(all, size);
  }
  return s;
}

Solution chosen(const RatedRows& all, const FitOptions& options, int viscous, std::string& why) {
  const bool fixed = options.coefficients > 0;
  const int elastic = fixed ? options.coefficients : 3;
  Solution s = solve_rising(all, {elastic, viscous > 0 ? viscous : 1}, fixed);
  why = viscous > 0 ? "as asked for" : "a viscosity of one number explains the rows as well";
  if (viscous > 0) return s;
  for (int more = 2; more <= most_viscous; ++more) {
    Solution next = solve_rising(all, {elastic, more}, fixed);
    const double freedom =
        freedom_of(next.fit.residuals, next.size.elastic + next.size.viscous + all.warm);
    const double chance = chance_of_gain(s.fit.squares, next.fit.squares, freedom);
    if (!(chance < rated_gain) || !viscosity_holds(next)) break;
    s = std::move(next);
    why = fmt::format("a viscosity that depends on the angle: chance would gain as much once in "
                      "{:.0f}",
                      std::min(1e9, 1.0 / std::max(chance, 1e-9)));
  }
  return s;
}

/// Of all coefficients and E, by the rows' residuals.
Eigen::VectorXd limits_of(const RatedRows& all, const Solution& s) {
  const Eigen::Index n = s.a.cols() + (all.warm ? 1 : 0);
  Eigen::MatrixXd a(s.a.rows(), n);
  a.leftCols(s.a.cols()) = s.a;
  if (all.warm) {
    const double step = 10.0; // J/mol
    a.col(n - 1) =
        (columns_of(all, s.size, s.energy + step) - columns_of(all, s.size, s.energy - step)) *
        s.fit.k / (2.0 * step);
  }
  const Eigen::MatrixXd w = s.weights.matrix().asDiagonal() * a;
  const double freedom = freedom_of(s.fit.residuals, n, freedom_of_limits);
  const Eigen::MatrixXd inverse =
      (w.transpose() * w).completeOrthogonalDecomposition().pseudoInverse();
  return student_95(freedom) *
         (inverse.diagonal() * (s.fit.squares / freedom)).cwiseMax(0.0).cwiseSqrt();
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
void add_specimens(const std::vector<RatedCurve>& curves, const RatedRows& all, const Solution& s,
                   RatesFit& fit) {
  const Eigen::VectorXd viscous = s.a.rightCols(s.size.viscous) * s.fit.k.tail(s.size.viscous);
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

RatesFit fit_of(const std::vector<RatedCurve>& curves, const RatedRows& all, const Solution& s) {
  RatesFit fit;
  fit.elastic = elastic_of(s, all);
  fit.viscous = viscous_of(s.fit.k.tail(s.size.viscous), all);
  const Eigen::VectorXd limits = limits_of(all, s);
  fit.elastic_limits = unscaled(limits.head(s.size.elastic), all.end);
  fit.viscous_limits = viscous_of(limits.segment(s.size.elastic, s.size.viscous), all);
  fit.reference = curves.front().temperature;
  if (all.warm) {
    fit.activation_energy = s.energy;
    fit.activation_limits = limits[limits.size() - 1];
  }
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
  return fit;
}

/// A viscosity that the rows bear.
bool check_law(const RatedRows& all, const Solution& s, const std::vector<RatedCurve>& curves,
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
                                       const Fabric& fabric, const FitOptions& options, int viscous,
                                       Diagnostics& diagnostics) {
  if (curves.empty() || viscous < 0 || viscous > most_viscous)
    throw std::invalid_argument("no curves, or a viscosity of no size");
  if (!check_speeds(curves, diagnostics)) return std::nullopt;
  std::vector<Corrected> corrected;
  const auto all = rows_of(curves, test, fabric, options, corrected, diagnostics);
  if (!all) return std::nullopt;
  std::string why;
  const Solution s = chosen(*all, options, viscous, why);
  if (!check_law(*all, s, curves, diagnostics)) return std::nullopt;
  RatesFit fit = fit_of(curves, *all, s);
  fit.why = why;
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
