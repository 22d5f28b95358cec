// SPDX-License-Identifier: GPL-3.0-or-later
// Identifies the law of shear of a fabric from measured curves.
//
// By (40, 41) of shear_tests.hpp the load is linear in the torque Cs, and so in the coefficients of
// Cs(g) = k1 g + k3 g^3 + k5 g^5 ...: linear least squares (linear_law.hpp), exact also where (40)
// contains both Cs(g) and Cs(g/2). Where yarns stick, turn at nearly constant torque and lock, no
// polynomial does: choose_shear.hpp says how the form of the law is chosen, shear_checks.hpp how it
// is judged.
//
// A measured shear angle takes the place of the crosshead's: the extension that the specimen really
// has is then that of (a) at this angle, whatever slips or gives way outside of it.
#pragma once

#include "core/identify/fit_quality.hpp"
#include "core/identify/shear_tests.hpp"

#include <optional>
#include <vector>

namespace plyform {

/// rad (5 degrees): smallest range of shear angles that a law can be identified from, and the angle
/// from which on laws are compared: at smaller ones the load is below what a load cell resolves.
inline constexpr double least_range = 0.08726646259971647;

/// Of a table of shear.
inline constexpr int most_table_points = 20;

/// Form of a law of shear: shear_forms.hpp.
struct ShearForm {
  ShearFormKind kind = ShearFormKind::polynomial;
  int size = 3; ///< coefficients of the polynomial, or points
  bool operator==(const ShearForm&) const = default;
  std::string name() const; ///< "polynomial of 3", "static torque and polynomial of 2" ...
};

struct ShearFit {
  ShearLaw law;
  ShearForm form;
  std::string why; ///< of the form: "cross-validated 1.9 %, polynomial of 3 14 %"
  double static_torque = 0.0, static_angle = 0.0; ///< N mm, and rad within which it is reached
  std::vector<double> polynomial; ///< k1, k3 ... (N mm), beside a static torque too; or empty
  FitQuality quality;
  std::vector<double> extension, angle, measured, fitted; ///< mm, rad, N, N of each row
  std::vector<std::size_t> specimen;                      ///< from 0, of each row
  BendingShare in_plane; ///< of in-plane bending: its mean is in the fitted load
  /// Of k1, k3 ... and the static torque, or of the torques at a table's points but (0, 0); of the
  /// torque from least_range on.
  Confidence confidence;
  std::vector<SpecimenLaw> specimens; ///< of one or more; coefficients as in `confidence`
  std::vector<ShearLaw> of_specimen;  ///< the same laws
  Scatter scatter;                    ///< of two specimens or more
};

/// Law of shear from extension (mm) and load (N) of tests of one or more specimens of the same
/// sizes; all rows together, each specimen with the same weight. Uses the fabric's densities and
/// fibre angle, which must be 90 degrees, and its in-plane bending, whose share of the load of a
/// bias-extension test is subtracted (it depends on the law found, by iteration). Reports an error
/// and returns nothing if a curve violates check_rising or check_zeros, reaches 90 degrees, covers
/// too little (two rows per coefficient, 6 if the law is chosen; 5 degrees), cannot be fitted to
/// within 20 % of the torque, shows a disturbance that makes the law worthless, or gives a torque
/// that is negative, decreases within its range or is no fabric's. Throws std::invalid_argument for
/// options out of range.
std::optional<ShearFit> identify_shear(const std::vector<Curve>& curves, const ShearTest& test,
                                       const Fabric& fabric, const FitOptions& options,
                                       Diagnostics& diagnostics);
std::optional<ShearFit> identify_shear(Curve curve, const ShearTest& test, const Fabric& fabric,
                                       const FitOptions& options, Diagnostics& diagnostics);

} // namespace plyform
