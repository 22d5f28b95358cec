// SPDX-License-Identifier: GPL-3.0-or-later
// An isotropic elastic membrane (St. Venant-Kirchhoff, plane stress), for sheets of paper or foil.
// It resists compression.
//
//   k_1, k_2  -     images of two unit vectors at right angles, as in core/ply/membrane.hpp
//   C = E t   N/mm  modulus times thickness;  nu  Poisson's ratio
//   E_ab = 1/2 (k_a . k_b - delta_ab)                                        Green's strain   (G)
//   S_11 = C/(1 - nu^2) (E_11 + nu E_22), S_22 likewise, S_12 = C/(1 + nu) E_12               (S)
//   w = 1/2 (S_11 E_11 + S_22 E_22 + 2 S_12 E_12)                            N mm per mm^2    (W)
#pragma once

#include "core/model/sheet_response.hpp"

namespace plyform {

struct IsotropicLaw {
  double modulus = 0.0;       ///< C, N/mm
  double poissons_ratio = 0.; ///< nu

  /// N/mm at rest: stress over the strain of one direction while the other's length is held, and
  /// over the angle of shear, S_12 / (2 E_12).
  double plane_stiffness() const { return modulus / (1.0 - poissons_ratio * poissons_ratio); }
  double shear_stiffness() const { return 0.5 * modulus / (1.0 + poissons_ratio); }

  /// (S) and (W).
  SheetResponse at(const Vec3& k1, const Vec3& k2) const;

  /// Bound of the largest eigenvalue of H (G x I), N/mm^3: H the second derivative of (W) by k_1,
  /// k_2, G_ab = c_a . c_b the 2 x 2 of the gradients (core/ply/membrane.hpp). In the components
  /// (E_11, E_22, sqrt(2) E_12) the material part is C~ M, where C~ is the matrix of (S) and
  ///   M_(ab)(cd) = 1/4 (m_ac G_bd + m_ad G_bc + m_bc G_ad + m_bd G_ac),  m_ab = k_a . k_b;
  /// its largest eigenvalue is exact, that of C~^1/2 M C~^1/2. The geometric part S x I adds at
  /// most the larger principal stress, if it is tensile, times the larger eigenvalue of G.
  double stiffness_bound(const Vec3& k1, const Vec3& k2, const Gram& g) const;
};

} // namespace plyform
