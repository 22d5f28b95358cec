// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/shear_rows.hpp"

#include "base/format.hpp"
#include "core/identify/measured_angle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace plyform {
namespace {

constexpr double right_angle = 0.5 * std::numbers::pi;

Eigen::MatrixXd loads_of(const ShearBasis& basis, const Eigen::VectorXd& extension) {
  Eigen::MatrixXd a(extension.size(), basis.coefficients);
  const double end = 0.999 * locking_extension(basis.test); // trial values may be beyond
  for (Eigen::Index r = 0; r < a.rows(); ++r) {
    const TorqueWeights weights =
        torque_weights(basis.test, basis.fabric, std::clamp(extension[r], 0.0, end));
    for (int c = 0; c < basis.coefficients; ++c)
      a(r, c) =
          basis.factor * (weights.whole * std::pow(weights.angle / basis.scale, 2 * c + 1) +
                          weights.half * std::pow(0.5 * weights.angle / basis.scale, 2 * c + 1));
  }
  return a;
}

/// Puts the extension that belongs to the measured angle in the place of the crosshead's; reports
/// an error and returns false if an angle cannot be.
bool take_measured_angles(Curve& curve, const ShearTest& test, Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (!(std::abs(curve.angle[i]) < right_angle)) {
      diagnostics.error(place_of(curve, i), curve.angle_name, written_angle(curve, i),
                        "the shear angle must be less than 90 degrees",
                        "give the change of the angle between the yarns; --angle-unit rad if it is "
                        "in radians");
      return false;
    }
    curve.x[i] = extension_at(test, curve.angle[i]);
  }
  curve.x_name = curve.angle_name;
  WrittenColumn& written = curve.x_written = curve.angle_written;
  if (written.number.empty()) // between those of another file, or of none
    for (const double angle : curve.angle)
      written.number.push_back(angle / written.factor);
  written.factor = std::numeric_limits<double>::quiet_NaN();
  return true;
}

/// Warns where measured angles are not those that belong to the crosshead's extension.
void compare_angles(const Curve& curve, const ShearTest& test, bool measured_counts,
                    Diagnostics& diagnostics) {
  if (curve.angle.empty() || curve.x_name.empty()) return;
  const auto [largest, at] = angle_difference(curve, test);
  constexpr double agree = 1.0 * degree;
  if (std::abs(largest) <= agree) return;
  diagnostics.warning(
      place_of(curve),
      fmt::format("the measured shear angle ({}) is up to {:.2g} degrees {} than that of the "
                  "crosshead, at {:.3g} degrees: {}; {}",
                  curve.angle_name, std::abs(largest) / degree,
                  largest > 0.0 ? "smaller" : "larger", at / degree,
                  largest > 0.0 ? "slip in the clamps, compliance, or yarns that slide"
                                : "a displacement zero set too late, or another specimen",
                  measured_counts ? "the law is of the measured angle"
                                  : fmt::format("the law is of the crosshead's; --angle-column {} "
                                                "takes the measured one",
                                                curve.angle_name)));
}

/// The rows between `from` and `to`; reports an error and returns false if a row is beyond the
/// extension that the geometry of the test allows.
bool take_range(ShearSpecimen& specimen, const ShearTest& test, const FitOptions& options,
                Diagnostics& diagnostics) {
  const Curve& curve = specimen.curve;
  std::vector<double> x, y;
  const double locking = locking_extension(test);
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (curve.x[i] >= locking) {
      // x increases: the remaining rows are beyond it too
      if (options.to < right_angle) break;
      diagnostics.error(place_of(curve, i), curve.x_name, written_x(curve, i),
                        fmt::format("the extension must be less than {:.4g} mm, where the specimen "
                                    "would shear by 90 degrees",
                                    locking),
                        "check the size of the specimen and the unit of the column, or leave the "
                        "end out with --to");
      return false;
    }
    const double angle = shear_angle(test, curve.x[i]);
    if (angle < options.from || angle > options.to) continue;
    if (x.empty()) specimen.first = i;
    x.push_back(curve.x[i]);
    y.push_back(curve.y[i]);
    specimen.angle.push_back(angle);
  }
  specimen.rows.x = vector_of(x);
  specimen.rows.y = vector_of(y);
  return true;
}

