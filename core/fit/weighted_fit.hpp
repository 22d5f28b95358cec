// SPDX-License-Identifier: GPL-3.0-or-later
// Iteratively reweighted linear least squares: the weights depend on the fitted values.
#pragma once

#include "core/fit/fit_shear.hpp"

#include <Eigen/Dense>

namespace plyform {

/// Weights 1 / max(fitted, floor): see the head of fit_shear.hpp.
inline Eigen::ArrayXd fit_weights(const Eigen::VectorXd& fitted, const Eigen::VectorXd& measured) {
  return fitted.array().max(load_floor * measured.maxCoeff()).inverse();
}

/// Coefficients k of the columns of `a` that fit a k to `measured`, of as many rows, by
/// fit_weights.
inline Eigen::VectorXd weighted_least_squares(const Eigen::MatrixXd& a,
                                              const Eigen::VectorXd& measured) {
  Eigen::VectorXd k, fitted = measured;
  constexpr int repeats = 20; // converges in three or four iterations
  for (int i = 0; i < repeats; ++i) {
    const Eigen::ArrayXd weight = fit_weights(fitted, measured);
    k = (weight.matrix().asDiagonal() * a)
            .colPivHouseholderQr()
            .solve((weight * measured.array()).matrix());
    const Eigen::VectorXd before = fitted;
    fitted = a * k;
    if ((fitted - before).norm() <= 1e-12 * fitted.norm()) break;
  }
  return k;
}

} // namespace plyform
