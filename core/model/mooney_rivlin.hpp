// SPDX-License-Identifier: GPL-3.0-or-later
// A membrane of incompressible rubber in plane stress: Mooney and Rivlin, and with C01 = 0 the
// neo-Hookean solid. Any stretches. It resists compression: whether a sheet is slack until it is
// taut is left to its bending.
//
//   k_1, k_2  -     images of two unit vectors at right angles, as in core/ply/membrane.hpp
//   C10, C01  N/mm  constants times the thickness before forming; mu = 2 (C10 + C01) at rest
//   C_ab = k_a . k_b = delta_ab + e_ab;  D = det C,  K_ab = dD/dC_ab (its cofactors)
//   lambda_3^2 = 1/D                                             of the thickness, constant volume
//   I1 = tr C + 1/D,   I2 = D + tr C / D                                              (I)
//   w = C10 (I1 - 3) + C01 (I2 - 3)                              N mm per mm^2        (W)
//   S = 2 (C10 + C01/D) 1 + 2 (C01 - C10/D^2 - C01 tr C / D^2) K                      (S)
//
// (W) and (S) are computed from e, in forms without differences of numbers near 1, so that they are
// right to rounding at small strains too.
//
// Sources: M. Mooney, J. Appl. Phys. 11 (1940) 582-592; R. S. Rivlin, Phil. Trans. R. Soc. A 241
// (1948) 379-397; L. R. G. Treloar, The Physics of Rubber Elasticity, 3rd ed. (1975), ch. 4, 5.
#pragma once

#include "core/model/sheet_response.hpp"

#include <optional>

namespace plyform {

struct MooneyRivlinLaw {
  double c10 = 0.0, c01 = 0.0; ///< N/mm

  /// mu times the thickness, N/mm.
  double shear_modulus() const { return 2.0 * (c10 + c01); }
  /// N/mm at rest, as of IsotropicLaw: E = 3 mu, nu = 1/2.
  double plane_stiffness() const { return 4.0 * shear_modulus(); }
  double shear_stiffness() const { return shear_modulus(); }

  /// (S) and (W). Infinite where the sheet has no area left.
  SheetResponse at(const Vec3& k1, const Vec3& k2) const;

  /// Bound of the largest eigenvalue of H (G x I), N/mm^3: H the second derivative of (W) by k_1,
  /// k_2, G_ab = c_a . c_b the 2 x 2 of the gradients (core/ply/membrane.hpp). In the components
  /// (C_11, C_22, sqrt(2) C_12) the material part is 4 d^2w/dC^2 M,
  ///   d^2w/dC^2 = -C01/D^2 (1 K^T + K 1^T) + 2 (C10 + C01 tr C)/D^3 K K^T
  ///               + (C01 - C10/D^2 - C01 tr C / D^2) dK/dC                                (H)
  /// with M of IsotropicLaw::stiffness_bound. Its largest eigenvalue, that of L^T 4 d^2w/dC^2 L
  /// with M = L L^T, and that of the geometric part S G are exact; the bound is their sum, of which
  /// negative ones do not count.
  double stiffness_bound(const Vec3& k1, const Vec3& k2, const Gram& g) const;
};

/// Loads per width before forming, N/mm, of a sheet stretched to `stretch` along one direction:
/// uniaxial, free across it; equibiaxial, stretched as much across it.
///   2 (l - 1/l^2) (C10 + C01/l),  2 (l - 1/l^5) (C10 + C01 l^2)                             (N)
double uniaxial_load(const MooneyRivlinLaw& law, double stretch);
double equibiaxial_load(const MooneyRivlinLaw& law, double stretch);

/// Where a law with a negative constant becomes unstable: the stretch beyond which a load of (N)
/// falls.
struct Softening {
  double stretch = 0.0;
  bool equibiaxial = false; ///< or uniaxial
};

/// The first of both, between stretches of 1 and 10; nothing if loads rise.
std::optional<Softening> softening_of(const MooneyRivlinLaw& law);

} // namespace plyform
