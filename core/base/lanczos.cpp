// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/lanczos.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace plyform {
double Scatter::next() {
  state_ = state_ * 6364136223846793005u + 1442695040888963407u; // Knuth's MMIX generator
  return static_cast<double>(state_ >> 11) * 0x1p-53 - 0.5;
}

RitzValue largest_ritz_value(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& apply,
                             const Eigen::VectorXd& start, int steps) {
  Eigen::VectorXd v = start.normalized();
  Eigen::VectorXd diagonal(steps), beside(std::max(0, steps - 1)), before;
  before.setZero(v.size());
  double last = 0.0;
  int found = 0;
  while (found < steps) {
    Eigen::VectorXd w = apply(v) - last * before;
    diagonal[found] = w.dot(v);
    w -= diagonal[found] * v;
    last = w.norm();
    ++found;
    // the Krylov space is exhausted
    if (found == steps || !(last > 1e-12 * std::abs(diagonal[0]))) break;
    beside[found - 1] = last;
    before = v;
    v = w / last;
  }
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(diagonal.head(found), beside.head(std::max(0, found - 1)),
                                Eigen::ComputeEigenvectors);
  // ascending; `last` couples the last vector with the one that would come next
  return {solver.eigenvalues()[found - 1],
          last * std::abs(solver.eigenvectors()(found - 1, found - 1))};
}

} // namespace plyform