bool enough(const ShearSpecimen& specimen, const FitOptions& options, Diagnostics& diagnostics) {
  const std::vector<double>& angle = specimen.angle;
  const int sheared =
      static_cast<int>(std::count_if(angle.begin(), angle.end(), [](double g) { return g > 0.0; }));
  const bool table = options.points > 0;
  const int numbers = options.coefficients > 0 ? options.coefficients : 3;
  const int least = table ? options.points : 2 * numbers;
  if (sheared < least) {
    const std::string what = table ? fmt::format("a table of {} points needs", options.points)
                                   : fmt::format("{} coefficient{} need{}", numbers,
                                                 numbers == 1 ? "" : "s", numbers == 1 ? "s" : "");
    diagnostics.error(place_of(specimen.curve), "", "",
                      fmt::format("{} row{} with a shear angle above 0 within the range, {} at "
                                  "least {}",
                                  sheared, sheared == 1 ? "" : "s", what, least),
                      table ? "record more rows, widen --from and --to, or take fewer --points"
                            : "record more rows, widen --from and --to, or take fewer "
                              "--coefficients");
    return false;
  }
  const double range = angle.back() - angle.front();
  if (range >= least_range) return true;
  const Curve& curve = specimen.curve;
  diagnostics.error(
      place_of(curve, curve.size() - 1), curve.x_name, written_x(curve, curve.size() - 1),
      fmt::format("the rows cover {:.2g} degrees of shear angle, there must be at least "
                  "{:g}",
                  range / degree, least_range / degree),
      options.measured_angle
          ? "test to a larger angle, widen --from and --to, or check the unit of the column: "
            "--angle-unit rad if it is in radians"
          : "test to a larger extension, widen --from and --to, or check the size of the specimen "
            "and the unit of the column");
  return false;
}

void warn_of_start(const ShearSpecimen& specimen, const FitOptions& options,
                   Diagnostics& diagnostics) {
  const double angle = specimen.angle.front(), load = specimen.rows.y[0];
  if (angle > least_range)
    diagnostics.warning(
        place_of(specimen.curve),
        fmt::format("the rows start at {:.3g} degrees: below, the law is a guess", angle / degree));
  const Corrections& c = options.corrections;
  if (c.load_zero || c.fit_load_zero || c.toe || c.fit_toe) return;
  if (!options.flows && angle < 0.1 * degree && load > noise_share * specimen.rows.y.maxCoeff())
    diagnostics.warning(
        place_of(specimen.curve),
        fmt::format(
            "{} = {} at {} = {}, where the theory has next to none: take a preload or an offset "
            "off with --zero or --toe, or start with --from",
            specimen.curve.y_name, written_y(specimen.curve, specimen.first), specimen.curve.x_name,
            written_x(specimen.curve, specimen.first)));
}

/// Finds the corrections asked for, with the law that they are to fit.
void fit_corrections(ShearSpecimen& specimen, const ShearTest& test, const Fabric& fabric,
                     const FitOptions& options, const std::optional<LinearLaw>& given) {
  const double end = std::min(
      {options.to, 0.49 * std::numbers::pi,
       shear_angle(test, std::min(specimen.curve.x.back(), 0.99 * locking_extension(test)))});
  if (!(end > least_range)) return; // reported later
  const int coefficients = options.coefficients > 0 ? options.coefficients : 3;
  const LinearLaw law = given ? *given : linear_shear({test, fabric, coefficients, end, 1.0});
  apply_fitted(specimen.curve, options.corrections, law, extension_at(test, options.from),
               extension_at(test, end) * (1.0 + 1e-9), specimen.corrected);
}

} // namespace

