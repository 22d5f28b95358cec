// SPDX-License-Identifier: GPL-3.0-or-later
// The stiffness of a sheet's law by differences of its stress, against which bounds are held.
#pragma once

#include "base/geometry.hpp"

#include <Eigen/Eigenvalues>

namespace plyform {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

/// Second derivative of a law's energy by k_1 and k_2, by differences of (Q) of
/// core/ply/membrane.hpp.
template <class Law>
Mat6 hessian_of(const Law& law, const Vec6& k) {
  const auto stress = [&](const Vec6& at) {
    const Vec3 k1 = at.head<3>(), k2 = at.tail<3>();
    const auto s = law.at(k1, k2);
    Vec6 q;
    q << s.s11 * k1 + s.s12 * k2, s.s12 * k1 + s.s22 * k2;
    return q;
  };
  Mat6 hessian;
  const double h = 1e-5;
  for (int j = 0; j < 6; ++j)
    hessian.col(j) = (stress(k + h * Vec6::Unit(j)) - stress(k - h * Vec6::Unit(j))) / (2.0 * h);
  return 0.5 * (hessian + hessian.transpose());
}

/// Largest eigenvalue of the stiffness of a triangle whose gradients are the columns of c.
template <class Law>
double largest_stiffness(const Law& law, const Vec6& k, const Eigen::Matrix2d& c) {
  Mat6 gradients = Mat6::Zero(); // c x I
  for (int i = 0; i < 4; ++i)
    gradients.block<3, 3>(3 * (i / 2), 3 * (i % 2)) = c(i / 2, i % 2) * Eigen::Matrix3d::Identity();
  const Mat6 stiffness = gradients * hessian_of(law, k) * gradients.transpose();
  const Eigen::SelfAdjointEigenSolver<Mat6> solver(stiffness, Eigen::EigenvaluesOnly);
  return solver.eigenvalues().maxCoeff();
}

} // namespace plyform
