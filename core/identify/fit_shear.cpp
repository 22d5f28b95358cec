// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/fit_shear.hpp"

#include "base/format.hpp"
#include "core/identify/choose_shear.hpp"
#include "core/identify/shear_checks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace plyform {
namespace {

void check_options(const Fabric& fabric, const FitOptions& options) {
  if (options.coefficients < 0 || options.coefficients > 6)
    throw std::invalid_argument("coefficients must be 1 to 6, or 0 to have them chosen");
  if (options.points < 0 || options.points > most_table_points)
    throw std::invalid_argument("points must be 1 to 20, or 0 to have them chosen");
  if (!(options.from >= 0.0 && options.to > options.from))
    throw std::invalid_argument("the range must start at 0 or above and end above its start");
  if (!is_biaxial(fabric) ||
      std::abs(material_axes(fabric).between() - 0.5 * std::numbers::pi) > 1e-6)
    throw std::invalid_argument("the theory of the shear tests needs fibres at 90 degrees");
}

CurveWords words_of(const FitOptions& options) {
  CurveWords words;
  words.length_unit = "mm";
  words.x_is_length = words.can_stretch = !options.measured_angle;
  if (!options.measured_angle) words.angle_remedy = ", or --angle-column of a measured shear angle";
  return words;
}

/// What rows can show beside a law that is no polynomial.
void narrow(CurveWords& words, const ShearSolution& s, const ShearSpecimen& specimen) {
  if (s.form.kind == ShearFormKind::polynomial) return;
  words.zeros_show = specimen.angle.front() < near_zero;
  words.toe_shows = false;
  words.stiff_start = true;
  if (s.form.kind == ShearFormKind::table) words.can_stretch = false;
}

/// The law of one specimen; reports errors and returns nothing as identify_shear does.
std::optional<SpecimenLaw> law_of_specimen(const ShearSpecimen& specimen, const ShearTest& test,
                                           const Fabric& fabric, const FitOptions& options,
                                           const LawChoice& choice, ShearFit& result,
                                           Diagnostics& diagnostics) {
  const Curve& curve = specimen.curve;
  const double end = specimen.angle.back();
  const ShearSolution s =
      solve_shear(choice.form, specimen.rows, end, test, fabric, knots_to(choice.knots, end));
  LoadRows rows = specimen.rows;
  rows.weights = s.fit.weights;
  CurveWords words = words_of(options);
  narrow(words, s, specimen);
  if (!check_disturbances(curve, s.law, rows, options, words, diagnostics)) return std::nullopt;
  SpecimenLaw law{curve.file, s.numbers(), {}, specimen.corrected, {}};
  law.quality =
      quality_of(specimen.angle, {rows.y.begin(), rows.y.end()}, fitted_loads(s, test, rows.x));
  const TorqueMisfit misfit = torque_misfit(s, rows, test);
  law.quality.misfit = misfit.misfit;
  law.quality.noise = misfit.noise;
  const bool polynomial = s.form.kind == ShearFormKind::polynomial;
  const bool suspect = !polynomial || (options.coefficients == 0 && misfit.misfit > noisy);
  if (suspect && !check_rows_rise(curve, specimen, misfit, options, diagnostics))
    return std::nullopt;
  const bool good = check_misfit(
      curve, law.quality,
      polynomial ? "check columns and specimen, smooth the curve, take more --coefficients, or "
                   "leave out slipping and wrinkling with --to"
                 : "check columns and specimen, smooth the curve, or leave out slipping and "
                   "wrinkling with --to",
      diagnostics);
  if (!good || !check_rises(curve, s, law.quality, diagnostics) ||
      !check_usual_torque(curve, s.fabric, law.quality.to, options.doubtful, diagnostics))
    return std::nullopt;
  law.sensitive = sensitivities(s.law, rows, words.length, common_compliance);
  warn_of_unknowns(curve, s.law, rows, law.sensitive, options, words, diagnostics);
  warn_of_hidden(specimen, s, test, law.sensitive, options, diagnostics);
  result.of_specimen.push_back(s.shear());
  return law;
}

/// The rows of all specimens, told in the result.
LoadRows put_rows(const std::vector<ShearSpecimen>& specimens, ShearFit& result) {
  for (std::size_t n = 0; n < specimens.size(); ++n) {
    result.angle.insert(result.angle.end(), specimens[n].angle.begin(), specimens[n].angle.end());
    result.specimen.insert(result.specimen.end(), specimens[n].angle.size(), n);
  }
  LoadRows rows = rows_together(specimens);
  result.extension.assign(rows.x.begin(), rows.x.end());
  result.measured.assign(rows.y.begin(), rows.y.end());
  return rows;
}

/// Limits of the numbers of one specimen's law, and of the law.
void judge_one(const ShearSolution& all, const ShearSpecimen& only, const Corrections& corrections,
               ShearFit& result) {
  const LinearFit fit = with_found(all.fit, all.law, only.rows, corrections, only.corrected);
  result.confidence = confidence_of(fit, all.law.probes, probe_angles(all.scale));
  std::vector<double>& limits = result.confidence.coefficient;
  if (all.form.kind == ShearFormKind::table) {
    const Eigen::VectorXd points = limits_of_values(fit, all.at_points);
    limits = {points.begin(), points.end()};
    return;
  }
  for (std::size_t c = 0; c < all.polynomial.size(); ++c)
    limits[c] /= std::pow(all.scale, static_cast<double>(2 * c + 1));
}

/// The same between specimens, and their scatter: laws are compared up to where the first ends, the
/// points of a table up to there too (beyond: not a number).
void judge_several(const ShearSolution& all, const std::vector<ShearSpecimen>& specimens,
                   ShearFit& result) {
  const bool table = all.form.kind == ShearFormKind::table;
  double shortest = all.scale;
  for (const ShearSpecimen& specimen : specimens)
    if (all.form.kind != ShearFormKind::polynomial)
      shortest = std::min(shortest, specimen.angle.back());
  const std::vector<double> places = probe_angles(shortest);
  std::vector<Eigen::VectorXd> laws, numbers;
  for (std::size_t n = 0; n < specimens.size(); ++n) {
    const ShearLaw& own = result.of_specimen[n];
    Eigen::VectorXd law(static_cast<Eigen::Index>(places.size()));
    for (Eigen::Index i = 0; i < law.size(); ++i)
      law[i] = own.at(places[static_cast<std::size_t>(i)]).value;
    laws.push_back(law);
    std::vector<double> own_numbers = result.specimens[n].coefficients;
    if (table) {
      own_numbers.clear();
      for (std::size_t i = 1; i < result.law.angle.size(); ++i)
        own_numbers.push_back(result.law.angle[i] <= shortest * (1.0 + 1e-9)
                                  ? own.at(result.law.angle[i]).value
                                  : std::numeric_limits<double>::quiet_NaN());
    }
    numbers.push_back(vector_of(own_numbers));
  }
  const auto same = [](const std::vector<Eigen::VectorXd>& of) {
    return Eigen::MatrixXd(Eigen::MatrixXd::Identity(of.front().size(), of.front().size()));
  };
  result.scatter = scatter_of(laws, same(laws), places);
  result.confidence = confidence_between(laws, same(laws), places);
  const std::vector<double> nowhere(static_cast<std::size_t>(numbers.front().size()), 0.0);
  result.scatter.coefficient = scatter_of(numbers, same(numbers), nowhere).coefficient;
  result.confidence.coefficient = confidence_between(numbers, same(numbers), nowhere).coefficient;
}

/// Whether a polynomial of 3 follows the rows once corrections that are looked for are taken off
/// with it.
bool polynomial_does(const Curve& curve, const ShearTest& test, const Fabric& fabric,
                     const FitOptions& options) {
  Diagnostics quiet;
  const auto corrected = shear_specimen(curve, test, fabric, options, quiet);
  if (!corrected) return false;
  const double end = corrected->angle.back();
  const ShearSolution s = solve_shear({}, corrected->rows, end, test, fabric);
  const TorqueMisfit misfit = torque_misfit(s, corrected->rows, test);
  return invalid_at(s.shear(), 0.0, end) > end &&
         misfit.misfit <= std::max(noisy, 2.0 * misfit.noise);
}

/// The law that corrections which are looked for are to fit, where the rows have another than a
/// polynomial of 3, with them and without.
std::optional<LinearLaw> law_before_corrections(const Curve& curve, const ShearTest& test,
                                                const Fabric& fabric, FitOptions options) {
  Corrections& c = options.corrections;
  if (!c.any_fit() || options.coefficients > 0 || polynomial_does(curve, test, fabric, options))
    return std::nullopt;
  const bool zero = c.fit_load_zero;
  if (zero && curve.size() > 0) { // roughly: the form must not hang on it
    const auto first = std::min_element(curve.x.begin(), curve.x.end()) - curve.x.begin();
    c.load_zero = curve.y[static_cast<std::size_t>(first)];
  }
  c.fit_load_zero = c.fit_toe = c.fit_slip = false;
  Diagnostics quiet; // what is wrong with the rows is reported when they are corrected
  const auto before = shear_specimen(curve, test, fabric, options, quiet);
  if (!before || (zero && before->angle.front() > near_zero))
    return std::nullopt; // no row tells a static torque from a zero: the user says that it is this
  const double end = before->angle.back();
  const LawChoice choice = choose_shear({*before}, end, test, fabric, options, words_of(options));
  if (choice.form == ShearForm{}) return std::nullopt;
  return solve_shear(choice.form, before->rows, end, test, fabric, choice.knots).law;
}

/// The law of all rows and how well it does.
bool put_law(const ShearSolution& all, const LoadRows& rows,
             const std::vector<ShearSpecimen>& specimens, const ShearTest& test,
             const FitOptions& options, ShearFit& result, Diagnostics& diagnostics) {
  result.law = all.shear();
  result.static_torque = all.static_torque;
  result.static_angle = all.static_angle;
  result.polynomial = all.polynomial;
  result.in_plane = all.share;
  result.fitted = fitted_loads(all, test, rows.x);
  result.quality = quality_of(result.angle, result.measured, result.fitted);
  for (const ShearSpecimen& specimen : specimens) {
    const TorqueMisfit own = torque_misfit(all, specimen.rows, test);
    const double n = static_cast<double>(specimens.size());
    result.quality.misfit = std::hypot(result.quality.misfit, own.misfit / std::sqrt(n));
    result.quality.noise = std::hypot(result.quality.noise, own.noise / std::sqrt(n));
  }
  const Curve& first = specimens.front().curve;
  warn_of_layers(first, result.in_plane, diagnostics);
  if (specimens.size() == 1) {
    judge_one(all, specimens.front(), options.corrections, result);
    return true;
  }
  if (!check_rises(first, all, result.quality, diagnostics)) return false;
  judge_several(all, specimens, result);
  return true;
}

} // namespace

