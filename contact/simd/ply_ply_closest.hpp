// SPDX-License-Identifier: GPL-3.0-or-later
// The closest points of ply_ply_body.hpp, four at a time: feet on the faces remembered,
// whether they are sure to be closest, and the closest of all faces where they are not.
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
  gap_row = offsetof(PlyPlyPoint, memory.normal_force),
  weight_row = offsetof(PlyPlyPoint, w)
};
static_assert(is_row(memory_row, offsetof(PlyPlyPoint, memory.s[1]),
                     offsetof(PlyPlyPoint, memory.s[2]),
                     offsetof(PlyPlyPoint, memory.damping_force)));
static_assert(is_row(gap_row, offsetof(PlyPlyPoint, memory.slip), offsetof(PlyPlyPoint, area),
                     offsetof(PlyPlyPoint, gap)));
static_assert(is_row(weight_row, offsetof(PlyPlyPoint, w[1]),
                     offsetof(PlyPlyPoint, last_search_foot[0]),
                     offsetof(PlyPlyPoint, last_search_foot[1])));

/// Places or motions of four nodes and of the corners of their faces, relative to a.
struct SimdFaces {
  Vector4 p, b, c;
};

PLYFORM_INLINE SimdFaces load_faces(const PlyPlyKernelContact& k, PlyPlyPoint* const* point,
                                    Long4 face, const double* slave, const double* master) {
  Double4 p[four], b[four], c[four];
  for (int i = 0; i < four; ++i) {
    const std::int32_t* t = k.triangles + 3 * face[i];
    const Double4 a = load3(master + 3 * static_cast<std::int64_t>(t[0]));
    p[i] = load3(slave + 3 * static_cast<std::int64_t>(point[i]->node)) - a;
    b[i] = load3(master + 3 * static_cast<std::int64_t>(t[1])) - a;
    c[i] = load3(master + 3 * static_cast<std::int64_t>(t[2])) - a;
  }
  return {components(p[0], p[1], p[2], p[3]), components(b[0], b[1], b[2], b[3]),
          components(c[0], c[1], c[2], c[3])};
}

/// Where four nodes stand over the planes of their faces: (1), (2) of contact/point_triangle.hpp.
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

PLYFORM_INLINE Double4 share_of_side(Double4 t) {
  t = t > 0.0 ? t : all(0.0); // the NaN of a side without length becomes 0
  return smaller(t, all(1.0));
}

/// The closest points of four faces: the foot if it is inside, else, if `sides` are asked for, the
/// closest of the points on them, as closest_point_on_sliver of contact/point_triangle.hpp.
struct SimdClosest {
  Double4 wb, wc, distance2;
  Long4 inside;
};

PLYFORM_INLINE SimdClosest closest_of(const SimdFaces& x, const SimdPlanes& plane, bool sides) {
  SimdClosest q{plane.wb, plane.wc, all(far2), plane.inside};
  q.distance2 = q.inside ? square(x.p - q.wb * x.b - q.wc * x.c) : q.distance2;
  if (!sides || !any(~q.inside)) return q;
  const Double4 bb = plane.bb, cc = plane.cc, bc = plane.bc, pb = plane.pb, pc = plane.pc;
  const Double4 t[3] = {share_of_side(pb / bb), share_of_side(pc / cc),
                        share_of_side((pc - pb + bb - bc) / (bb + cc - 2.0 * bc))};
  const Double4 wb[3] = {t[0], all(0.0), 1.0 - t[2]}, wc[3] = {all(0.0), t[1], t[2]};
  for (int side = 0; side < 3; ++side) {
    const Double4 d2 = square(x.p - wb[side] * x.b - wc[side] * x.c);
    const Long4 closer = d2 < q.distance2;
    q.wb = closer ? wb[side] : q.wb, q.wc = closer ? wc[side] : q.wc;
    q.distance2 = closer ? d2 : q.distance2;
  }
  return q;
}

/// What is closest of four nodes, on the faces that they remember.
struct SimdFoot {
  Double4 wb, wc, distance;
  Long4 inside; ///< whether the foot on the plane lies inside the face
};

/// Whether a foot inside is clear of where other faces begin, and what the point remembers.
struct SimdRoom {
  Long4 of_sides, of_corners; ///< clear of all sides; of all but one
  Double4 slid2;              ///< mm^2, along the face, since the point looked around
  Double4 looked_b, looked_c;
};

/// mm, by contact/search/fold_bound.hpp: how far from a side a foot must be.
PLYFORM_INLINE Double4 clearance(const PlyPlyKernelContact& k, PlyPlyPoint* const* point) {
  if (!k.fold_bound) return all(far2);
  return k.distance * Double4{k.fold_bound[point[0]->face], k.fold_bound[point[1]->face],
                              k.fold_bound[point[2]->face], k.fold_bound[point[3]->face]};
}

