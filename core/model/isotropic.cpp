// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/model/isotropic.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

/// (G) and (S).
struct State {
  double e11, e22, e12, s11, s22, s12;
};

State state_of(const IsotropicLaw& law, const Vec3& k1, const Vec3& k2) {
  const double nu = law.poissons_ratio, plane = law.modulus / (1.0 - nu * nu);
  State s;
  s.e11 = 0.5 * (k1.squaredNorm() - 1.0);
  s.e22 = 0.5 * (k2.squaredNorm() - 1.0);
  s.e12 = 0.5 * k1.dot(k2);
  s.s11 = plane * (s.e11 + nu * s.e22);
  s.s22 = plane * (s.e22 + nu * s.e11);
  s.s12 = law.modulus / (1.0 + nu) * s.e12;
  return s;
}

} // namespace

SheetResponse IsotropicLaw::at(const Vec3& k1, const Vec3& k2) const {
  const State s = state_of(*this, k1, k2);
  return {s.s11, s.s22, s.s12, 0.5 * (s.s11 * s.e11 + s.s22 * s.e22) + s.s12 * s.e12};
}

double IsotropicLaw::stiffness_bound(const Vec3& k1, const Vec3& k2, const Gram& g) const {
  const State s = state_of(*this, k1, k2);
  const double nu = poissons_ratio;
  const double m11 = 1.0 + 2.0 * s.e11, m22 = 1.0 + 2.0 * s.e22, m12 = 2.0 * s.e12;
  const double root2 = std::sqrt(2.0);
  Eigen::Matrix3d m, c;
  m << m11 * g.g11, m12 * g.g12, (m11 * g.g12 + m12 * g.g11) / root2, //
      m12 * g.g12, m22 * g.g22, (m12 * g.g22 + m22 * g.g12) / root2,  //
      (m11 * g.g12 + m12 * g.g11) / root2, (m12 * g.g22 + m22 * g.g12) / root2,
      0.5 * (m11 * g.g22 + m22 * g.g11) + m12 * g.g12;
  const double sum = std::sqrt(1.0 + nu), difference = std::sqrt(1.0 - nu);
  const double p = 0.5 * (sum + difference), q = 0.5 * (sum - difference);
  c << p, q, 0.0, q, p, 0.0, 0.0, 0.0, difference; // C~^1/2 over that of C/(1 - nu^2)
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(c * m * c, Eigen::EigenvaluesOnly);
  const double material = modulus / (1.0 - nu * nu) * solver.eigenvalues()[2];
  const auto larger = [](double a, double b, double off) {
    return 0.5 * (a + b) + std::sqrt(0.25 * (a - b) * (a - b) + off * off);
  };
  return material + std::max(0.0, larger(s.s11, s.s22, s.s12)) * larger(g.g11, g.g22, g.g12);
}

} // namespace plyform
