// SPDX-License-Identifier: GPL-3.0-or-later
// Boxes in floats, for searches that compare many: half of the memory, and compared in a few
// instructions without a branch, which would often be mispredicted.
#pragma once

#include "base/geometry.hpp"

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace plyform {

/// A box rounded outwards: it holds the box (mm) that it is made of.
struct alignas(16) FloatBox {
  std::array<float, 4> low{}, high{}; ///< mm; the fourth numbers are 0

  FloatBox() = default;
  FloatBox(const Vec3& from, const Vec3& to) {
    constexpr float ulp = 1.2e-7F, least = 1e-30F; // more than two halves of a last place
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const auto l = static_cast<float>(from[i]), h = static_cast<float>(to[i]);
      low[k] = l - (ulp * std::abs(l) + least);
      high[k] = h + (ulp * std::abs(h) + least);
    }
  }
};

inline bool overlap(const FloatBox& a, const FloatBox& b) {
#ifdef __SSE2__
  const __m128 below = _mm_cmple_ps(_mm_load_ps(a.low.data()), _mm_load_ps(b.high.data()));
  const __m128 above = _mm_cmple_ps(_mm_load_ps(b.low.data()), _mm_load_ps(a.high.data()));
  return _mm_movemask_ps(_mm_and_ps(below, above)) == 15;
#else
  int all = 1;
  for (std::size_t i = 0; i < 3; ++i)
    all &= int(a.low[i] <= b.high[i]) & int(b.low[i] <= a.high[i]);
  return all != 0;
#endif
}

} // namespace plyform
