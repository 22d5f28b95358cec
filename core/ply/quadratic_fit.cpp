// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ply/quadratic_fit.hpp"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>

namespace plyform {

QuadraticFit fit_quadratic(std::span<const Vec2> x, const std::vector<int>& nodes,
                           const Vec2& origin, double size) {
  constexpr double least_ratio = 0.002; // of pivots; a regular patch has 0.01 to 0.1
  const auto count = static_cast<Eigen::Index>(nodes.size());
  Eigen::MatrixXd p(count, 6);
  Eigen::VectorXd weight(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Vec2 d = (x[nodes[static_cast<std::size_t>(i)]] - origin) / size;
    const double r = d.x(), s = d.y(), near = 1.0 / std::max(1.0, d.squaredNorm());
    p.row(i) << 1.0, r, s, 0.5 * r * r, 0.5 * s * s, r * s;
    weight[i] = near * near * near * near;
  }
  const Eigen::MatrixXd weighted = weight.asDiagonal() * p, values = weight.asDiagonal();
  QuadraticFit fit;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(weighted);
  const auto pivots = qr.matrixQR().diagonal().cwiseAbs();
  fit.determined = pivots.size() == 6 && pivots[5] >= least_ratio * pivots[0];
  if (fit.determined) {
    fit.rows = qr.solve(values);
  } else { // what a tiny mesh leaves open becomes 0
    Eigen::JacobiSVD<Eigen::MatrixXd> svd(weighted, Eigen::ComputeThinU | Eigen::ComputeThinV);
    svd.setThreshold(1e-6);
    fit.rows = svd.solve(values);
  }
  fit.rows.middleRows(1, 2) /= size;
  fit.rows.bottomRows(3) /= size * size;
  return fit;
}

} // namespace plyform
