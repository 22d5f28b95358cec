// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/format.hpp"
#include "core/identify/bending_tests.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

/// gamma = a + b exp(-s / l) with the best l.
struct AngleProfile {
  double length = 0.0, limits = 0.0; ///< l, mm
  double plateau = 0.0, step = 0.0;  ///< a, b, rad
  double rms = 0.0;                  ///< of the residuals over |b|
};

Eigen::MatrixXd columns_of(const Eigen::VectorXd& s, double length) {
  Eigen::MatrixXd a(s.size(), 2);
  a.col(0).setOnes();
  a.col(1) = (-s.array() / length).exp();
  return a;
}

AngleProfile fit_profile(const Eigen::VectorXd& s, const Eigen::VectorXd& angle) {
  const Eigen::ArrayXd ones = Eigen::ArrayXd::Ones(s.size());
  const double span = s.maxCoeff() - s.minCoeff();
  const double log_length = minimum_of(
      [&](double l) { return fit_fixed(columns_of(s, std::exp(l)), angle, ones).squares; },
      std::log(0.01 * span), std::log(10.0 * span));
  AngleProfile profile;
  profile.length = std::exp(log_length);
  Eigen::MatrixXd j(s.size(), 3);
  j.leftCols(2) = columns_of(s, profile.length);
  const FixedFit fit = fit_fixed(j.leftCols(2), angle, ones);
  profile.plateau = fit.k[0];
  profile.step = fit.k[1];
  j.col(2) = (fit.k[1] / (profile.length * profile.length) * s.array() * j.col(1).array()).matrix();
  const double freedom = freedom_of(fit.residuals, 3);
  const Eigen::MatrixXd inverse =
      (j.transpose() * j).completeOrthogonalDecomposition().pseudoInverse();
  profile.limits = student_95(freedom) * std::sqrt(fit.squares / freedom * inverse(2, 2));
  profile.rms = std::sqrt(fit.squares / static_cast<double>(s.size())) / std::abs(fit.k[1]);
  return profile;
}

bool good_profile(const Curve& curve, const AngleProfile& profile, double span,
                  Diagnostics& diagnostics) {
  constexpr double least_lengths = 1.5; // of l in the profile, for its plateau to be seen
  constexpr double largest_limits = 0.5;
  if (profile.length * least_lengths > span ||
      !(profile.limits < largest_limits * profile.length)) {
    diagnostics.error(place_of(curve), "", "",
                      fmt::format("the zone is {:.3g} mm wide (+- {:.2g}), the profile {:.3g} mm "
                                  "long: nothing sure follows",
                                  profile.length, profile.limits, span),
                      "measure from the step of shear far into the zone, to where the angle no "
                      "longer changes, at more places");
    return false;
  }
  if (!(profile.rms <= useless)) {
    diagnostics.error(place_of(curve), "", "",
                      fmt::format("the profile is no exponential: residuals {:.2g} % rms of its "
                                  "step",
                                  100.0 * profile.rms),
                      "take one side of the step only, away from the rim");
    return false;
  }
  constexpr double small = 15.0 * degree;
  if (std::abs(profile.plateau) > small)
    diagnostics.warning(place_of(curve),
                        fmt::format("the zone is sheared by {:.3g} degrees: measure at 5 to 10, "
                                    "where the law of shear is nearly a line",
                                    profile.plateau / degree));
  return true;
}

/// Where y stands for an angle, in degrees: residuals over the step.
void put_rows(const Curve& curve, const AngleProfile& profile, std::size_t specimen,
              ZoneFit& result) {
  for (std::size_t i = 0; i < curve.size(); ++i) {
    result.x.push_back(curve.x[i]);
    result.measured.push_back(curve.y[i]);
    result.fitted.push_back(profile.plateau +
                            profile.step * std::exp(-curve.x[i] / profile.length));
    result.specimen.push_back(specimen);
  }
}

} // namespace

std::optional<ZoneFit> identify_zone(const std::vector<Curve>& curves, const Fabric& fabric,
                                     const FitOptions& options, Diagnostics& diagnostics) {
  ZoneFit result;
  double own_limits = 0.0, squares = 0.0;
  for (std::size_t n = 0; n < curves.size(); ++n) {
    Curve curve = curves[n];
    if (!check_rising(curve, "distance", diagnostics)) return std::nullopt;
    if (curve.size() < 6) {
      diagnostics.error(place_of(curve), "", "",
                        fmt::format("{} rows, a profile needs at least 6", curve.size()),
                        "measure at more places");
      return std::nullopt;
    }
    const Eigen::VectorXd s = (vector_of(curve.x).array() - curve.x.front()).matrix();
    const AngleProfile profile = fit_profile(s, vector_of(curve.y));
    if (!good_profile(curve, profile, s.maxCoeff(), diagnostics)) return std::nullopt;
    AngleProfile shifted = profile; // rows begin where they were measured
    shifted.step *= std::exp(curve.x.front() / profile.length);
    put_rows(curve, shifted, n, result);
    result.lengths.push_back(profile.length);
    result.length += profile.length / static_cast<double>(curves.size());
    result.plateau += profile.plateau / static_cast<double>(curves.size());
    squares += profile.rms * profile.rms / static_cast<double>(curves.size());
    own_limits = profile.limits;
  }
  result.length_limits = curves.size() > 1 ? spread_of(result.lengths).limits : own_limits;
  const double rigidity = fabric.families[0].density * fabric.families[1].density *
                          fabric.crossings[0].shear.at(result.plateau).slope;
  result.stiffness = rigidity * result.length * result.length;
  result.stiffness_limits = 2.0 * result.stiffness * result.length_limits / result.length;
  result.quality.rows = result.x.size();
  result.quality.rms = std::sqrt(squares);
  result.quality.to = *std::max_element(result.x.begin(), result.x.end());
  if (!check_usual(place_of(curves.front()), "in_plane_bending_stiffness", result.stiffness,
                   usual_bending_stiffness, "N mm", options.doubtful, diagnostics))
    return std::nullopt;
  return result;
}

void check_zone_fabric(const std::vector<std::string>& missing, const Place& at,
                       Diagnostics& diagnostics) {
  if (std::find(missing.begin(), missing.end(), "shear") != missing.end())
    diagnostics.error(at, "shear", "", "is missing",
                      "the zone's width says how bending and shear go together: identify the law "
                      "of shear first");
}

} // namespace plyform
