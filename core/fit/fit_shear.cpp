// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fit/fit_shear.hpp"

#include "core/fit/weighted_fit.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <stdexcept>

namespace plyform {
namespace {

constexpr double deg = std::numbers::pi / 180.0;

/// A row of the curve with the weights of the torque in (40, 41).
struct Sample {
  double extension, load;
  TorqueWeights weights;
};

Place place_of(const Curve& curve, std::size_t row = 0) {
  return {curve.file, curve.line[row], 1};
}

/// The rows between `from` and `to`; reports an error and returns nothing if a row is beyond the
/// extension that the geometry of the test allows.
std::optional<std::vector<Sample>> samples_of(const Curve& curve, const ShearTest& test,
                                              const Fabric& fabric, const FitOptions& options,
                                              Diagnostics& diagnostics) {
  std::vector<Sample> samples;
  const double locking = locking_extension(test);
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (curve.x[i] >= locking) {
      // x increases: the remaining rows are beyond it too
      if (options.to < 0.5 * std::numbers::pi) break;
      diagnostics.error(place_of(curve, i), curve.x_name, fmt::format("{:g}", curve.x[i]),
                        fmt::format("the extension must be less than {:.4g} mm, where the specimen "
                                    "would shear by 90 degrees",
                                    locking),
                        "check the size of the specimen and that the column is in mm, or leave the "
                        "end out with --to");
      return std::nullopt;
    }
    const TorqueWeights weights = torque_weights(test, fabric, curve.x[i]);
    if (weights.angle >= options.from && weights.angle <= options.to)
      samples.push_back({curve.x[i], curve.y[i], weights});
  }
  return samples;
}

bool enough(const Curve& curve, const std::vector<Sample>& samples, const FitOptions& options,
            Diagnostics& diagnostics) {
  const int sheared = static_cast<int>(std::count_if(
      samples.begin(), samples.end(), [](const Sample& s) { return s.weights.angle > 0.0; }));
  if (sheared < 2 * options.coefficients) {
    diagnostics.error(place_of(curve), "", "",
                      fmt::format("{} row{} with a shear angle above 0 within the range, {} "
                                  "coefficient{} need{} at least {}",
                                  sheared, sheared == 1 ? "" : "s", options.coefficients,
                                  options.coefficients == 1 ? "" : "s",
                                  options.coefficients == 1 ? "s" : "", 2 * options.coefficients),
                      "record more rows, widen --from and --to, or take fewer --coefficients");
    return false;
  }
  const double range = samples.back().weights.angle - samples.front().weights.angle;
  if (range >= least_range) return true;
  diagnostics.error(
      place_of(curve), "", "",
      fmt::format("the rows cover {:.2g} degrees of shear angle, there must be at least "
                  "{:g}",
                  range / deg, least_range / deg),
      "test to a larger extension, widen --from and --to, or check the size of the "
      "specimen and that the column is in mm");
  return false;
}

/// Coefficients of g, g^3 ... by weighted linear least squares; the weights follow the fit. Loads
/// are divided by `factor`.
std::vector<double> fit(const std::vector<Sample>& samples, int coefficients, double factor) {
  const auto rows = static_cast<Eigen::Index>(samples.size());
  const double scale = samples.back().weights.angle; // scales the columns to similar magnitude
  Eigen::MatrixXd a(rows, coefficients);
  Eigen::VectorXd load(rows);
  for (Eigen::Index r = 0; r < rows; ++r) {
    const Sample& s = samples[r];
    for (int c = 0; c < coefficients; ++c)
      a(r, c) = s.weights.whole * std::pow(s.weights.angle / scale, 2 * c + 1) +
                s.weights.half * std::pow(0.5 * s.weights.angle / scale, 2 * c + 1);
    load[r] = s.load / factor;
  }
  const Eigen::VectorXd k = weighted_least_squares(a, load);
  std::vector<double> law;
  for (int c = 0; c < coefficients; ++c)
    law.push_back(k[c] / std::pow(scale, 2 * c + 1));
  return law;
}

/// Sets k1 to 0 if it is negative by rounding only (the law begins with a higher power).
void clear_rounding(ShearLaw& law, double to) {
  if (law.k[0] < 0.0 && -law.k[0] * to < 1e-9 * law.at(to).value) law.k[0] = 0.0;
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
                    p.value < 0.0 ? "is negative" : "falls", at / deg, p.value, p.slope),
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
                                    beyond / deg));
  return true;
}