std::vector<double> probe_angles(double largest) {
  constexpr int steps = 20;
  std::vector<double> angles;
  const double start = std::min(least_range, 0.5 * largest);
  for (int i = 0; i <= steps; ++i)
    angles.push_back(start + (largest - start) * i / steps);
  return angles;
}

LinearLaw linear_shear(const ShearBasis& basis) {
  LinearLaw law;
  law.loads = [basis](const Eigen::VectorXd& x) { return loads_of(basis, x); };
  ShearBasis more = basis;
  ++more.coefficients;
  law.richer = [more](const Eigen::VectorXd& x) { return loads_of(more, x); };
  const std::vector<double> angles = probe_angles(basis.scale);
  law.probes.resize(static_cast<Eigen::Index>(angles.size()), basis.coefficients);
  for (Eigen::Index r = 0; r < law.probes.rows(); ++r)
    for (int c = 0; c < basis.coefficients; ++c)
      law.probes(r, c) = std::pow(angles[static_cast<std::size_t>(r)] / basis.scale, 2 * c + 1);
  return law;
}

std::vector<double> unscaled(const Eigen::VectorXd& k, double scale) {
  std::vector<double> law;
  for (Eigen::Index c = 0; c < k.size(); ++c)
    law.push_back(k[c] / std::pow(scale, static_cast<double>(2 * c + 1)));
  return law;
}

LoadRows rows_together(const std::vector<ShearSpecimen>& specimens) {
  std::vector<double> x, y, shares;
  std::size_t rows = 0;
  for (const ShearSpecimen& specimen : specimens)
    rows += specimen.angle.size();
  const double mean = static_cast<double>(rows) / static_cast<double>(specimens.size());
  for (const ShearSpecimen& specimen : specimens) {
    x.insert(x.end(), specimen.rows.x.begin(), specimen.rows.x.end());
    y.insert(y.end(), specimen.rows.y.begin(), specimen.rows.y.end());
    shares.insert(shares.end(), specimen.angle.size(),
                  std::sqrt(mean / static_cast<double>(specimen.angle.size())));
  }
  return {vector_of(x), vector_of(y), vector_of(shares).array()};
}

std::optional<ShearSpecimen> shear_specimen(Curve curve, const ShearTest& test,
                                            const Fabric& fabric, const FitOptions& options,
                                            Diagnostics& diagnostics,
                                            const std::optional<LinearLaw>& law) {
  if (options.measured_angle && curve.angle.size() != curve.size())
    throw std::invalid_argument("the curve has no measured shear angles");
  ShearSpecimen specimen;
  compare_angles(curve, test, options.measured_angle, diagnostics);
  if (options.measured_angle && !take_measured_angles(curve, test, diagnostics))
    return std::nullopt;
  specimen.curve = std::move(curve);
  Curve& c = specimen.curve;
  constexpr double camera_share = 0.03; // angles from pictures scatter more than a crosshead
  const double share = options.measured_angle ? camera_share : back_share;
  if (!check_rising(c, options.measured_angle ? "shear angle" : "extension", diagnostics, share) ||
      !apply_given(c, options.corrections, "extension", specimen.corrected, diagnostics))
    return std::nullopt;
  if (options.corrections.toe && !drop_slack(c, "extension", diagnostics)) return std::nullopt;
  if (options.corrections.any_fit()) {
    fit_corrections(specimen, test, fabric, options, law);
    if (!drop_slack(c, "extension", diagnostics)) return std::nullopt;
  }
  if (!check_zeros(c, "extension", "load", diagnostics) ||
      !take_range(specimen, test, options, diagnostics) || !enough(specimen, options, diagnostics))
    return std::nullopt;
  warn_of_start(specimen, options, diagnostics);
  return specimen;
}

} // namespace plyform
