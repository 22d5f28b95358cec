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

struct MembraneLanes {
  std::vector<LaneBlock> blocks;
  std::vector<std::int32_t> nodes;       ///< of the blocks, in the ply
  std::vector<LaneTriangles> triangles;  ///< of the blocks, pairs first
  std::vector<LaneViscosity> viscosity;  ///< one a group of four patches
  std::vector<LaneForce> force;          ///< one each of `nodes`
  std::vector<std::int32_t> force_begin; ///< nodes of the ply + 1, into force_of
  std::vector<std::int32_t> force_of;    ///< entries of `force`, ascending
};

/// Whether the kernel knows this membrane: it has yarns.
bool fits_lanes(const Membrane& m);

/// x: the unformed ply, 2 or 3 coordinates alike in order; only says which patches are neighbours.
MembraneLanes make_lanes(const Membrane& m, std::span<const Vec3> x);

/// Internal forces of a block's patches on its nodes, viscous ones included; dt and the report as
/// element_forces (core/membrane.hpp).
PatchReport lane_forces(MembraneLanes& lanes, const Membrane& m, std::span<const Vec3> x, double dt,
                        int block);

/// N, internal force on a node of the ply, after lane_forces of all blocks.
inline Vec3 lane_force(const MembraneLanes& l, std::size_t node) {
  const auto begin = static_cast<std::size_t>(l.force_begin[node]);
  const auto end = static_cast<std::size_t>(l.force_begin[node + 1]);
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = begin; i < end; ++i) {
    const LaneForce& f = l.force[static_cast<std::size_t>(l.force_of[i])];
    sum += Vec3(f.x, f.y, f.z);
  }
  return sum;
}

} // namespace plyform
