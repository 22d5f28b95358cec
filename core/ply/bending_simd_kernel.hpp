// SPDX-License-Identifier: GPL-3.0-or-later
// Interface of the compiled copies of the kernel of core/ply/bending_simd.hpp: plain numbers
// and pointers, nothing inline (reason: base/simd.hpp).
#pragma once

#include "core/ply/simd_kernel.hpp"

namespace plyform {

struct BendingLaw;
struct KernelViscousBending;

constexpr int most_stencil_slots = 512; ///< limit of nodes in a stencil besides its centre node
/// Limit of nodes in a block; a block exceeds most_block_nodes only for one such stencil.
constexpr int most_bending_nodes = most_stencil_slots + 1;

/// The stencils of four nodes. A slot holds one node of each stencil other than its centre node.
/// The slots of the ring come first: the triangles around the centre node consist of it and two
/// successive ring slots, cyclically.
struct alignas(32) SimdStencils {
  double area[simd_width];       ///< mm^2, A0; 0 in SIMD lanes without a stencil
  std::uint16_t own[simd_width]; ///< centre node as byte offset: 32 times its index in the block
  std::int32_t ring, slots;      ///< number of slots in the ring, in all (<= most_stencil_slots)
};

/// A family, or direction of a plate.
struct BendingKernelFamily {
  double along[2];   ///< v_f
  double of_axes[3]; ///< p of (M)
  bool table;        ///< call `moment`: its law is not in `stiffness`
};

/// Constants of (M), N mm, and the callback for tabulated laws.
struct BendingKernelLaw {
  /// Of all linear laws together: m_11 and m_22 against their own curvature, against the other's,
  /// and against kappa_12.
  double stiffness[2], coupling, oblique[2];
  double twist; ///< m_12 against kappa_12
  int families;
  BendingKernelFamily family[most_kernel_families];
  bool weave; ///< two families along the axes: `oblique` is zero
  bool table; ///< whether any family has one
  bool in_plane;
  const KernelViscousBending* viscous; ///< of the block; or null
  const BendingLaw* law;
  /// M_f (N) of four curvatures (1/mm).
  void (*moment)(const BendingKernelLaw&, int family, const double* kappa, double* m);
};

/// A node of a block that is the mirror image of the ply's node.
struct BlockImage {
  std::int32_t entry;  ///< of the block's nodes
  std::int32_t mirror; ///< number of its mirror
};

/// x goes over to turn x + shift; mm.
struct KernelMirror {
  double turn[9], shift[3]; ///< turn: by rows, its own inverse
};

/// Stencils that share a list of nodes. All arrays are those of the block.
struct BendingKernelBlock {
  const std::int32_t* nodes; ///< node numbers in the ply
  int node_count;
  const SimdStencils* stencils;
  int groups;
  const SimdNumbers* constants; ///< per slot: B_11, B_22, B_12 and, with in_plane, A_1, A_2
  const std::uint16_t* slots;   ///< per slot: four nodes, as SimdStencils::own
  /// With in_plane: D_g (N mm) of the families at the nodes of the first group, of the second ...
  const SimdNumbers* in_plane;
  SimdForce* force; ///< N, one per node of the block
  const BlockImage* images = nullptr;
  int image_count = 0;
  const KernelMirror* mirrors = nullptr;
};

/// (F) + (I), N, of a block's stencils, summed in block.force. x: mm, 3 numbers per node of the
/// ply.
void bending_kernel_generic(const BendingKernelBlock& block, const BendingKernelLaw& law,
                            const double* x);
void bending_kernel_avx2(const BendingKernelBlock& block, const BendingKernelLaw& law,
                         const double* x);
void bending_kernel_avx512(const BendingKernelBlock& block, const BendingKernelLaw& law,
                           const double* x);

} // namespace plyform
