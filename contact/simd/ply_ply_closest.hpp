// SPDX-License-Identifier: GPL-3.0-or-later
// The closest points of ply_ply_body.hpp, four at a time: those on the faces that the points keep,
// a test whether no other face can be closer, and the closest of all their faces where one can.
#pragma once

#include "contact/simd/contact_law_simd.hpp"
#include "contact/simd/ply_ply_kernel.hpp"

namespace plyform {
namespace {

constexpr double sliver_sine2 = 0.01; // as in contact/point_triangle.hpp
constexpr double far2 = 1e300;        // mm^2

/// Rows of a PlyPlyPoint.
enum PlyRow : std::size_t {
  memory_row = offsetof(PlyPlyPoint, memory.s),
  gap_row = offsetof(PlyPlyPoint, memory.normal_force)
};
static_assert(is_row(memory_row, offsetof(PlyPlyPoint, memory.s[1]),
                     offsetof(PlyPlyPoint, memory.s[2]),
                     offsetof(PlyPlyPoint, memory.damping_force)));
static_assert(is_row(gap_row, offsetof(PlyPlyPoint, memory.slip), offsetof(PlyPlyPoint, area),
                     offsetof(PlyPlyPoint, gap)));

/// Positions or displacements of four nodes p and of the corners b, c of their faces, relative to
/// corner a.
struct SimdFaces {
  Vector4 p, b, c;
};

PLYFORM_INLINE SimdFaces load_faces(const PlyPlyKernelContact& k, PlyPlyPoint* const* point,
                                    Long4 face, const double* slave, const double* master) {
  Double4 p[simd_width], b[simd_width], c[simd_width];
  for (int i = 0; i < simd_width; ++i) {
    const std::int32_t* t = k.triangles + 3 * face[i];
    const Double4 a = load3(master + 3 * static_cast<std::int64_t>(t[0]));
    p[i] = load3(slave + 3 * static_cast<std::int64_t>(point[i]->node)) - a;
    b[i] = load3(master + 3 * static_cast<std::int64_t>(t[1])) - a;
    c[i] = load3(master + 3 * static_cast<std::int64_t>(t[2])) - a;
  }
  return {components(p[0], p[1], p[2], p[3]), components(b[0], b[1], b[2], b[3]),
          components(c[0], c[1], c[2], c[3])};
}

/// Feet of four nodes on the planes of their faces: (1), (2) of contact/point_triangle.hpp.
struct SimdPlanes {
  Double4 bb, cc, bc, pb, pc, det, wa, wb, wc;
  Long4 inside;
};

PLYFORM_INLINE SimdPlanes planes_of(const SimdFaces& x) {
  SimdPlanes q;
  q.bb = dot(x.b, x.b), q.cc = dot(x.c, x.c), q.bc = dot(x.b, x.c);
  q.pb = dot(x.p, x.b), q.pc = dot(x.p, x.c);
  q.det = q.bb * q.cc - q.bc * q.bc;
  const Double4 ub = q.cc * q.pb - q.bc * q.pc, uc = q.bb * q.pc - q.bc * q.pb;
  const Double4 ua = q.det - ub - uc, scale = 1.0 / (ua + ub + uc);
  q.wa = ua * scale, q.wb = ub * scale, q.wc = uc * scale;
  q.inside = (q.det > sliver_sine2 * (q.bb * q.cc)) & (ua > 0.0) & (ub > 0.0) & (uc > 0.0);
  return q;
}

PLYFORM_INLINE Double4 share_of_edge(Double4 t) {
  t = t > 0.0 ? t : all(0.0); // the NaN of an edge without length becomes 0
  return smaller(t, all(1.0));
}

/// The closest points of four faces: the foot if it is inside, else, if `edges` is set, the closest
/// of the points on the edges, as closest_point_on_sliver of contact/point_triangle.hpp.
struct SimdClosest {
  Double4 wb, wc, distance2;
  Long4 inside;
};

PLYFORM_INLINE SimdClosest closest_of(const SimdFaces& x, const SimdPlanes& plane, bool edges) {
  SimdClosest q{plane.wb, plane.wc, all(far2), plane.inside};
  q.distance2 = q.inside ? square(x.p - q.wb * x.b - q.wc * x.c) : q.distance2;
  if (!edges || !any(~q.inside)) return q;
  const Double4 bb = plane.bb, cc = plane.cc, bc = plane.bc, pb = plane.pb, pc = plane.pc;
  const Double4 t[3] = {share_of_edge(pb / bb), share_of_edge(pc / cc),
                        share_of_edge((pc - pb + bb - bc) / (bb + cc - 2.0 * bc))};
  const Double4 wb[3] = {t[0], all(0.0), 1.0 - t[2]}, wc[3] = {all(0.0), t[1], t[2]};
  for (int edge = 0; edge < 3; ++edge) {
    const Double4 d2 = square(x.p - wb[edge] * x.b - wc[edge] * x.c);
    const Long4 closer = d2 < q.distance2;
    q.wb = closer ? wb[edge] : q.wb, q.wc = closer ? wc[edge] : q.wc;
    q.distance2 = closer ? d2 : q.distance2;
  }
  return q;
}

/// Closest points of four nodes on one face each.
struct SimdFoot {
  Double4 wb, wc, distance;
  Long4 inside; ///< whether the foot on the plane lies inside the face
};

/// Whether the feet of four points are so far inside their faces that no face across an edge or
/// corner can be closer.
struct SimdClearance {
  Long4 of_edges, of_corners; ///< far enough from all edges; from two edges at least
};

/// Distance (mm) from an edge beyond which a foot is closer to its own face than to that across the
/// edge: contact/search/fold_bound.hpp.
PLYFORM_INLINE Double4 clearance(const PlyPlyKernelContact& k, PlyPlyPoint* const* point) {
  if (!k.fold_bound) return all(far2);
  return k.distance * Double4{k.fold_bound[point[0]->face], k.fold_bound[point[1]->face],
                              k.fold_bound[point[2]->face], k.fold_bound[point[3]->face]};
}

PLYFORM_INLINE SimdFoot foot_of(const PlyPlyKernelContact& k, PlyPlyPoint* const* point,
                                const SimdFaces& x, SimdClearance& clear) {
  const SimdPlanes q = planes_of(x);
  // the distance from edge i, w_i times the height sqrt(det) / |edge|, against the clearance
  const Double4 margin = clearance(k, point), margin2 = margin * margin;
  const Long4 a = q.wa * q.wa * q.det > margin2 * (q.bb + q.cc - 2.0 * q.bc);
  const Long4 b = q.wb * q.wb * q.det > margin2 * q.cc, c = q.wc * q.wc * q.det > margin2 * q.bb;
  clear.of_edges = a & b & c;
  clear.of_corners = (a & b) | (b & c) | (c & a);
  const SimdClosest closest = closest_of(x, q, false);
  return {closest.wb, closest.wc, root(closest.distance2), closest.inside};
}

PLYFORM_INLINE void store_weights(PlyPlyPoint* const* point, int count, const SimdFoot& foot) {
  for (int i = 0; i < count; ++i)
    point[i]->w[0] = foot.wb[i], point[i]->w[1] = foot.wc[i];
}

/// Closest points of the first `count` of four points on any of their faces. Updates the members
/// face, other and the weights of each. Without `edges` only feet inside faces are compared: enough
/// for a point that is inside its face and near one edge only, as the foot is closer than that
/// edge.
PLYFORM_INLINE SimdFoot closest_on_any_face(const PlyPlyKernelContact& k, PlyPlyPoint* const* point,
                                            int count, bool edges) {
  Double4 best2 = all(far2), limit = all(far2), wb = all(0.0), wc = all(0.0);
  Long4 face{-1, -1, -1, -1};
  Long4 inside{0, 0, 0, 0};
  for (int i = 0;; ++i) {
    Long4 at{point[0]->face, point[1]->face, point[2]->face, point[3]->face};
    Long4 more{0, 0, 0, 0};
    for (int lane = 0; lane < count; ++lane) {
      const std::int32_t f = point[lane]->first_face + i;
      if (f >= point[lane]->end_face) continue;
      if (double{k.face_distance[f]} > limit[lane])
        continue; // faces are in ascending order of distance
      at[lane] = k.faces[f];
      more[lane] = -1;
    }
    if (!any(more)) break;
    const SimdFaces x = load_faces(k, point, at, k.slave_x, k.master_x);
    const SimdPlanes plane = planes_of(x);
    const SimdClosest q = closest_of(x, plane, edges);
    const Long4 tied = magnitude(q.distance2 - best2) <= same_distance * best2;
    const Long4 chosen = more & (tied ? at < face : q.distance2 < best2);
    const Long4 closer = more & (q.distance2 < best2);
    best2 = closer ? q.distance2 : best2;
    limit = (1.0 + same_distance) * root(best2) + k.max_displacement; // with equally close faces
    wb = chosen ? q.wb : wb, wc = chosen ? q.wc : wc;
    face = chosen ? at : face;
    inside = chosen ? q.inside : inside;
  }
  const SimdFoot foot{wb, wc, root(best2), inside};
  store_weights(point, count, foot);
  for (int lane = 0; lane < count; ++lane) {
    if (face[lane] >= 0 && point[lane]->face != face[lane]) {
      point[lane]->face = static_cast<std::int32_t>(face[lane]);
      point[lane]->other = distance_of_others(*point[lane], k.triangles, k.faces, k.face_distance);
    }
  }
  return foot;
}

/// Mask of the points whose faces need no search, as no other face can be closer: those that share
/// a node with the point's face by contact/search/fold_bound.hpp, the others because of their
/// distance at the search and the relative motion since. interiors_only: mask of the points for
/// which only a face across one edge may be closer, and only with its interior.
PLYFORM_INLINE Long4 settled_of(const PlyPlyKernelContact& k, PlyPlyPoint* const* point,
                                const SimdFoot& foot, const SimdClearance& clear,
                                Long4& interiors_only) {
  const Double4 other{point[0]->other, point[1]->other, point[2]->other, point[3]->other};
  const Long4 others_further = other - k.max_displacement > foot.distance;
  interiors_only = others_further & foot.inside & clear.of_corners;
  return interiors_only & clear.of_edges;
}

} // namespace
} // namespace plyform
