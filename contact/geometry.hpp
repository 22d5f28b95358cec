// SPDX-License-Identifier: GPL-3.0-or-later
// Geometric types that contact/ and core/ share. Lengths in mm.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

namespace plyform {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Box3 = Eigen::AlignedBox3d;

/// Node numbers of a triangle, counter-clockwise seen from its outer (upper) side.
using Triangle = std::array<std::int32_t, 3>;

/// A triangulated surface: node positions (mm) and triangles.
struct TriMesh {
  std::vector<Vec3> x;
  std::vector<Triangle> triangles;
};

} // namespace plyform
