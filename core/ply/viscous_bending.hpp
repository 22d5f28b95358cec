// SPDX-License-Identifier: GPL-3.0-or-later
// What a ply resists by the rate of its curvatures, beside core/ply/bending.hpp, whose symbols
// these are: for each family of yarns, or direction of a plate,
//
//   M = M(kappa_f) + eta kappa_f',   eta  N mm s, the rate that of the process
//
// The dashpot has a spring in line, as that of shear and for the same reason
// (core/model/viscous_shear.hpp), whose stiffness adds bending_spring_share of that of taut yarns
// to the bound of omega^2. It is the same for all families, and small elements have a softer one: a
// dashpot lags by eta over it. Curvatures are those of the elastic moments, on the rim too. Here
// one node after the other; the kernel does four or eight (core/ply/viscous_simd.hpp).
#pragma once

#include "core/ply/bending.hpp"

#include <optional>
#include <span>
#include <vector>

namespace plyform {

constexpr double bending_spring_share = 0.15;

struct ViscousBending {
  std::vector<std::size_t> family; ///< of BendingLaw::families, those that are viscous
  std::vector<double> viscosity;   ///< eta, of each of these
  double spring = 0.0;             ///< N mm
  double omega2 = 0.0;             ///< 1/s^2, bound of the springs alone
  /// Numbers kept for a node: what it has lost since the start (N mm), then kappa_f and the viscous
  /// moment (N) of each family. All are 0 at the start.
  std::size_t states() const { return 1 + 2 * viscosity.size(); }
};

/// Whether a family is viscous.
bool has_viscosity(const BendingLaw& law);

/// Of a ply with this bending; nothing if no family is viscous. omega2: 1/s^2, bound of taut yarns.
std::optional<ViscousBending>
make_viscous_bending(Bending bending, std::span<const double> node_mass, double omega2);

/// N mm, of all nodes: what springs store, and what was lost since the start.
struct ViscousBendingEnergy {
  double stored = 0.0, lost = 0.0;
};
/// area: mm^2, of the cell of each node.
ViscousBendingEnergy viscous_bending_energy(const ViscousBending& v, std::span<const double> area,
                                            std::span<const double> states);

} // namespace plyform
