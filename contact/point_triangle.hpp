// SPDX-License-Identifier: GPL-3.0-or-later
// The point of a triangle closest to a given point: the innermost routine of contact, so inline.
//
// Symbols: p the point; a b c the corners; q the closest point (mm). Per edge e from s, length
// vector d:
//   t = clamp((p - s).d / d.d, 0, 1)                                                          (1)
// and for the plane, n = (b - a) x (c - a):
//   u_b = n.((p - a) x (c - a)),  u_c = n.((b - a) x (p - a)),  u_a = n.n - u_b - u_c         (2)
//   w_i = u_i / (u_a + u_b + u_c)                                                             (3)
// q lies inside when all u_i > 0, else on the closest of the three edges; n = 0 leaves the edges,
// so a degenerate triangle is the segment or point that it is. Ericson (Real-Time Collision
// Detection, 5.1.5) finds the region from six dot products instead; their differences lose all
// digits on slivers. Here a sliver costs the edges as well and the shortest of the four wins.
#pragma once

#include "contact/geometry.hpp"

namespace plyform {

/// Closest point as barycentric weights (all >= 0, sum 1 up to rounding) and distance squared
/// (mm^2), which is that of the point the weights give. `feature` is the region: 0 = interior,
/// 1 2 3 = vertex a b c, 4 5 6 = edge ab bc ca.
struct ClosestPoint {
  std::array<double, 3> w;
  double distance2;
  int feature;
};

namespace detail {

/// Sine of the angle at a, squared, from which on n is good enough to trust (2) alone: the weights
/// are then right to about 1e-13.
constexpr double sliver_sine2 = 1e-6;

/// Moves `best` to the edge s + t d of corners i, j (feature `edge`) if that is closer. ps = p - s.
inline void closer_on_edge(const Vec3& ps, const Vec3& d, int i, int j, int edge,
                           ClosestPoint& best) {
  const double d2 = d.squaredNorm();
  double t = d2 > 0.0 ? ps.dot(d) / d2 : 0.0; // (1)
  t = t > 0.0 ? (t < 1.0 ? t : 1.0) : 0.0;
  const double distance2 = (ps - t * d).squaredNorm();
  if (!(distance2 < best.distance2)) return;
  best.distance2 = distance2;
  best.w = {0.0, 0.0, 0.0};
  best.w[i] = 1.0 - t;
  best.w[j] = t;
  best.feature = t == 0.0 ? 1 + i : t == 1.0 ? 1 + j : edge;
}

} // namespace detail

/// p and the triangle's corners in mm. Degenerate triangles are answered as the segment or point
/// that they are; never NaN for coordinates below 1e75 mm (the squares of areas overflow beyond).
/// The distance is right to 1e-15 of the distance to the furthest corner; for slivers, that over
/// height / length, and never worse than the height.
inline ClosestPoint closest_point_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b,
                                              const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const Vec3 n = ab.cross(ac);
  const double n2 = n.squaredNorm();
  const double ub = n.dot(ap.cross(ac)), uc = n.dot(ab.cross(ap)), ua = n2 - ub - uc; // (2)
  ClosestPoint best{{1.0, 0.0, 0.0}, ap.squaredNorm(), 1};
  if (ua > 0.0 && ub > 0.0 && uc > 0.0) {
    const double sum = ua + ub + uc; // not 1 / sum, which overflows for the tiniest triangles
    const double wb = ub / sum, wc = uc / sum; // (3)
    best = {{ua / sum, wb, wc}, (ap - wb * ab - wc * ac).squaredNorm(), 0};
    if (n2 > detail::sliver_sine2 * (ab.squaredNorm() * ac.squaredNorm())) return best;
  }
  detail::closer_on_edge(ap, ab, 0, 1, 4, best);
  detail::closer_on_edge(p - b, c - b, 1, 2, 5, best);
  detail::closer_on_edge(p - c, a - c, 2, 0, 6, best);
  return best;
}

} // namespace plyform
