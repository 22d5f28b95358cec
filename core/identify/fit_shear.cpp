// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/fit_shear.hpp"

#include "core/identify/shear_rows.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <stdexcept>

namespace plyform {
namespace {

/// A law fitted to rows, with the share of in-plane bending that follows from it.
struct ShearSolution {
  LinearLaw law;
  LinearFit fit;
  double scale = 0.0; ///< rad, of the coefficients
  BendingShare share;
  Fabric fabric; ///< with the law found
};

/// Sets k1 to 0 if it is negative by rounding only (the law begins with a higher power).
void clear_rounding(ShearLaw& law, double to) {
  if (law.k[0] < 0.0 && -law.k[0] * to < 1e-9 * law.at(to).value) law.k[0] = 0.0;
}

ShearSolution solve(const LoadRows& rows, double end, const ShearTest& test, const Fabric& fabric,
                    int coefficients) {
  ShearSolution s;
  s.scale = end;
  s.fabric = fabric;
  constexpr int repetitions =
      20; // the share goes by the root of k1: each takes a tenth of the rest
  for (int i = 0; i < repetitions; ++i) {
    const double before = s.share.mean();
    s.law = linear_shear({test, fabric, coefficients, end, 1.0 + before});
    s.fit = fit_linear(s.law.loads(rows.x), rows.y, rows.weights);
    s.fabric.crossings[0].shear = {};
    s.fabric.crossings[0].shear.k = unscaled(s.fit.k, end);
    clear_rounding(s.fabric.crossings[0].shear, end);
    s.share = in_plane_bending_share(test, s.fabric);
    if (std::abs(s.share.mean() - before) <= 1e-9) break;
  }
  return s;
}

/// The smallest shear angle (rad) in [from, to] at which the law decreases or is negative; a larger
/// angle than `to` if there is none.
double invalid_at(const ShearLaw& law, double from, double to) {
  constexpr int steps = 400;
  for (int i = 0; i <= steps; ++i) {
    const double g = from + (to - from) * i / steps;
    const LawPoint p = law.at(g);
    if (!(p.value >= 0.0 && p.slope >= 0.0)) return g;
  }
  return 2.0 * to;
}

bool valid(const Curve& curve, const ShearLaw& law, const FitQuality& quality,
           Diagnostics& diagnostics) {
  const double at = invalid_at(law, 0.0, quality.to);
  if (at <= quality.to) {
    const LawPoint p = law.at(at);
    diagnostics.error(
        place_of(curve), "", "",
        fmt::format("the fitted torque {} at {:.3g} degrees ({:.3g} N mm, slope {:.3g} N mm/rad), "
                    "within the range covered: a cell must resist shear everywhere",
                    p.value < 0.0 ? "is negative" : "falls", at / degree, p.value, p.slope),
        law.k.size() > 1 ? fmt::format("take fewer coefficients: --coefficients {}; or leave out "
                                       "what is no shear with --from and --to",
                                       law.k.size() - 1)
                         : "check the columns and the sign of the load");
    return false;
  }
  constexpr double end = 0.5 * std::numbers::pi;
  if (const double beyond = invalid_at(law, quality.to, end); beyond <= end)
    diagnostics.warning(place_of(curve),
                        fmt::format("beyond the range covered, from {:.3g} degrees on, the torque "
                                    "falls: do not form to larger angles with it, or take fewer "
                                    "--coefficients",
                                    beyond / degree));
  return true;
}

/// Whether the torque is one of a fabric.
bool usual(const Curve& curve, const Fabric& found, double end, bool doubtful,
           Diagnostics& diagnostics) {
  const double angle = std::min(10.0 * degree, end);
  const double rigidity = found.families[0].density * found.families[1].density *
                          found.crossings[0].shear.secant(angle);
  return check_usual(place_of(curve), "shear stiffness", rigidity, usual_shear_rigidity, "N/mm",
                     doubtful, diagnostics);
}

void warn_of_layers(const Curve& curve, const BendingShare& share, Diagnostics& diagnostics) {
  constexpr double large = 0.4; // of the load: half of it is not known
  if (share.most <= large) return;
  diagnostics.warning(
      place_of(curve),
      fmt::format("in-plane bending of the yarns adds {:.0f} to {:.0f} % to the load of shear: the "
                  "law is as uncertain; test a longer specimen",
                  100.0 * share.least, 100.0 * share.most));
}

void check_options(const Fabric& fabric, const FitOptions& options) {
  if (options.coefficients < 1 || options.coefficients > 6)
    throw std::invalid_argument("coefficients must be 1 to 6");
  if (!(options.from >= 0.0 && options.to > options.from))
    throw std::invalid_argument("the range must start at 0 or above and end above its start");
  if (!is_weave(fabric) ||
      std::abs(material_axes(fabric).between() - 0.5 * std::numbers::pi) > 1e-6)
    throw std::invalid_argument("the theory of the shear tests needs fibres at 90 degrees");
}

std::vector<double> fitted_loads(const ShearSolution& s, const ShearTest& test,
                                 const Eigen::VectorXd& extension) {
  std::vector<double> loads;
  for (const double x : extension)
    loads.push_back((1.0 + s.share.mean()) * test_load(test, s.fabric, x));
  return loads;
}

CurveWords words_of(const FitOptions& options) {
  CurveWords words;
  words.length_unit = "mm";
  words.x_is_length = words.can_stretch = !options.measured_angle;
  if (!options.measured_angle) words.angle_remedy = ", or --angle-column of a measured shear angle";
  return words;
}

/// The law of one specimen; reports errors and returns nothing as identify_shear does.
std::optional<SpecimenLaw> law_of_specimen(const ShearSpecimen& specimen, const ShearTest& test,
                                           const Fabric& fabric, const FitOptions& options,
                                           Diagnostics& diagnostics) {
  const Curve& curve = specimen.curve;
  const ShearSolution s =
      solve(specimen.rows, specimen.angle.back(), test, fabric, options.coefficients);
  LoadRows rows = specimen.rows;
  rows.weights = s.fit.weights;
  const CurveWords words = words_of(options);
  if (!check_disturbances(curve, s.law, rows, options, words, diagnostics)) return std::nullopt;
  SpecimenLaw law{curve.file, s.fabric.crossings[0].shear.k, {}, specimen.corrected, {}};
  law.quality =
      quality_of(specimen.angle, {rows.y.begin(), rows.y.end()}, fitted_loads(s, test, rows.x));
  const bool good = check_quality(
      curve, law.quality, fmt::format("{:.3g} degrees", law.quality.largest_at / degree),
      "check columns and specimen, smooth the curve, take more --coefficients, or leave out "
      "slipping and wrinkling with --to",
      diagnostics);
  if (!good || !valid(curve, s.fabric.crossings[0].shear, law.quality, diagnostics) ||
      !usual(curve, s.fabric, law.quality.to, options.doubtful, diagnostics))
    return std::nullopt;
  law.sensitive = sensitivities(s.law, rows, words.length, common_compliance);
  warn_of_unknowns(curve, s.law, rows, law.sensitive, options, words, diagnostics);
  return law;
}

/// All rows, each specimen with the same weight.
LoadRows all_rows(const std::vector<ShearSpecimen>& specimens, ShearFit& result) {
  std::vector<double> y, shares;
  std::size_t rows = 0;
  for (const ShearSpecimen& specimen : specimens)
    rows += specimen.angle.size();
  for (std::size_t n = 0; n < specimens.size(); ++n) {
    const ShearSpecimen& specimen = specimens[n];
    const double mean = static_cast<double>(rows) / static_cast<double>(specimens.size());
    for (std::size_t i = 0; i < specimen.angle.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      result.extension.push_back(specimen.rows.x[row]);
      result.angle.push_back(specimen.angle[i]);
      result.measured.push_back(specimen.rows.y[row]);
      result.specimen.push_back(n);
      shares.push_back(std::sqrt(mean / static_cast<double>(specimen.angle.size())));
    }
  }
  return {vector_of(result.extension), vector_of(result.measured), vector_of(shares).array()};
}

/// Limits of confidence, and the scatter between specimens.
void judge(const ShearSolution& all, const std::vector<ShearSpecimen>& specimens,
           const Corrections& corrections, ShearFit& result) {
  const std::vector<double> places = probe_angles(all.scale);
  if (specimens.size() == 1) {
    const ShearSpecimen& only = specimens.front();
    const LinearFit fit = with_found(all.fit, all.law, only.rows, corrections, only.corrected);
    result.confidence = confidence_of(fit, all.law.probes, places);
  } else {
    std::vector<Eigen::VectorXd> own; // on the scale of all
    for (const SpecimenLaw& law : result.specimens) {
      Eigen::VectorXd k = vector_of(law.coefficients);
      for (Eigen::Index c = 0; c < k.size(); ++c)
        k[c] *= std::pow(all.scale, static_cast<double>(2 * c + 1));
      own.push_back(k);
    }
    result.scatter = scatter_of(own, all.law.probes, places);
    result.confidence = confidence_between(own, all.law.probes, places);
  }
  for (std::size_t c = 0; c < result.confidence.coefficient.size(); ++c) {
    const double unit = std::pow(all.scale, static_cast<double>(2 * c + 1));
    result.confidence.coefficient[c] /= unit;
    if (result.scatter.coefficient.empty()) continue;
    Spread& spread = result.scatter.coefficient[c];
    spread = {spread.mean / unit, spread.deviation / unit, spread.limits / unit};
  }
}

} // namespace

std::optional<ShearFit> identify_shear(const std::vector<Curve>& curves, const ShearTest& test,
                                       const Fabric& fabric, const FitOptions& options,
                                       Diagnostics& diagnostics) {
  check_options(fabric, options);
  ShearFit result;
  std::vector<ShearSpecimen> specimens;
  const std::size_t errors = diagnostics.errors.size();
  for (const Curve& curve : curves) {
    auto specimen = shear_specimen(curve, test, fabric, options, diagnostics);
    if (!specimen) continue;
    if (auto law = law_of_specimen(*specimen, test, fabric, options, diagnostics))
      result.specimens.push_back(std::move(*law));
    specimens.push_back(std::move(*specimen));
  }
  if (diagnostics.errors.size() > errors || specimens.empty()) return std::nullopt;
  const LoadRows rows = all_rows(specimens, result);
  const double end = *std::max_element(result.angle.begin(), result.angle.end());
  const ShearSolution all = solve(rows, end, test, fabric, options.coefficients);
  result.law = all.fabric.crossings[0].shear;
  result.in_plane = all.share;
  result.fitted = fitted_loads(all, test, rows.x);
  result.quality = quality_of(result.angle, result.measured, result.fitted);
  warn_of_layers(specimens.front().curve, result.in_plane, diagnostics);
  if (specimens.size() > 1 &&
      !valid(specimens.front().curve, result.law, result.quality, diagnostics))
    return std::nullopt;
  judge(all, specimens, options.corrections, result);
  return result;
}

std::optional<ShearFit> identify_shear(Curve curve, const ShearTest& test, const Fabric& fabric,
                                       const FitOptions& options, Diagnostics& diagnostics) {
  return identify_shear(std::vector<Curve>{std::move(curve)}, test, fabric, options, diagnostics);
}

} // namespace plyform
