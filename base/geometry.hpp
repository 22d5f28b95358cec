// SPDX-License-Identifier: GPL-3.0-or-later
// Geometric types and small functions that all rooms share. Lengths in mm.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

namespace plyform {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Box3 = Eigen::AlignedBox3d;

/// In rad, as all angles of the program: x * degree of one in degrees, x / degree in degrees.
inline constexpr double degree = std::numbers::pi / 180.0;
/// For angles of results, which keep the last digit that this factor gives.
inline constexpr double degrees_per_radian = 180.0 / std::numbers::pi;

/// Node numbers of a triangle, counter-clockwise seen from its outer (upper) side.
using Triangle = std::array<std::int32_t, 3>;

/// A triangulated surface: node positions (mm) and triangles.
struct TriMesh {
  std::vector<Vec3> x;
  std::vector<Triangle> triangles;
};

/// The number of a node, triangle or edge as containers of the standard library take it.
inline std::size_t at(std::int32_t index) {
  return static_cast<std::size_t>(index);
}

/// Position (mm) of node n.
inline const Vec3& at(std::span<const Vec3> x, std::int32_t n) {
  return x[at(n)];
}

/// Whether two boxes, given by their corners (mm), overlap. All six comparisons are evaluated
/// without a branch: branches of a test that ends early would often be mispredicted.
inline bool overlap(const Vec3& low, const Vec3& high, const Vec3& other_low,
                    const Vec3& other_high) {
  return (int(low.x() <= other_high.x()) & int(low.y() <= other_high.y()) &
          int(low.z() <= other_high.z()) & int(other_low.x() <= high.x()) &
          int(other_low.y() <= high.y()) & int(other_low.z() <= high.z())) != 0;
}

/// The float next to x that is no larger: for lower bounds that are kept in half of the memory.
inline float rounded_down(double x) {
  const auto f = static_cast<float>(x);
  return double{f} > x ? std::nextafter(f, -std::numeric_limits<float>::infinity()) : f;
}

} // namespace plyform