void warn_of_start(const Curve& curve, const Sample& first, Diagnostics& diagnostics) {
  const double angle = first.weights.angle;
  if (angle > least_range)
    diagnostics.warning(place_of(curve), fmt::format("the rows start at {:.3g} degrees: below, the "
                                                     "law is a guess",
                                                     angle / deg));
  const double most = *std::max_element(curve.y.begin(), curve.y.end());
  if (angle < 0.1 * deg && first.load > noise_share * most)
    diagnostics.warning(
        place_of(curve),
        fmt::format("{:.3g} N at an extension of {:.3g} mm, where the theory has next "
                    "to none: subtract a preload or an offset, or start with --from",
                    first.load, first.extension));
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
    throw std::invalid_argument("coefficients: there can be 1 to 6");
  if (!(options.from >= 0.0 && options.to > options.from))
    throw std::invalid_argument("the range must start at 0 or above and end above its start");
  if (!(std::abs(fabric.fibre_angle - 0.5 * std::numbers::pi) < 1e-6))
    throw std::invalid_argument("the theory of the shear tests is for yarns at 90 degrees");
}

} // namespace

FitQuality quality_of(const std::vector<double>& at, const std::vector<double>& measured,
                      const std::vector<double>& fitted) {
  FitQuality quality{.rows = at.size(), .from = at.front(), .to = at.back()};
  const double floor = load_floor * *std::max_element(measured.begin(), measured.end());
  double squares = 0.0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double residual = std::abs(measured[i] - fitted[i]) / std::max(fitted[i], floor);
    squares += residual * residual;
    if (residual <= quality.largest) continue;
    quality.largest = residual;
    quality.largest_at = at[i];
  }
  quality.rms = std::sqrt(squares / static_cast<double>(at.size()));
  return quality;
}

bool check_quality(const Curve& curve, const FitQuality& quality, const std::string& where,
                   const std::string& remedy, Diagnostics& diagnostics) {
  const std::string figures = fmt::format("{:.3g} % rms of the load, {:.3g} % at most, at {}",
                                          100.0 * quality.rms, 100.0 * quality.largest, where);
  if (!(quality.rms <= useless)) {
    diagnostics.error(
        place_of(curve), "", "",
        fmt::format("the curve is no law's: residuals {}; they must be less than {:g} %", figures,
                    100.0 * useless),
        remedy);
    return false;
  }
  if (quality.rms > noisy)
    diagnostics.warning(place_of(curve),
                        fmt::format("noise, or a shape that the law does not have: "
                                    "residuals {}; {}",
                                    figures, remedy));
  return true;
}

std::optional<ShearFit> identify_shear(Curve curve, const ShearTest& test, const Fabric& fabric,
                                       const FitOptions& options, Diagnostics& diagnostics) {
  check_options(fabric, options);
  if (!check_curve(curve, "extension", "load", diagnostics)) return std::nullopt;
  const auto samples = samples_of(curve, test, fabric, options, diagnostics);
  if (!samples || !enough(curve, *samples, options, diagnostics)) return std::nullopt;
  warn_of_start(curve, samples->front(), diagnostics);
  ShearFit result;
  Fabric fitted = fabric;
  constexpr int repetitions =
      20; // the share goes by the root of k1: each takes a tenth of the rest
  for (int i = 0; i < repetitions; ++i) {
    const double before = result.in_plane.mean();
    result.law.k = fit(*samples, options.coefficients, 1.0 + before);
    clear_rounding(result.law, samples->back().weights.angle);
    fitted.shear = result.law;
    result.in_plane = in_plane_bending_share(test, fitted);
    if (std::abs(result.in_plane.mean() - before) <= 1e-9) break;
  }
  warn_of_layers(curve, result.in_plane, diagnostics);
  for (const Sample& s : *samples) {
    result.extension.push_back(s.extension);
    result.angle.push_back(s.weights.angle);
    result.measured.push_back(s.load);
    result.fitted.push_back((1.0 + result.in_plane.mean()) * test_load(test, fitted, s.extension));
  }
  result.quality = quality_of(result.angle, result.measured, result.fitted);
  const bool good = check_quality(
      curve, result.quality, fmt::format("{:.3g} degrees", result.quality.largest_at / deg),
      "check columns and specimen, smooth the curve, take more --coefficients, or leave out "
      "slipping and wrinkling with --to",
      diagnostics);
  if (!good || !valid(curve, result.law, result.quality, diagnostics)) return std::nullopt;
  return result;
}

} // namespace plyform
