// SPDX-License-Identifier: GPL-3.0-or-later
// (1) to (3) of contact/point_triangle.hpp, a pair of a point and a triangle per lane, with the
// operations of closest_point_on_triangle in its order: of all regions, of which each lane then
// takes the one that its point is in.
#include "contact/simd/point_face_kernel.hpp"

#include "contact/simd/contact_law_simd.hpp"
#include "contact/sliver.hpp"

namespace plyform {
namespace {

/// Weights of the corners.
struct FaceWeights {
  Doubles a, b, c;
};

PLYFORM_INLINE void take(FaceWeights& w, Longs where, Doubles a, Doubles b, Doubles c) {
  w.a = where ? a : w.a, w.b = where ? b : w.b, w.c = where ? c : w.c;
}

/// The point p and the corners b and c, from corner a.
PLYFORM_INLINE Columns closest_points(const Vectors& p, const Vectors& b, const Vectors& c) {
  const Doubles zero = all(0.0), one = all(1.0);
  const Doubles bb = dot(b, b), cc = dot(c, c), bc = dot(b, c);
  const Doubles det = bb * cc - bc * bc;
  const Doubles pb = dot(p, b), pc = dot(p, c);
  const Doubles ub = cc * pb - bc * pc, uc = bb * pc - bc * pb, ua = det - ub - uc;
  const Doubles from_b = (pc - bc) - (pb - bb), from_c = (pb - bc) - (pc - cc);
  const Longs on_bc = (ua <= 0.0) & (from_b > 0.0) & (from_c > 0.0);
  const Longs on_ca = (ub <= 0.0) & (pc > 0.0) & (pc < cc);
  const Longs on_ab = (uc <= 0.0) & (pb > 0.0) & (pb < bb);
  const Longs at_c = (pc >= cc) & (from_c <= 0.0), at_b = (pb >= bb) & (from_b <= 0.0);
  const Longs at_a = (pb <= 0.0) & (pc <= 0.0);
  const Longs inside = (ua > 0.0) & (ub > 0.0) & (uc > 0.0);
  FaceWeights w{zero, zero, zero};
  const Doubles t_bc = from_b / (from_b + from_c), t_ca = pc / cc, t_ab = pb / bb;
  take(w, on_bc, zero, 1.0 - t_bc, t_bc); // regions overlap on their borders: the last one counts
  take(w, on_ca, 1.0 - t_ca, zero, t_ca);
  take(w, on_ab, 1.0 - t_ab, t_ab, zero);
  take(w, at_c, zero, zero, one);
  take(w, at_b, zero, one, zero);
  take(w, at_a, one, zero, zero);
  const Doubles scale = 1.0 / (ua + ub + uc);
  take(w, inside, ua * scale, ub * scale, uc * scale);
  const Longs known = (det > sliver_sine2 * (bb * cc) + smallest_det) &
                      (on_bc | on_ca | on_ab | at_c | at_b | at_a | inside);
  const Vectors off = p - w.b * b - w.c * c;
  return {{w.a, w.b, w.c, known ? dot(off, off) : all(__builtin_nan(""))}};
}

PLYFORM_INLINE void measure_point_faces(const PointFaceKernelPairs& k, PointFaceDistance* out) {
  const auto node = [](const double* x, std::int32_t n) {
    return load3(x + 3 * static_cast<std::int64_t>(n));
  };
  for (int first = 0; first < k.count; first += lanes) {
    const int left = k.count - first, count = left < lanes ? left : lanes;
    Double4 p[lanes], b[lanes], c[lanes];
    for (int lane = 0; lane < lanes; ++lane) { // lanes from count on repeat the first
      const std::int32_t* pair =
          k.numbers + 2 * static_cast<std::int64_t>(first + (lane < count ? lane : 0));
      const std::int32_t* corners = k.triangles + 3 * static_cast<std::int64_t>(pair[1]);
      const Double4 a = node(k.nodes, corners[0]);
      p[lane] = node(k.points, pair[0]) - a;
      b[lane] = node(k.nodes, corners[1]) - a;
      c[lane] = node(k.nodes, corners[2]) - a;
    }
    const Columns found = closest_points(components(p), components(b), components(c));
    for (int q = 0; q < quads; ++q) {
      const Rows row = rows(found, q);
      for (int i = 0; i < 4 && 4 * q + i < count; ++i)
        store(out[first + 4 * q + i].w, row.row[i]);
    }
  }
}

} // namespace

void PLYFORM_COPY_OF(point_face_kernel)(const PointFaceKernelPairs& pairs,
                                        PointFaceDistance* distances) {
  measure_point_faces(pairs, distances);
}

} // namespace plyform
