// SPDX-License-Identifier: GPL-3.0-or-later
// The fit of core/fit: linear least squares whose weights follow the fit.
#pragma once

#include "core/fit/fit_shear.hpp"

#include <Eigen/Dense>

namespace plyform {

/// 1 / max(fitted, floor): see the top of fit_shear.hpp.
inline Eigen::ArrayXd fit_weights(const Eigen::VectorXd& fitted, const Eigen::VectorXd& measured) {
  return fitted.array().max(load_floor * measured.maxCoeff()).inverse();
}

/// Coefficients of the columns of `a`.
inline Eigen::VectorXd weighted_least_squares(const Eigen::MatrixXd& a,
                                              const Eigen::VectorXd& measured) {
  Eigen::VectorXd k, fitted = measured;
  constexpr int repeats = 20; // from weights of the measured load it settles in three or four
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
