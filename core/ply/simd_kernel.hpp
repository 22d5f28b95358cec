// SPDX-License-Identifier: GPL-3.0-or-later
// Types that the kernels of membrane and bending share: plain numbers, nothing inline (reason:
// base/simd.hpp).
#pragma once

#include <cstdint>

namespace plyform {

constexpr int simd_width = 4; ///< triangles or nodes of a group, one per SIMD lane
/// Limit of nodes in a block: their positions and forces, 24 kB, fit into a 32 kB cache.
constexpr int most_block_nodes = 384;

/// Limits of families and crossings: those of core/model/fabric.hpp.
constexpr int most_kernel_families = 8, most_kernel_crossings = 8;

/// One number per SIMD lane.
struct alignas(32) SimdNumbers {
  double of[simd_width];
};

/// Force on a node of a block, N.
struct alignas(32) SimdForce {
  double x, y, z, unused;
};

} // namespace plyform
