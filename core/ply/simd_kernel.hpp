// SPDX-License-Identifier: GPL-3.0-or-later
// What the kernels that go through blocks of a ply have in common, as their two compiled copies see
// it: plain numbers (contact/simd/simd.hpp says why).
#pragma once

#include <cstdint>

namespace plyform {

constexpr int simd_width = 4; ///< triangles or nodes side by side
constexpr int most_block_nodes =
    384; ///< their places and forces, 24 kB, leave a 32 kB cache some room

/// One number of each lane.
struct alignas(32) SimdNumbers {
  double of[simd_width];
};

/// N, on a node of a block.
struct alignas(32) SimdForce {
  double x, y, z, unused;
};

} // namespace plyform
