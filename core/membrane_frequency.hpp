// SPDX-License-Identifier: GPL-3.0-or-later
// Highest frequency of a membrane, which limits the stable step of explicit integration.
//
//   omega_e  1/s   largest of one element's M_e^-1 K_e: a bound of the mesh (Irons)
//   omega    1/s   largest of M^-1 K, found by Lanczos' iteration; up to a quarter below omega_e
//   M        t     lumped masses;  K  N/mm  tangent stiffness, all yarns taken as taut (or pressed
//                  flat, where that is stiffer)
//   y        mm    K y = - sum of (F) of core/membrane.hpp with N_a of the small strains that y
//                  makes: eps_a = f_a . sum_n c_a,n y_n                                        (K)
#pragma once

#include "core/membrane.hpp"

namespace plyform {

/// Bounds of one ply at its present shape, by Irons.
struct FrequencyBound {
  double omega2 = 0.0;  ///< 1/s^2
  double damping = 0.0; ///< 1/s, of M^-1 C
  int triangle = -1;    ///< where
};
FrequencyBound frequency_bound(const Membrane& m, std::span<const Vec3> x);

/// Largest omega^2 (1/s^2) at shape x (mm), two or three per cent on the safe side: Ritz value of
/// the yarns' stiffness, with a margin for what the iteration has not found, and Irons' bound for
/// shear and tension. Never above frequency_bound. For a sheet without yarns that bound.
double highest_omega2(const Membrane& m, std::span<const Vec3> x);

} // namespace plyform
