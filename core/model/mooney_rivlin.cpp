// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/model/mooney_rivlin.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

/// C - 1, its trace, its determinant, D - 1 and D.
struct RubberStrain {
  double e11, e22, e12, trace, minor, growth, det;
};

RubberStrain strain_of(const Vec3& k1, const Vec3& k2) {
  RubberStrain s;
  s.e11 = k1.squaredNorm() - 1.0;
  s.e22 = k2.squaredNorm() - 1.0;
  s.e12 = k1.dot(k2);
  s.trace = s.e11 + s.e22;
  s.minor = s.e11 * s.e22 - s.e12 * s.e12;
  s.growth = s.trace + s.minor;
  s.det = 1.0 + s.growth;
  return s;
}

/// (S) and (W).
SheetResponse response_of(const MooneyRivlinLaw& law, const RubberStrain& s) {
  const double d = s.growth, inv = 1.0 / s.det, inv2 = inv * inv;
  const double q = d * (2.0 + d) - s.trace; // D^2 - tr C + 1
  // 1 - C_22 / D^2 and 1/D + C_22 (1 - tr C / D^2), over D^2
  const auto normal = [&](double other) {
    return 2.0 * inv2 *
           (law.c10 * (d * (2.0 + d) - other) + law.c01 * (d - other + q * (1.0 + other)));
  };
  SheetResponse r;
  r.s11 = normal(s.e22);
  r.s22 = normal(s.e11);
  r.s12 = 2.0 * inv2 * s.e12 * (law.c10 + law.c01 * (1.0 - q));
  r.energy = inv * (law.c10 * (s.trace * d - s.minor) + law.c01 * (d * d - s.minor));
  return r;
}

/// 4 (H) in the components (C_11, C_22, sqrt(2) C_12), N/mm.
Eigen::Matrix3d material_part(const MooneyRivlinLaw& law, const RubberStrain& s) {
  const double inv = 1.0 / s.det, inv2 = inv * inv, trace = 2.0 + s.trace;
  const Eigen::Vector3d one(1.0, 1.0, 0.0),
      k(1.0 + s.e22, 1.0 + s.e11, -std::sqrt(2.0) * s.e12); // K
  Eigen::Matrix3d turn;                                     // dK/dC
  turn << 0, 1, 0, 1, 0, 0, 0, 0, -1;
  return 4.0 * (-law.c01 * inv2 * (one * k.transpose() + k * one.transpose()) +
                2.0 * (law.c10 + law.c01 * trace) * inv2 * inv * (k * k.transpose()) +
                (law.c01 - (law.c10 + law.c01 * trace) * inv2) * turn);
}

/// M of IsotropicLaw::stiffness_bound.
Eigen::Matrix3d metric_of(const RubberStrain& s, const Gram& g) {
  const double m11 = 1.0 + s.e11, m22 = 1.0 + s.e22, m12 = s.e12, root2 = std::sqrt(2.0);
  Eigen::Matrix3d m;
  m << m11 * g.g11, m12 * g.g12, (m11 * g.g12 + m12 * g.g11) / root2, //
      m12 * g.g12, m22 * g.g22, (m12 * g.g22 + m22 * g.g12) / root2,  //
      (m11 * g.g12 + m12 * g.g11) / root2, (m12 * g.g22 + m22 * g.g12) / root2,
      0.5 * (m11 * g.g22 + m22 * g.g11) + m12 * g.g12;
  return m;
}

/// Largest eigenvalue of the product of a symmetric matrix and a positive one, or 0 if it is
/// negative; a bound by norms where rounding has left the second no longer positive.
template <class Matrix>
double largest_of_product(const Matrix& a, const Matrix& positive) {
  const Eigen::LLT<Matrix> root(positive);
  if (root.info() != Eigen::Success) return a.norm() * positive.norm();
  const Matrix l = root.matrixL();
  Eigen::SelfAdjointEigenSolver<Matrix> solver;
  solver.computeDirect(l.transpose() * a * l, Eigen::EigenvaluesOnly);
  return std::max(0.0, solver.eigenvalues().maxCoeff());
}

} // namespace

SheetResponse MooneyRivlinLaw::at(const Vec3& k1, const Vec3& k2) const {
  return response_of(*this, strain_of(k1, k2));
}

double MooneyRivlinLaw::stiffness_bound(const Vec3& k1, const Vec3& k2, const Gram& g) const {
  const RubberStrain s = strain_of(k1, k2);
  const SheetResponse r = response_of(*this, s);
  Eigen::Matrix2d stress, gram;
  stress << r.s11, r.s12, r.s12, r.s22;
  gram << g.g11, g.g12, g.g12, g.g22;
  return largest_of_product<Eigen::Matrix3d>(material_part(*this, s), metric_of(s, g)) +
         largest_of_product<Eigen::Matrix2d>(stress, gram);
}

double uniaxial_load(const MooneyRivlinLaw& law, double stretch) {
  return 2.0 * (stretch - 1.0 / (stretch * stretch)) * (law.c10 + law.c01 / stretch);
}

double equibiaxial_load(const MooneyRivlinLaw& law, double stretch) {
  return 2.0 * (stretch - std::pow(stretch, -5.0)) * (law.c10 + law.c01 * stretch * stretch);
}

std::optional<Softening> softening_of(const MooneyRivlinLaw& law) {
  constexpr int steps = 900;
  constexpr double step = 0.01;
  for (int i = 0; i < steps; ++i) {
    const double begin = 1.0 + step * i, end = begin + step;
    if (!(uniaxial_load(law, end) > uniaxial_load(law, begin))) return Softening{begin, false};
    if (!(equibiaxial_load(law, end) > equibiaxial_load(law, begin))) return Softening{begin, true};
  }
  return std::nullopt;
}

} // namespace plyform
