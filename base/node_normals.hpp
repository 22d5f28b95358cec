// SPDX-License-Identifier: GPL-3.0-or-later
// Normals of a triangulated surface at its nodes.
#pragma once

#include "base/geometry.hpp"

namespace plyform {

/// Per node, the sum of the normals of its triangles, each twice as long (mm^2) as its area.
std::vector<Vec3> area_normals(std::span<const Vec3> x, std::span<const Triangle> triangles);

/// Per node, the unit mean of the unit normals of its triangles: by sides, not areas, so that at a
/// bend it is half of what is before and behind it.
std::vector<Vec3> mean_normals(std::span<const Vec3> x, std::span<const Triangle> triangles);

} // namespace plyform
