// SPDX-License-Identifier: GPL-3.0-or-later
// Normals of a triangulated surface at its nodes, and the areas of its triangles.
#pragma once

#include "base/geometry.hpp"

namespace plyform {

/// mm^2, of one triangle of a surface.
inline double triangle_area(std::span<const Vec3> x, const Triangle& t) {
  return 0.5 * (x[at(t[1])] - x[at(t[0])]).cross(x[at(t[2])] - x[at(t[0])]).norm();
}

/// Per node, the sum of the normals of its triangles, each twice as long (mm^2) as its area.
std::vector<Vec3> area_normals(std::span<const Vec3> x, std::span<const Triangle> triangles);

/// Per node, the unit mean of the unit normals of its triangles: by sides, not areas, so that at a
/// bend it is half of what is before and behind it.
std::vector<Vec3> mean_normals(std::span<const Vec3> x, std::span<const Triangle> triangles);

} // namespace plyform
