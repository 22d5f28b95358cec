// SPDX-License-Identifier: GPL-3.0-or-later
// The kernel of core/ply/bending_simd.hpp as its two compiled copies see it: plain numbers and
// pointers, nothing inline (contact/simd/simd.hpp says why).
#pragma once

#include "core/ply/simd_kernel.hpp"

namespace plyform {

struct BendingLaw;

constexpr int most_stencil_slots = 512; ///< their differences, 48 kB, are mostly not used
constexpr int most_bending_nodes =
    most_stencil_slots + 1; ///< of a block, more than most_block_nodes
                            ///< only if one stencil has so many

/// Four stencils of four nodes. A slot is a node of each, around its own. The slots of the ring
/// come first: each stencil's triangles are its own node and two slots that follow each other, the
/// last and the first slot included.
struct alignas(32) SimdPatches {
  double area[simd_width];        ///< mm^2, A0; 0 where a lane only fills up the group
  double in_plane[2][simd_width]; ///< N mm, D_g of warp and weft at the stencil's node
  std::uint16_t own[simd_width];  ///< bytes: 32 times the number in the block's list
  std::int32_t ring, slots;       ///< slots of the ring, of all; at most most_stencil_slots
};

/// Constants of (M), N mm.
struct BendingKernelLaw {
  double stiffness[2], coupling, twist;
  bool table; ///< ask `moment`
  bool in_plane;
  const BendingLaw* law;
  /// M_1 or M_2 (N) of four curvatures.
  void (*moment)(const BendingKernelLaw&, int family, const double* kappa, double* m);
};

/// StrainGroups that share a list of nodes. All arrays are the block's own.
struct BendingKernelBlock {
  const std::int32_t* nodes; ///< in the ply
  int node_count;
  const SimdPatches* stencils;
  int groups;
  const SimdNumbers* constants; ///< a slot: B_11, B_22, B_12; with in_plane A_1, A_2 more
  const std::uint16_t* slots;   ///< a slot: four nodes, as SimdPatches::own
  SimdForce* force;             ///< one a node
};

/// (F) + (I) of a block's stencils, added up at its nodes. x: 3 a node of the ply, mm.
void bending_kernel_generic(const BendingKernelBlock& block, const BendingKernelLaw& law,
                            const double* x);
void bending_kernel_avx2(const BendingKernelBlock& block, const BendingKernelLaw& law,
                         const double* x);

} // namespace plyform
