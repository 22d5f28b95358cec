// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/lanczos.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace plyform {
double RandomNumbers::next() {
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
  // as a full matrix: computeFromTridiagonal of Eigen 3.4 fails where a number beside the diagonal
  // is next to nothing
  Eigen::MatrixXd t = Eigen::MatrixXd::Zero(found, found);
  t.diagonal() = diagonal.head(found);
  t.diagonal(1) = t.diagonal(-1) = beside.head(std::max(0, found - 1));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(t);
  // ascending; `last` couples the last vector with the one that would come next
  return {solver.eigenvalues()[found - 1],
          last * std::abs(solver.eigenvectors()(found - 1, found - 1))};
}

double upper_bound(const RitzValue& found) {
  constexpr double most = 0.03;
  return found.value + std::min(found.residual, most * found.value);
}

} // namespace plyform
