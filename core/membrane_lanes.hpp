// SPDX-License-Identifier: GPL-3.0-or-later
// The membrane of core/membrane.hpp laid out for speed: four patches side by side, in blocks whose
// nodes stay in a core's cache. What membrane.hpp computes one triangle after the other is the
// oracle of its test.
//
// A block gathers the places of its nodes, does its patches, and adds their forces up at its own
// nodes: no triangle's force goes to memory. A node on the border of blocks has a force from each;
// they are added in the order of the blocks, by whoever moves the node.
#pragma once

#include "core/membrane.hpp"
#include "core/membrane_kernel.hpp"

namespace plyform {

/// One block: ranges in the arrays of MembraneLanes.
struct LaneBlock {
  int first_node = 0, nodes = 0;
  int first_triangles = 0, first_group = 0;
  int pair_groups = 0, single_groups = 0;
};

/// Where a node's forces are in MembraneLanes::force. Most nodes belong to one block; then the
/// second is the zero at its end, so that reading it is a matter of no branch.
struct NodeForces {
  std::int32_t first = 0;
  std::int32_t second = 0; ///< below 0: there are more, from ~second in MembraneLanes::more
};

struct MembraneLanes {
  std::vector<LaneBlock> blocks;
  std::vector<std::int32_t> nodes;      ///< of the blocks, in the ply
  std::vector<LaneTriangles> triangles; ///< of the blocks, pairs first
  std::vector<LaneViscosity> viscosity; ///< one a group of four patches
  std::vector<LaneForce> force;         ///< one each of `nodes`, and a zero
  std::vector<NodeForces> force_of;     ///< one a node of the ply, ascending
  std::vector<std::int32_t> more;       ///< how many, then these, of nodes with more than two
};

/// Whether the kernel knows this membrane: it has yarns.
bool fits_lanes(const Membrane& m);

/// x: the unformed ply, 2 or 3 coordinates alike in order; only says which patches are neighbours.
MembraneLanes make_lanes(const Membrane& m, std::span<const Vec3> x);

/// Internal forces of a block's patches on its nodes, viscous ones included; dt and the report as
/// element_forces (core/membrane.hpp).
PatchReport lane_forces(MembraneLanes& lanes, const Membrane& m, std::span<const Vec3> x, double dt,
                        int block);

/// Energies of a block's patches; membrane_energy is their sum.
MembraneEnergy lane_energy(const MembraneLanes& lanes, const Membrane& m, std::span<const Vec3> x,
                           int block);

/// N, internal force on a node of the ply, after lane_forces of all blocks.
inline Vec3 lane_force(const MembraneLanes& l, std::size_t node) {
  const auto force = [&l](std::int32_t i) {
    const LaneForce& f = l.force[static_cast<std::size_t>(i)];
    return Vec3(f.x, f.y, f.z);
  };
  const NodeForces of = l.force_of[node];
  if (of.second >= 0) [[likely]]
    return force(of.first) + force(of.second);
  Vec3 sum = force(of.first);
  const std::int32_t* more = &l.more[static_cast<std::size_t>(~of.second)];
  for (std::int32_t i = 1; i <= more[0]; ++i)
    sum += force(more[i]);
  return sum;
}

} // namespace plyform
