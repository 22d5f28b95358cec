// SPDX-License-Identifier: GPL-3.0-or-later
// From the curve of a shear test to the rows that a law of shear is fitted to.
#pragma once

#include "core/identify/fit_shear.hpp"

namespace plyform {

/// (40, 41) with n coefficients of (g / scale), (g / scale)^3 ...; loads times `factor`.
struct ShearBasis {
  const ShearTest& test;
  const Fabric& fabric;
  int coefficients;
  double scale;  ///< rad: makes the columns similar in size
  double factor; ///< 1 + share of in-plane bending
};

LinearLaw linear_shear(const ShearBasis& basis);

/// Angles (rad) at which laws are compared, from least_range to the largest.
std::vector<double> probe_angles(double largest);

/// k1, k3 ... from coefficients of a basis.
std::vector<double> unscaled(const Eigen::VectorXd& k, double scale);

/// The rows of a curve after corrections, in the range asked for.
struct ShearSpecimen {
  Curve curve; ///< as read, rows sorted: lines for messages
  LoadRows rows;
  std::vector<double> angle; ///< rad, of each row
  Corrected corrected;
  std::size_t first = 0; ///< row of the curve that is the first of `rows`
};

/// The rows of all specimens, each specimen with the same weight.
LoadRows rows_together(const std::vector<ShearSpecimen>& specimens);

/// Reports errors and returns nothing where identify_shear says so. law: that corrections which are
/// looked for are to fit, in the place of a polynomial.
std::optional<ShearSpecimen> shear_specimen(Curve curve, const ShearTest& test,
                                            const Fabric& fabric, const FitOptions& options,
                                            Diagnostics& diagnostics,
                                            const std::optional<LinearLaw>& law = {});

} // namespace plyform
