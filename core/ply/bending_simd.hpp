// SPDX-License-Identifier: GPL-3.0-or-later
// Bending of core/ply/bending.hpp laid out for speed: four nodes side by side, in blocks whose
// nodes stay in a core's cache. reference_bending_forces there is the oracle of its test.
//
// A block gathers the places of its nodes, does its stencils, and adds their forces up at its own
// nodes. Blocks go by the mesh alone: the same bits for any number of threads.
#pragma once

#include "core/ply/bending.hpp"
#include "core/ply/bending_simd_kernel.hpp"
#include "core/ply/block_forces.hpp"

namespace plyform {

/// One block: ranges in the arrays of BendingSimd.
struct BendingBlock {
  int first_node = 0, nodes = 0;
  int first_group = 0, groups = 0;
  std::size_t first_slot = 0;
};

struct BendingSimd : BlockForces {
  std::vector<BendingBlock> blocks;
  std::vector<SimdPatches> stencils;
  std::vector<SimdNumbers> constants; ///< of `slots`, as in BendingKernelBlock
  std::vector<std::uint16_t> slots;   ///< of `stencils`, four each
};

/// x: the unformed ply; only says which nodes are neighbours. Throws std::length_error where more
/// than most_stencil_slots nodes lie around one.
BendingSimd make_bending_simd(const Bending& b, std::span<const Vec3> x);

/// (F) + (I) of a block's stencils on its nodes; simd_force (core/ply/block_forces.hpp) then has
/// the sum on a node.
void bending_forces(BendingSimd& l, const Bending& b, std::span<const Vec3> x, int block);

} // namespace plyform
