// SPDX-License-Identifier: GPL-3.0-or-later
// An isotropic elastic membrane (St. Venant-Kirchhoff, plane stress): what a sheet of paper or foil
// does in the place of a fabric. It resists compression.
//
//   k_1, k_2  -     images of two unit vectors at right angles, as in core/ply/membrane.hpp
//   C = E t   N/mm  modulus times thickness;  nu  Poisson's ratio
//   E_ab = 1/2 (k_a . k_b - delta_ab)                                        Green's strain   (G)
//   S_11 = C/(1 - nu^2) (E_11 + nu E_22), S_22 likewise, S_12 = C/(1 + nu) E_12               (S)
//   w = 1/2 (S_11 E_11 + S_22 E_22 + 2 S_12 E_12)                            N mm per mm^2    (W)
//   q_a = A0 sum_b S_ab k_b, in the place of (Q)                                              (q)
#pragma once

#include "contact/geometry.hpp"

namespace plyform {

struct IsotropicLaw {
  double modulus = 0.0;       ///< C, N/mm
  double poissons_ratio = 0.; ///< nu
};

/// (G) and (S); stresses per length, N/mm.
struct IsotropicState {
  double e11, e22, e12, s11, s22, s12;
};

inline IsotropicState isotropic_state(const IsotropicLaw& law, const Vec3& k1, const Vec3& k2) {
  const double nu = law.poissons_ratio, plane = law.modulus / (1.0 - nu * nu);
  IsotropicState s;
  s.e11 = 0.5 * (k1.squaredNorm() - 1.0);
  s.e22 = 0.5 * (k2.squaredNorm() - 1.0);
  s.e12 = 0.5 * k1.dot(k2);
  s.s11 = plane * (s.e11 + nu * s.e22);
  s.s22 = plane * (s.e22 + nu * s.e11);
  s.s12 = law.modulus / (1.0 + nu) * s.e12;
  return s;
}

/// (W), N mm per mm^2.
inline double isotropic_energy(const IsotropicState& s) {
  return 0.5 * (s.s11 * s.e11 + s.s22 * s.e22) + s.s12 * s.e12;
}

/// Bound of the largest eigenvalue of H (G x I), N/mm^3: H the second derivative of (W) by k_1,
/// k_2, G_ab = c_a . c_b the 2 x 2 of the gradients (core/ply/membrane.hpp). In the components
/// (E_11, E_22, sqrt(2) E_12) the material part is C~ M, where C~ is the matrix of (S) and
///   M_(ab)(cd) = 1/4 (m_ac G_bd + m_ad G_bc + m_bc G_ad + m_bd G_ac),  m_ab = k_a . k_b;
/// its largest eigenvalue is exact, that of C~^1/2 M C~^1/2. The geometric part S x I adds at most
/// the larger principal stress, if it is tensile, times the larger eigenvalue of G.
double isotropic_stiffness(const IsotropicLaw& law, const IsotropicState& s, double g11, double g22,
                           double g12);

} // namespace plyform
