// SPDX-License-Identifier: GPL-3.0-or-later
// Access of the kernels to data of a block's nodes: four doubles per node, addressed by byte
// offsets of 32 times the node's index in the block's list.
#pragma once

#include "contact/simd/simd.hpp"
#include "core/ply/simd_kernel.hpp"

namespace plyform {
namespace {

PLYFORM_INLINE const double* of_node(const double* first, std::uint16_t at) {
  return reinterpret_cast<const double*>(reinterpret_cast<const char*>(first) + at);
}
PLYFORM_INLINE double* of_node(double* first, std::uint16_t at) {
  return reinterpret_cast<double*>(reinterpret_cast<char*>(first) + at);
}

/// Copies the positions of a block's nodes, 4 numbers each, to `place`. x: 3 numbers per node of
/// the ply.
PLYFORM_INLINE void gather_places(const std::int32_t* nodes, int count, const double* x,
                                  double* place) {
  for (int i = 0; i < count; ++i) {
    const double* at = x + 3 * static_cast<std::int64_t>(nodes[i]);
    store(place + 4 * i, Double4{at[0], at[1], at[2], 0.0});
  }
}

} // namespace
} // namespace plyform
