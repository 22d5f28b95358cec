// SPDX-License-Identifier: GPL-3.0-or-later
// Access of the kernels to data of a block's nodes: four doubles per node, addressed by byte
// offsets of 32 times the node's index in the block's list.
#pragma once

#include "base/simd.hpp"
#include "core/ply/simd_kernel.hpp"

namespace plyform {
namespace {

PLYFORM_INLINE const double* of_node(const double* first, std::uint16_t at) {
  return reinterpret_cast<const double*>(reinterpret_cast<const char*>(first) + at);
}
PLYFORM_INLINE double* of_node(double* first, std::uint16_t at) {
  return reinterpret_cast<double*>(reinterpret_cast<char*>(first) + at);
}

/// What is computed together, one per quad; if there are fewer (count), the other quads repeat the
/// first.
template <class T>
struct OfQuads {
  T* of[quads];
  int count;
};

/// Of `left` that there are, `stride` apart.
template <class T>
PLYFORM_INLINE OfQuads<T> of_quads(T* first, int stride, int left) {
  OfQuads<T> some;
  some.count = left < quads ? left : quads;
  for (int q = 0; q < quads; ++q)
    some.of[q] = first + (q < some.count ? stride * q : 0);
  return some;
}

/// A compile-time integer, passed as an argument.
template <int n>
struct Count {
  constexpr operator int() const { return n; }
};

/// What a kernel is compiled for: two families along the axes (of a membrane with one crossing and
/// no law of the sheet) and so many directions of stitches behind them, whose loops are unrolled;
/// or any fabric.
template <int directions>
struct StitchedWeave {
  static constexpr int most_families = 2 + directions, most_crossings = 1, stitches = directions;
  static constexpr bool weave = true;
};
using Weave = StitchedWeave<0>;
struct AnyFabric {
  static constexpr int most_families = most_kernel_families;
  static constexpr int most_crossings = most_kernel_crossings;
  static constexpr bool weave = false;
};

/// Calls each(a) for all families of yarns.
template <class Of, class Each>
PLYFORM_INLINE void for_families(int families, const Each& each) {
  if constexpr (Of::weave) {
    each(Count<0>{}), each(Count<1>{});
  } else {
    for (int a = 0; a < families; ++a)
      each(a);
  }
}

/// Numbers of all lanes; numbers_of: quad to four numbers.
template <class Numbers>
PLYFORM_INLINE Doubles numbers(const Numbers& numbers_of) {
  Double4 four[quads];
  for (int q = 0; q < quads; ++q)
    four[q] = load(numbers_of(q));
  return joined(four);
}

/// A law that is known for four numbers: law(at, out).
template <class Law>
PLYFORM_INLINE Doubles by_quads(Doubles a, const Law& law) {
  alignas(sizeof(Doubles)) double at[lanes], out[lanes];
  store_lanes(at, a);
  for (int q = 0; q < quads; ++q)
    law(at + simd_width * q, out + simd_width * q);
  return numbers([&](int q) { return out + simd_width * q; });
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
