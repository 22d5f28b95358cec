// SPDX-License-Identifier: GPL-3.0-or-later
// What a membrane resists by rates, beside core/ply/membrane.hpp, whose symbols these are: the law
// (V) of core/model/viscous_shear.hpp at each crossing of each triangle. Deviations within a pair
// count as shear here too, or they would flow in its place: the law acts on the three numbers
//
//   X = (gamma, sqrt(beta) delta_a, sqrt(beta) delta_b)
//
// alike, with a torque Q each: the first is that of the crossing, and the others add
//
//   held_a = n_c sqrt(beta) Q_a  to  d_a N_a, less its mean over the group, as t_a of (N)       (H)
//
// Springs in line with dashpots, of the stiffness k = d_a of the softer of the two families of a
// crossing (N/mm): n_c K = spring_share k for gamma, beta n_c K = deviation_share k for deviations.
// They add 2 spring_share + deviation_share of a yarn's stiffness to the bound of the step.
//
// Melt around yarns in one direction: an incompressible fluid that yarns along a make directed
// (Rogers 1989; Spencer 2000),
//   sigma = -p I + T a a + 2 eta_T d + 2 (eta_L - eta_T) (A d + d A),   A = a a
// In a ply without stress across it, whose yarns do not strain (d_aa = 0), with b across them in
// it: p = -2 eta_T d_bb, and per width, with h J = h_0 for constant volume,
//   J N_bb = 4 eta_T h_0 d_bb,   J N_ab = eta_L h_0 (2 d_ab)                                    (F)
// The state is in the axes a, b, which turn with the yarns. With C of the axes 1 (along the yarns)
// and 2 (across before), lambda = |k_1|, u = k_2 . a, v = k_2 . b, of changes of C in a step:
//   2 d_ab = C_12'/(lambda v) - u C_11'/(C_11 v)
//   d_bb   = C_22'/(2 v^2) - u C_12'/(lambda v^2) + u^2 C_11'/(2 C_11 v^2)
// and S of (Q) follows from S : C'/2 = J (N_bb d_bb + N_ab 2 d_ab). Its springs have the stiffness
// matrix_spring_share of the yarns' each.
//
// Here one triangle after the other; the kernel does four or eight (core/ply/viscous_simd.hpp).
#pragma once

#include "core/ply/membrane.hpp"

#include <span>
#include <vector>

namespace plyform {

constexpr double spring_share = 0.1, deviation_share = 0.2, matrix_spring_share = 0.1;

/// A crossing that resists by rates, and where its state is in that of a triangle.
struct ViscousCrossing {
  std::size_t crossing = 0; ///< index into Membrane::crossings
  ViscousShear law;
  std::size_t state = 0;      ///< X, Q of the dashpot, Q of each branch: three numbers each
  double rate_time = 0.0;     ///< s of the process, over which told rates are smoothed
  std::size_t rates() const { ///< state: the smoothed rate, and the largest that it had
    return state + 6 + 3 * law.branches.size();
  }
  std::size_t end() const { return rates() + 2; }
};

/// A melt around yarns in one direction.
struct ViscousSheet {
  double shear = 0.0, apart = 0.0; ///< N s/mm: eta_L h_0 and 4 eta_T h_0
  /// In the state of a triangle: C_11 - 1, C_22 - 1, C_12; J N_ab, J N_bb; then as of a crossing.
  std::size_t state = 0;
  double rate_time = 0.0;
  std::size_t rates() const { return state + 5; }
  std::size_t end() const { return rates() + 2; }
};

/// All that resists by rates in one membrane.
struct ViscousMembrane {
  std::vector<ViscousCrossing> crossings;
  std::optional<ViscousSheet> sheet;
  /// Numbers kept for a triangle: what it has lost since the start (N mm), then crossings. All are
  /// 0 at the start.
  std::size_t states = 1;
};

/// Sets the springs of the membrane's crossings (MembraneCrossing::spring), by which its bounds go.
/// stroke: s, of the process. Nothing if no law has rates.
std::optional<ViscousMembrane> make_viscous(Membrane& m, double stroke);

/// N mm, of all triangles: what springs of branches store, and what was lost since the start.
struct ViscousEnergy {
  double stored = 0.0, lost = 0.0;
};
ViscousEnergy viscous_energy(const ViscousMembrane& v, const Membrane& m,
                             std::span<const double> states);

/// What a triangle sees of rates and answers: of the first crossing that has any, else of the melt.
struct ShownRate {
  double rate = 0.0, largest = 0.0; ///< 1/s of the process, smoothed; the largest so far
  double shear = 0.0;               ///< N/mm, n_c times the torque by rates; J N_ab
};
ShownRate shown_rate(const ViscousMembrane& v, const Membrane& m, std::span<const double> states,
                     std::size_t e);

/// s of the process, by which a dashpot lags at most up to a shear angle of 45 degrees at a rate
/// (1/s).
double lag_of(const ViscousMembrane& v, const Membrane& m, double rate);

} // namespace plyform