PLYFORM_INLINE SimdFoot foot_of(const PlyPlyKernelContact& k, PlyPlyPoint* const* point,
                                const SimdFaces& x, SimdRoom& room) {
  const SimdPlanes q = planes_of(x);
  // w_i times the height over side i, which is sqrt(det) / |side|, against the clearance
  const Double4 keep = clearance(k, point), keep2 = keep * keep;
  const Long4 a = q.wa * q.wa * q.det > keep2 * (q.bb + q.cc - 2.0 * q.bc);
  const Long4 b = q.wb * q.wb * q.det > keep2 * q.cc, c = q.wc * q.wc * q.det > keep2 * q.bb;
  room.of_sides = a & b & c;
  room.of_corners = (a & b) | (b & c) | (c & a);
  const Rows last = load_columns(point, weight_row);
  room.looked_b = last.row[2], room.looked_c = last.row[3];
  const Double4 db = q.wb - room.looked_b, dc = q.wc - room.looked_c;
  room.slid2 = db * db * q.bb + 2.0 * (db * dc) * q.bc + dc * dc * q.cc;
  const SimdClosest closest = closest_of(x, q, k.slide_limit > 0.0);
  return {closest.wb, closest.wc, root(closest.distance2), closest.inside};
}

PLYFORM_INLINE void keep_weights(PlyPlyPoint* const* point, int count, const SimdFoot& foot,
                                 Double4 looked_b, Double4 looked_c) {
  store_columns(point, count, weight_row, {{foot.wb, foot.wc, looked_b, looked_c}});
}

/// Closest points of the first `count` of four points on any of their faces. Updates the face and
/// other of each. Points near one edge only, inside their face, need no `sides`: the edge that both
/// faces share is further than the foot.
PLYFORM_INLINE SimdFoot look_at_all(const PlyPlyKernelContact& k, PlyPlyPoint* const* point,
                                    int count, bool sides) {
  Double4 best2 = all(far2), limit = all(far2), wb = all(0.0), wc = all(0.0);
  Double4 plane_b = all(0.0), plane_c = all(0.0);
  Long4 face{-1, -1, -1, -1};
  Long4 inside{0, 0, 0, 0};
  for (int i = 0;; ++i) {
    Long4 at{point[0]->face, point[1]->face, point[2]->face, point[3]->face};
    Long4 more{0, 0, 0, 0};
    for (int lane = 0; lane < count; ++lane) {
      const std::int32_t f = point[lane]->first_face + i;
      if (f >= point[lane]->end_face) continue;
      if (k.face_distance[f] > limit[lane]) continue; // in ascending order
      at[lane] = k.faces[f];
      more[lane] = -1;
    }
    if (!any(more)) break;
    const SimdFaces x = load_faces(k, point, at, k.slave_x, k.master_x);
    const SimdPlanes plane = planes_of(x);
    const SimdClosest q = closest_of(x, plane, sides);
    const Long4 tied = magnitude(q.distance2 - best2) <= same_distance * best2;
    const Long4 chosen = more & (tied ? at < face : q.distance2 < best2);
    const Long4 closer = more & (q.distance2 < best2);
    best2 = closer ? q.distance2 : best2;
    limit = (1.0 + same_distance) * root(best2) + k.max_displacement; // with those that tie
    wb = chosen ? q.wb : wb, wc = chosen ? q.wc : wc;
    plane_b = chosen ? plane.wb : plane_b, plane_c = chosen ? plane.wc : plane_c;
    face = chosen ? at : face;
    inside = chosen ? q.inside : inside;
  }
  const SimdFoot foot{wb, wc, root(best2), inside};
  keep_weights(point, count, foot, plane_b, plane_c);
  for (int lane = 0; lane < count; ++lane) {
    if (face[lane] >= 0 && point[lane]->face != face[lane]) {
      point[lane]->face = static_cast<std::int32_t>(face[lane]);
      point[lane]->other = distance_of_others(*point[lane], k.triangles, k.faces, k.face_distance);
    }
  }
  return foot;
}

/// Which feet need no look around. No other face can be closer: none of those that share a node
/// with it by contact/search/fold_bound.hpp, and none of the others since the search. Or hardly:
/// the point has not slid by slide_limit since it looked around, and a face across an edge can be
/// closer by no more than that times their fold (contact/forces/ply_ply.hpp). mild: only a face
/// across an edge may be closer, and only with its inside.
PLYFORM_INLINE Long4 sure_of(const PlyPlyKernelContact& k, PlyPlyPoint* const* point,
                             const SimdFoot& foot, const SimdRoom& room, Long4& mild) {
  const Double4 other{point[0]->other, point[1]->other, point[2]->other, point[3]->other};
  const Long4 others_further = other - k.max_displacement > foot.distance;
  mild = others_further & foot.inside & room.of_corners;
  return (mild & room.of_sides) | (others_further & (room.slid2 < k.slide_limit * k.slide_limit));
}

} // namespace
} // namespace plyform
