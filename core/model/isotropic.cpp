// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/model/isotropic.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace plyform {

double isotropic_stiffness(const IsotropicLaw& law, const IsotropicState& s, double g11, double g22,
                           double g12) {
  const double nu = law.poissons_ratio;
  const double m11 = 1.0 + 2.0 * s.e11, m22 = 1.0 + 2.0 * s.e22, m12 = 2.0 * s.e12;
  const double root2 = std::sqrt(2.0);
  Eigen::Matrix3d m, c;
  m << m11 * g11, m12 * g12, (m11 * g12 + m12 * g11) / root2, //
      m12 * g12, m22 * g22, (m12 * g22 + m22 * g12) / root2,  //
      (m11 * g12 + m12 * g11) / root2, (m12 * g22 + m22 * g12) / root2,
      0.5 * (m11 * g22 + m22 * g11) + m12 * g12;
  const double sum = std::sqrt(1.0 + nu), difference = std::sqrt(1.0 - nu);
  const double p = 0.5 * (sum + difference), q = 0.5 * (sum - difference);
  c << p, q, 0.0, q, p, 0.0, 0.0, 0.0, difference; // C~^1/2 over that of C/(1 - nu^2)
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(c * m * c, Eigen::EigenvaluesOnly);
  const double material = law.modulus / (1.0 - nu * nu) * solver.eigenvalues()[2];
  const auto larger = [](double a, double b, double off) {
    return 0.5 * (a + b) + std::sqrt(0.25 * (a - b) * (a - b) + off * off);
  };
  return material + std::max(0.0, larger(s.s11, s.s22, s.s12)) * larger(g11, g22, g12);
}

} // namespace plyform
