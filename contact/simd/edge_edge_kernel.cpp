// SPDX-License-Identifier: GPL-3.0-or-later
// Distances of pairs of edges as segments, a pair per lane: y_a = x1 + s u, y_b = x3 + t v with the
// symbols of contact/forces/edge_edge.hpp, u = x2 - x1, v = x4 - x3, w = x1 - x3. The lines are
// closest at
//   s = (u.v v.w - v.v u.w) / det,  t = (u.u v.w - u.v u.w) / det,  det = u.u v.v - (u.v)^2
// which holds for the segments if both are in 0..1. Else an end of a segment whose value is not,
// and the point of the other segment closest to it are (Ericson, Real-Time Collision
// Detection, 5.1.9); of parallel edges one of the four ends and the point closest to it.
#include "contact/simd/edge_edge_kernel.hpp"

#include "contact/simd/contact_law_simd.hpp"

namespace plyform {
namespace {

struct SimdEdges {
  Vectors u, v, w;
};

/// Node `number` (0 to 3) of each pair.
PLYFORM_INLINE Vectors corner(const double* x, const std::int32_t* const* nodes, int number) {
  Double4 at[lanes];
  for (int lane = 0; lane < lanes; ++lane)
    at[lane] = load3(x + 3 * static_cast<std::int64_t>(nodes[lane][number]));
  return components(at);
}

PLYFORM_INLINE SimdEdges edges_of(const EdgeEdgeKernelPairs& k, const std::int32_t* const* nodes) {
  const Vectors x1 = corner(k.first, nodes, 0), x3 = corner(k.second, nodes, 2);
  return {corner(k.first, nodes, 1) - x1, corner(k.second, nodes, 3) - x3, x1 - x3};
}

/// a / b in 0..1; 0 for the NaN of an edge without length.
PLYFORM_INLINE Doubles share(Doubles a, Doubles b) {
  return smaller(larger(a / b, all(0.0)), all(1.0));
}

/// Square of the distance of the points s and t, mm^2.
PLYFORM_INLINE Doubles distance2(const SimdEdges& e, Doubles s, Doubles t) {
  return square(e.w + s * e.u - t * e.v);
}

PLYFORM_INLINE void measure_pairs(const SimdEdges& e, const int count, EdgeEdgeDistance* out) {
  const Doubles zero = all(0.0), one = all(1.0), far = all(1e300);
  const Doubles uu = square(e.u), vv = square(e.v), uv = dot(e.u, e.v);
  const Doubles uw = dot(e.u, e.w), vw = dot(e.v, e.w);
  const Doubles det = uu * vv - uv * uv;
  const Longs crosswise = det > 1e-4 * uu * vv;
  const Doubles s = (uv * vw - vv * uw) / det, t = (uu * vw - uv * uw) / det;
  const Longs s_inside = crosswise & (s > 0.0) & (s < 1.0);
  const Longs t_inside = crosswise & (t > 0.0) & (t < 1.0);
  const Longs inside = s_inside & t_inside;
  Doubles best = distance2(e, s, t);
  if (any(~inside)) {
    const Doubles end_a = s <= 0.0 ? zero : one, end_b = t <= 0.0 ? zero : one;
    const Doubles from_a = distance2(e, end_a, share(vw + end_a * uv, vv));
    const Doubles from_b = distance2(e, share(end_b * uv - uw, uu), end_b);
    best = inside ? best : smaller(s_inside ? far : from_a, t_inside ? far : from_b);
    if (any(~crosswise)) {
      const Doubles ends_a =
          smaller(distance2(e, zero, share(vw, vv)), distance2(e, one, share(vw + uv, vv)));
      const Doubles ends_b =
          smaller(distance2(e, share(-uw, uu), zero), distance2(e, share(uv - uw, uu), one));
      best = crosswise ? best : smaller(ends_a, ends_b);
    }
  }
  const Doubles along = dot(cross(e.u, e.v), e.w); // u and v drop out of y_a - y_b
  const Doubles distance = root(best);
  const Longs side = inside & (along > 0.0 ? Longs{} + 1 : Longs{} - 1);
  for (int lane = 0; lane < count; ++lane)
    out[lane] = {distance[lane], s[lane], t[lane], side[lane]};
}

PLYFORM_INLINE void measure_edges(const EdgeEdgeKernelPairs& k, EdgeEdgeDistance* out) {
  for (int first = 0; first < k.count; first += lanes) {
    const int left = k.count - first, count = left < lanes ? left : lanes;
    const std::int32_t* nodes[lanes]; // lanes from count on repeat the first
    for (int lane = 0; lane < lanes; ++lane)
      nodes[lane] = k.nodes + 4 * static_cast<std::int64_t>(first + (lane < count ? lane : 0));
    measure_pairs(edges_of(k, nodes), count, out + first);
  }
}

} // namespace

void PLYFORM_COPY_OF(edge_edge_kernel)(const EdgeEdgeKernelPairs& pairs,
                                       EdgeEdgeDistance* distances) {
  measure_edges(pairs, distances);
}

} // namespace plyform
