// SPDX-License-Identifier: GPL-3.0-or-later
// Identifies the law of shear of a fabric from measured curves.
//
// By (40, 41) of shear_tests.hpp the load is linear in the torque Cs, and so in the coefficients of
// Cs(g) = k1 g + k3 g^3 + k5 g^5 ...: linear least squares (linear_law.hpp), exact also where (40)
// contains both Cs(g) and Cs(g/2).
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

struct ShearFit {
  ShearLaw law;
  FitQuality quality;
  std::vector<double> extension, angle, measured, fitted; ///< mm, rad, N, N of each row
  std::vector<std::size_t> specimen;                      ///< from 0, of each row
  BendingShare in_plane;              ///< of in-plane bending: its mean is in the fitted load
  Confidence confidence;              ///< of k1, k3 ...; of the torque from least_range on
  std::vector<SpecimenLaw> specimens; ///< of one or more
  Scatter scatter;                    ///< of two specimens or more
};

/// Law of shear from extension (mm) and load (N) of tests of one or more specimens of the same
/// sizes; all rows together, each specimen with the same weight. Uses the fabric's densities and
/// fibre angle, which must be 90 degrees, and its in-plane bending, whose share of the load of a
/// bias-extension test is subtracted (it depends on the law found, by iteration). Reports an error
/// and returns nothing if a curve violates check_curve, reaches 90 degrees, covers too little (two
/// rows per coefficient, 5 degrees), cannot be fitted to within 20 %, shows a disturbance that
/// makes the law worthless, or gives a torque that is negative, decreases within its range or is no
/// fabric's. Throws std::invalid_argument for options out of range.
std::optional<ShearFit> identify_shear(const std::vector<Curve>& curves, const ShearTest& test,
                                       const Fabric& fabric, const FitOptions& options,
                                       Diagnostics& diagnostics);
std::optional<ShearFit> identify_shear(Curve curve, const ShearTest& test, const Fabric& fabric,
                                       const FitOptions& options, Diagnostics& diagnostics);

} // namespace plyform
