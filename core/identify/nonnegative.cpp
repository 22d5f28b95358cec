// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/nonnegative.hpp"

#include <algorithm>
#include <vector>

namespace plyform {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Least squares of the unknowns that are free, the others 0.
VectorXd solved_for(const Eigen::MatrixXd& normal, const VectorXd& right,
                    const std::vector<Index>& free) {
  VectorXd u = VectorXd::Zero(right.size());
  if (free.empty()) return u;
  const Eigen::MatrixXd own = normal(free, free);
  const VectorXd of_own = right(free);
  u(free) = VectorXd(own.ldlt().solve(of_own));
  return u;
}

} // namespace

VectorXd nonnegative_least_squares(const Eigen::MatrixXd& a, const VectorXd& b) {
  const Index n = a.cols();
  const VectorXd scale = a.colwise().norm().transpose().cwiseMax(1e-300).cwiseInverse();
  const Eigen::MatrixXd scaled = a * scale.asDiagonal();
  const Eigen::MatrixXd normal = scaled.transpose() * scaled;
  const VectorXd right = scaled.transpose() * b;
  const double small = 1e-12 * right.cwiseAbs().maxCoeff();
  VectorXd u = VectorXd::Zero(n);
  std::vector<Index> free;
  for (Index round = 0; round < 3 * n; ++round) {
    VectorXd gain = right - normal * u;
    for (const Index i : free)
      gain[i] = 0.0;
    Index next = 0;
    if (!(gain.maxCoeff(&next) > small)) break;
    free.push_back(next);
    VectorXd wanted = solved_for(normal, right, free);
    while (!free.empty() && wanted(free).minCoeff() <= 0.0) { // back to where the first one is 0
      double step = 1.0;
      for (const Index i : free)
        if (wanted[i] <= 0.0) step = std::min(step, u[i] / (u[i] - wanted[i]));
      u += step * (wanted - u);
      const double nothing = 1e-14 * u.cwiseAbs().maxCoeff();
      std::erase_if(free, [&](Index i) { return wanted[i] <= 0.0 && u[i] <= nothing; });
      VectorXd kept = VectorXd::Zero(n);
      kept(free) = u(free);
      u = kept;
      wanted = solved_for(normal, right, free);
    }
    u = wanted;
  }
  return u.cwiseProduct(scale);
}

} // namespace plyform
