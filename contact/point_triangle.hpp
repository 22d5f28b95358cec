// SPDX-License-Identifier: GPL-3.0-or-later
// The point of a triangle closest to a given point: the innermost routine of contact, so inline.
//
// Symbols: p the point; a b c the corners; q the closest point (mm); all vectors from a:
// B = b - a, C = c - a, P = p - a. With q = a + w_b B + w_c C, the foot of p on the plane has
//   u_b = C.C P.B - B.C P.C,  u_c = B.B P.C - B.C P.B,  u_a = det - u_b - u_c                 (1)
//   det = B.B C.C - (B.C)^2,  w_i = u_i / (u_a + u_b + u_c)                                   (2)
// and is q if all u_i > 0. Else the signs of u and of p's projections on the sides give the vertex
// or edge (Ericson, Real-Time Collision Detection, 5.1.5: the Voronoi regions), on an edge e from s
//   t = (p - s).e / e.e                                                                       (3)
//
// The squares in (1) cost a sliver all its digits. There the plane comes from a cross product,
//   n = B x C,  m = n x P,  u_b = m.C,  u_c = -m.B,  u_a = n.n - u_b - u_c                    (4)
// and q is the closest of the foot (if inside) and of the points on the three edges, with t of (3)
// clamped to 0..1: right for degenerate triangles too, which have edges only.
#pragma once

#include "base/geometry.hpp"
#include "contact/sliver.hpp"

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

/// Moves `best` to the edge s + t d of corners i, j (feature `edge`) if that is closer. ps = p - s.
inline void closer_on_edge(const Vec3& ps, const Vec3& d, int i, int j, int edge,
                           ClosestPoint& best) {
  double t = ps.dot(d) / d.squaredNorm();  // (3)
  t = t > 0.0 ? (t < 1.0 ? t : 1.0) : 0.0; // the NaN of an edge without length becomes 0
  const double distance2 = (ps - t * d).squaredNorm();
  if (!(distance2 < best.distance2)) return;
  best = {{0.0, 0.0, 0.0}, distance2, t == 0.0 ? 1 + i : t == 1.0 ? 1 + j : edge};
  best.w[i] = 1.0 - t;
  best.w[j] = t;
}

/// closest_point_on_triangle for any shape of triangle, at twice the cost.
inline ClosestPoint closest_point_on_sliver(const Vec3& p, const Vec3& a, const Vec3& b,
                                            const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const Vec3 n = ab.cross(ac), m = n.cross(ap);
  const double ub = m.dot(ac), uc = -m.dot(ab), ua = n.squaredNorm() - ub - uc; // (4)
  ClosestPoint best{{1.0, 0.0, 0.0}, ap.squaredNorm(), 1};
  if (ua > 0.0 && ub > 0.0 && uc > 0.0) {
    const double sum = ua + ub + uc; // not 1 / sum, which overflows for the tiniest triangles
    const double wb = ub / sum, wc = uc / sum;
    best = {{ua / sum, wb, wc}, (ap - wb * ab - wc * ac).squaredNorm(), 0};
  }
  closer_on_edge(ap, ab, 0, 1, 4, best);
  closer_on_edge(p - b, c - b, 1, 2, 5, best);
  closer_on_edge(p - c, a - c, 2, 0, 6, best);
  return best;
}

} // namespace detail

/// The point of triangle a, b, c closest to p, all in mm, by (1) to (4). A degenerate triangle is
/// treated as the segment or point that it is; the result is never NaN for coordinates below 1e75
/// mm (beyond, the squares of areas overflow). The error of the distance is at most 2e-15 of the
/// distance to the furthest corner; for slivers 2e-16 length / height of it in addition, but no
/// more than the height.
inline ClosestPoint closest_point_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b,
                                              const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double bb = ab.dot(ab), cc = ac.dot(ac), bc = ab.dot(ac);
  const double det = bb * cc - bc * bc; // (2)
  if (!(det > sliver_sine2 * (bb * cc) + smallest_det))
    return detail::closest_point_on_sliver(p, a, b, c);
  const auto at = [&](double wa, double wb, double wc, int feature) -> ClosestPoint {
    return {{wa, wb, wc}, (ap - wb * ab - wc * ac).squaredNorm(), feature};
  };
  const double pb = ap.dot(ab), pc = ap.dot(ac);
  const double ub = cc * pb - bc * pc, uc = bb * pc - bc * pb, ua = det - ub - uc; // (1)
  if (ua > 0.0 && ub > 0.0 && uc > 0.0) {
    const double scale = 1.0 / (ua + ub + uc); // (2)
    return at(ua * scale, ub * scale, uc * scale, 0);
  }
  if (pb <= 0.0 && pc <= 0.0) return at(1.0, 0.0, 0.0, 1);
  const double from_b = (pc - bc) - (pb - bb), from_c = (pb - bc) - (pc - cc); // along bc, cb
  if (pb >= bb && from_b <= 0.0) return at(0.0, 1.0, 0.0, 2);
  if (pc >= cc && from_c <= 0.0) return at(0.0, 0.0, 1.0, 3);
  if (uc <= 0.0 && pb > 0.0 && pb < bb) return at(1.0 - pb / bb, pb / bb, 0.0, 4); // (3)
  if (ub <= 0.0 && pc > 0.0 && pc < cc) return at(1.0 - pc / cc, 0.0, pc / cc, 6); // (3)
  if (ua <= 0.0 && from_b > 0.0 && from_c > 0.0) {
    const double t = from_b / (from_b + from_c); // (3)
    return at(0.0, 1.0 - t, t, 5);
  }
  return detail::closest_point_on_sliver(p, a, b, c); // rounding left p between two regions
}

} // namespace plyform
