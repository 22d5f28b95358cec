// SPDX-License-Identifier: GPL-3.0-or-later
// What signed_distance (contact/shapes/tool_shape.hpp) remembers of a point and a mesh: plain
// numbers, since contact points hold it and the kernels include them.
#pragma once

#include <cstdint>

namespace plyform {

struct SurfaceHint {
  double at[3] = {}; ///< mm, tool frame: where the closest facet was searched
  /// mm: nearer to `at` than this, only `facet` or one that shares a node with it can be closest
  float clear = 0.0F;
  std::int32_t facet = -1; ///< the closest one at `at`; -1: not searched
};

} // namespace plyform
