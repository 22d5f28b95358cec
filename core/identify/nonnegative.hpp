// SPDX-License-Identifier: GPL-3.0-or-later
// Least squares whose unknowns must not be negative.
//
// Source: C. L. Lawson and R. J. Hanson, Solving Least Squares Problems, Prentice-Hall 1974,
// chapter 23 (algorithm NNLS), here on the normal equations; Eigen 3.4 has none.
#pragma once

#include <Eigen/Dense>

namespace plyform {

/// u >= 0 with the least |a u - b|; columns of `a` are scaled to length 1 first.
Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

} // namespace plyform
