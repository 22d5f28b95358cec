// SPDX-License-Identifier: GPL-3.0-or-later
// What signed_distance (contact/shapes/tool_shape.hpp) remembers of a point and a mesh: plain
// numbers, since contact points hold it and the kernels include them.
#pragma once

#include <cstdint>
#include <limits>

namespace plyform {

struct SurfaceHint {
  float at[3] = {};      ///< mm, tool frame: where the closest facet was searched
  float distance = 0.0F; ///< mm, signed, there: at most the true one
  /// mm: nearer to `at` than this, only `facet` or one that shares a node with it can be closest
  float clear = 0.0F;
  std::int32_t facet = -1; ///< the closest one at `at`; -1: not searched
  std::int32_t nearest =
      -1; ///< the closest one since then, if it has been compared with the others
  /// 1/mm, c of (3) in contact/shapes/mesh_shape.cpp, above and below `nearest`
  float concavity[2] = {};
};

/// The distance (mm, signed) of a point this far (mm) from `at` is no less than this.
inline double least_distance(const SurfaceHint& hint, double way) {
  return hint.facet < 0 ? -std::numeric_limits<double>::infinity() : double{hint.distance} - way;
}

} // namespace plyform
