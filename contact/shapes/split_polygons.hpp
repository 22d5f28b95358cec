// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles in the place of faces of more than four corners.
#pragma once

#include "base/geometry.hpp"

#include <cstddef>
#include <vector>

namespace plyform {

/// Replaces polygons of more than four corners by triangles, constrained Delaunay as seen along the
/// axis nearest to their normal, turned as they were. Returns the first polygon whose outline, seen
/// so, crosses or touches itself or has no area, and leaves the rest then; else -1.
std::ptrdiff_t split_polygons(const std::vector<Vec3>& points,
                              std::vector<std::vector<std::size_t>>& polygons);

} // namespace plyform
