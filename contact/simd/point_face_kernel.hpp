// SPDX-License-Identifier: GPL-3.0-or-later
// Interface of the compiled copies of the kernel that measures points and triangles for
// contact/search/sheet_bvh.hpp: plain numbers and pointers, nothing inline (reason:
// base/simd.hpp).
#pragma once

#include <cstdint>

namespace plyform {

/// Pairs of points and triangles to measure. Positions: mm, 3 numbers per node.
struct PointFaceKernelPairs {
  const std::int32_t* numbers; ///< 2 per pair: of the point, and of the triangle
  int count;
  const double* points;
  const double* nodes;           ///< of the triangles
  const std::int32_t* triangles; ///< 3 nodes each
};

/// The point of a triangle closest to a point: as ClosestPoint of contact/point_triangle.hpp, in
/// the same bits. distance2 is NaN of slivers, and where rounding leaves the point between two
/// regions: those are left to closest_point_on_triangle.
struct alignas(32) PointFaceDistance {
  double w[3];
  double distance2; ///< mm^2
};

/// Measures all pairs; distances: one each.
void point_face_kernel_generic(const PointFaceKernelPairs& pairs, PointFaceDistance* distances);
void point_face_kernel_avx2(const PointFaceKernelPairs& pairs, PointFaceDistance* distances);
void point_face_kernel_avx512(const PointFaceKernelPairs& pairs, PointFaceDistance* distances);

} // namespace plyform
