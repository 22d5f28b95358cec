// SPDX-License-Identifier: GPL-3.0-or-later
// What a ply resists by the rate of its curvatures, beside core/ply/bending.hpp, whose symbols
// these are: for each family of yarns, or direction of a plate,
//
//   M = M(kappa_f) + eta kappa_f',   eta  N mm s, the rate that of the process
//
// The dashpot has a spring in line, as that of shear and for the same reason
// (core/model/viscous_shear.hpp), whose stiffness adds bending_spring_share of that of taut yarns
// to the bound of omega^2. It is the same for all families, and small elements have a softer one: a
// dashpot lags by eta over it. One node after the other.
#pragma once

#include "core/ply/bending.hpp"

#include <optional>
#include <span>
#include <vector>

namespace plyform {

constexpr double bending_spring_share = 0.15;

struct ViscousBending {
  Bending bending;               ///< its law is that of the springs
  std::vector<double> viscosity; ///< eta, of each family
  double spring = 0.0;           ///< N mm
  /// Numbers kept for a node: what it has lost since the start (N mm), then kappa_f and the viscous
  /// moment (N) of each family. All are 0 at the start.
  std::size_t states() const { return 1 + 2 * viscosity.size(); }
};

/// Nothing if no family is viscous. omega2: 1/s^2, bound of taut yarns; others: as make_bending.
std::optional<ViscousBending> make_viscous_bending(std::span<const Vec2> x,
                                                   const std::vector<Triangle>& triangles,
                                                   const BendingLaw& law, double axis1,
                                                   double axis2, std::span<const double> node_mass,
                                                   double omega2);

/// Forces (N) on all nodes at positions x (mm). dt: s of the process, of the step that led to x; 0
/// at the start. begin, end: `states` numbers of the first node, of the second ... factors: of the
/// viscosity at each node, or empty: 1.
void viscous_bending_forces(const ViscousBending& v, std::span<const Vec3> x, double dt,
                            std::span<const double> begin, std::span<double> end,
                            std::vector<Vec3>& force, std::span<const double> factors = {});

/// N mm, of all nodes: what springs store, and what was lost since the start.
struct ViscousBendingEnergy {
  double stored = 0.0, lost = 0.0;
};
ViscousBendingEnergy viscous_bending_energy(const ViscousBending& v,
                                            std::span<const double> states);

} // namespace plyform