std::optional<ShearFit> identify_shear(const std::vector<Curve>& curves, const ShearTest& test,
                                       const Fabric& fabric, const FitOptions& options,
                                       Diagnostics& diagnostics) {
  check_options(fabric, options);
  ShearFit result;
  std::vector<ShearSpecimen> specimens;
  const std::size_t errors = diagnostics.errors.size();
  for (const Curve& curve : curves)
    if (auto specimen = shear_specimen(curve, test, fabric, options, diagnostics,
                                       law_before_corrections(curve, test, fabric, options)))
      specimens.push_back(std::move(*specimen));
  if (specimens.empty()) return std::nullopt;
  const LoadRows rows = put_rows(specimens, result);
  const double end = *std::max_element(result.angle.begin(), result.angle.end());
  const LawChoice choice = choose_shear(specimens, end, test, fabric, options, words_of(options));
  result.form = choice.form;
  result.why = choice.why;
  for (const ShearSpecimen& specimen : specimens)
    if (auto law = law_of_specimen(specimen, test, fabric, options, choice, result, diagnostics))
      result.specimens.push_back(std::move(*law));
  if (diagnostics.errors.size() > errors) return std::nullopt;
  const ShearSolution all = solve_shear(choice.form, rows, end, test, fabric, choice.knots);
  if (!put_law(all, rows, specimens, test, options, result, diagnostics)) return std::nullopt;
  return result;
}

std::optional<ShearFit> identify_shear(Curve curve, const ShearTest& test, const Fabric& fabric,
                                       const FitOptions& options, Diagnostics& diagnostics) {
  return identify_shear(std::vector<Curve>{std::move(curve)}, test, fabric, options, diagnostics);
}

} // namespace plyform
