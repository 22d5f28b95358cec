// SPDX-License-Identifier: GPL-3.0-or-later
// The largest eigenvalue of a large symmetric matrix that is given by its products with vectors.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>

namespace plyform {

/// A Ritz value, and the norm of its vector's residual: an eigenvalue is no further from it than
/// that (Parlett, The Symmetric Eigenvalue Problem, 13.2).
struct RitzValue {
  double value = 0.0, residual = 0.0;
};

/// Largest Ritz value after `steps` of Lanczos' iteration (Golub and Van Loan, Matrix Computations,
/// ch. 10) on a symmetric operator: never more than the largest eigenvalue, and converging fast to
/// it if `start` (not zero) has a component along its eigenvector.
RitzValue largest_ritz_value(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& apply,
                             const Eigen::VectorXd& start, int steps);

/// Iterations for the highest frequency of a mesh; the Ritz value is 1 % low on meshes of 1e6
/// triangles.
constexpr int ritz_steps = 30;

/// The Ritz value and its residual, or three times the error that is left after ritz_steps if the
/// residual is more.
double upper_bound(const RitzValue& found);

/// Pseudo-random numbers between -0.5 and 0.5, the same sequence every time.
class RandomNumbers {
public:
  double next();

private:
  std::uint64_t state_ = 1;
};

} // namespace plyform
