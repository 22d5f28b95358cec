// SPDX-License-Identifier: GPL-3.0-or-later
// The point of a triangle closest to a given point (Ericson, Real-Time Collision Detection, 5.1.5:
// the Voronoi regions of the triangle).
#pragma once

#include "contact/geometry.hpp"

namespace plyform {

/// Closest point as barycentric weights (all >= 0, sum 1) and distance squared (mm^2). `feature`
/// is the region: 0 = interior, 1 2 3 = vertex a b c, 4 5 6 = edge ab bc ca.
struct ClosestPoint {
  std::array<double, 3> w;
  double distance2;
  int feature;
};

/// p and the triangle's corners in mm. Degenerate triangles are answered as the segment or point
/// that they are; never NaN for finite input.
ClosestPoint closest_point_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

} // namespace plyform
