// SPDX-License-Identifier: GPL-3.0-or-later
// Bending of core/ply/bending.hpp, optimised: stencils of four nodes at a time (SIMD), in blocks
// whose nodes stay in a core's cache. Its test compares it with reference_bending_forces. It holds
// all that a run needs, so that the stencils of Bending, which take as much memory, need not be
// kept.
//
// A block gathers the positions of its nodes, computes its stencils, and sums their forces in its
// own list of nodes. Blocks depend on the mesh only: results are the same bits for any number of
// threads.
#pragma once

#include "core/ply/bending.hpp"
#include "core/ply/bending_simd_kernel.hpp"
#include "core/ply/block_forces.hpp"
#include "core/ply/shared_constants.hpp"

namespace plyform {

/// One block: ranges in the arrays of BendingSimd.
struct BendingBlock {
  int first_node = 0, nodes = 0;
  int first_group = 0, groups = 0;
  std::size_t first_slot = 0;
  int first_image = 0, images = 0;
};

struct BendingSimd : BlockForces {
  BendingLaw law;
  bool in_plane = false; ///< whether yarns bend in their plane
  double omega2 = 0.0;   ///< 1/s^2, as of Bending
  std::vector<BendingBlock> blocks;
  std::vector<SimdStencils> stencils;
  std::vector<SimdNumbers> of_yarns;      ///< of `stencils`: BendingKernelBlock::in_plane
  SharedConstants<SimdNumbers> constants; ///< of `slots`, as in BendingKernelBlock
  std::vector<std::uint16_t> slots;       ///< of `stencils`, four nodes each
  std::vector<BlockImage> images;         ///< of all blocks
  std::vector<KernelMirror> mirrors;
};

/// x: undeformed positions, used only to put neighbouring nodes into the same block. Throws
/// std::length_error if a stencil has more than most_stencil_slots nodes besides its centre.
BendingSimd make_bending_simd(const Bending& b, std::span<const Vec3> x);

/// Computes (F) + (I), N, of a block's stencils, stored in l.force; once all blocks are done
/// simd_force (core/ply/block_forces.hpp) sums them on a node. x: mm, one per node of the ply.
/// viscous: of all blocks (kernel_viscous of core/ply/viscous_simd.hpp), or null.
void bending_forces(BendingSimd& l, std::span<const Vec3> x, int block,
                    const KernelViscousBending* viscous = nullptr);

/// (E) + (G) summed over all nodes, N mm. x: mm, one per node.
double bending_energy(const BendingSimd& l, std::span<const Vec3> x);

} // namespace plyform
