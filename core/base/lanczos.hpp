// SPDX-License-Identifier: GPL-3.0-or-later
// The largest eigenvalue of a large symmetric matrix that is known by its products with vectors.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>

namespace plyform {

/// Largest Ritz value after `steps` of Lanczos' iteration (Golub and Van Loan, Matrix Computations,
/// ch. 10) on a symmetric operator: never more than the largest eigenvalue, and soon near it if
/// `start`, not zero, has a share of every mode.
double largest_ritz_value(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& apply,
                          const Eigen::VectorXd& start, int steps);

/// Numbers between -0.5 and 0.5 without pattern, the same every time.
class Scatter {
public:
  double next();

private:
  std::uint64_t state_ = 1;
};

} // namespace plyform
