// SPDX-License-Identifier: GPL-3.0-or-later
// The closest points of ply_ply_kernel.cpp, a point per lane: those on the faces that the points
// keep, a test whether no other face can be closer, and the closest of the others where one can.
#pragma once

#include "contact/simd/contact_law_simd.hpp"
#include "contact/simd/ply_ply_kernel.hpp"
#include "contact/sliver.hpp"

namespace plyform {
namespace {

constexpr double far2 = 1e300; // mm^2

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

/// The points of the lanes. In lanes without one, `real` is 0 and the others repeat the first point
/// of their quad or, if it has none, of all.
struct Group {
  PlyPlyPoint* point[lanes];
  std::int32_t number[lanes]; ///< of the point within `active`
  std::int32_t face[lanes];
  unsigned real; ///< a bit per lane
};

/// The points with these numbers within `active`, one per lane; -1: none, but never in the first.
PLYFORM_INLINE Group group_of(const PlyPlyKernelContact& k, const std::int32_t* active,
                              const std::int32_t* number) {
  Group g;
  g.real = 0;
  for (int i = 0; i < lanes; ++i) {
    const int first = i / 4 * 4; // of the quad
    g.real |= (number[i] >= 0 ? 1U : 0U) << i;
    g.number[i] = number[number[i] >= 0 ? i : number[first] >= 0 ? first : 0];
    g.point[i] = k.points + active[g.number[i]];
    g.face[i] = g.point[i]->face;
  }
  return g;
}

/// Positions or displacements of nodes p and of the corners b, c of their faces, relative to corner
/// a.
struct SimdFaces {
  Vectors p, b, c;
};

/// Loads the nodes of the points, (x, y, z, 0) each.
PLYFORM_INLINE void load_nodes(const Group& g, const double* slave, Double4* node) {
  for (int i = 0; i < lanes; ++i)
    node[i] = load3(slave + 3 * static_cast<std::int64_t>(g.point[i]->node));
}

PLYFORM_INLINE SimdFaces load_faces(const PlyPlyKernelContact& k, const Double4* node,
                                    const std::int32_t* face, const double* master) {
  Double4 p[lanes], b[lanes], c[lanes];
  for (int i = 0; i < lanes; ++i) {
    const std::int32_t* t = k.triangles + 3 * static_cast<std::int64_t>(face[i]);
    const Double4 a = load3(master + 3 * static_cast<std::int64_t>(t[0]));
    p[i] = node[i] - a;
    b[i] = load3(master + 3 * static_cast<std::int64_t>(t[1])) - a;
    c[i] = load3(master + 3 * static_cast<std::int64_t>(t[2])) - a;
  }
  return {components(p), components(b), components(c)};
}

PLYFORM_INLINE SimdFaces load_faces(const PlyPlyKernelContact& k, const Group& g,
                                    const double* slave, const double* master) {
  Double4 node[lanes];
  load_nodes(g, slave, node);
  return load_faces(k, node, g.face, master);
}

/// Feet of the nodes on the planes of their faces: (1), (2) of contact/point_triangle.hpp.
struct SimdPlanes {
  Doubles bb, cc, bc, pb, pc, det, wa, wb, wc;
  Longs inside;
};

PLYFORM_INLINE SimdPlanes planes_of(const SimdFaces& x) {
  SimdPlanes q;
  q.bb = dot(x.b, x.b), q.cc = dot(x.c, x.c), q.bc = dot(x.b, x.c);
  q.pb = dot(x.p, x.b), q.pc = dot(x.p, x.c);
  q.det = q.bb * q.cc - q.bc * q.bc;
  const Doubles ub = q.cc * q.pb - q.bc * q.pc, uc = q.bb * q.pc - q.bc * q.pb;
  const Doubles ua = q.det - ub - uc, scale = 1.0 / (ua + ub + uc);
  q.wa = ua * scale, q.wb = ub * scale, q.wc = uc * scale;
  q.inside = (q.det > sliver_sine2 * (q.bb * q.cc)) & (ua > 0.0) & (ub > 0.0) & (uc > 0.0);
  return q;
}

PLYFORM_INLINE Doubles share_of_edge(Doubles t) {
  t = t > 0.0 ? t : all(0.0); // the NaN of an edge without length becomes 0
  return smaller(t, all(1.0));
}

/// The closest points of faces: the foot if it is inside, else far2 or, in the lanes whose bits are
/// set in `edges`, the closest of the points on the edges, as closest_point_on_sliver of
/// contact/point_triangle.hpp.
struct SimdClosest {
  Doubles wb, wc, distance2;
  Longs inside;
};

PLYFORM_INLINE SimdClosest closest_of(const SimdFaces& x, const SimdPlanes& plane, unsigned edges) {
  SimdClosest q{plane.wb, plane.wc, all(far2), plane.inside};
  q.distance2 = q.inside ? square(x.p - q.wb * x.b - q.wc * x.c) : q.distance2;
  if (edges == 0) return q;
  const Longs compared = mask_of(edges);
  const Doubles bb = plane.bb, cc = plane.cc, bc = plane.bc, pb = plane.pb, pc = plane.pc;
  const Doubles t[3] = {share_of_edge(pb / bb), share_of_edge(pc / cc),
                        share_of_edge((pc - pb + bb - bc) / (bb + cc - 2.0 * bc))};
  const Doubles wb[3] = {t[0], all(0.0), 1.0 - t[2]}, wc[3] = {all(0.0), t[1], t[2]};
  for (int edge = 0; edge < 3; ++edge) {
    const Doubles d2 = square(x.p - wb[edge] * x.b - wc[edge] * x.c);
    const Longs closer = compared & (d2 < q.distance2);
    q.wb = closer ? wb[edge] : q.wb, q.wc = closer ? wc[edge] : q.wc;
    q.distance2 = closer ? d2 : q.distance2;
  }
  return q;
}

/// Closest points of the nodes on one face each.
struct SimdFoot {
  Doubles wb, wc, distance;
  Longs inside; ///< whether the foot on the plane lies inside the face
  Longs above;  ///< whether the node is on the side that the face's normal points to
};

PLYFORM_INLINE Longs is_above(const SimdFaces& x) {
  return dot(cross(x.b, x.c), x.p) >= 0.0;
}

/// Whether the feet are so far inside their faces that no face across an edge or corner can be
/// closer.
struct SimdClearance {
  Longs of_edges, of_corners; ///< far enough from all edges; from two edges at least
  Longs opposite;             ///< number of the corner opposite to the edge from which they are not
};

/// Distance (mm) from an edge beyond which a foot is closer to its own face than to that across the
/// edge, for points that are `distance` mm from their faces: contact/search/fold_bound.hpp.
PLYFORM_INLINE Doubles clearance(const PlyPlyKernelContact& k, const Group& g, Doubles distance) {
  if (!k.fold_bound) return all(far2);
  return larger(distance, all(k.distance)) *
         each_lane([&](int i) { return k.fold_bound[g.face[i]]; });
}

/// The foot on the face that a point keeps, with the square of its distance (mm^2).
PLYFORM_INLINE SimdFoot foot_of(const PlyPlyKernelContact& k, const Group& g, const SimdFaces& x,
                                Doubles& distance2, SimdClearance& clear) {
  const SimdPlanes q = planes_of(x);
  const SimdClosest closest = closest_of(x, q, 0);
  distance2 = closest.distance2;
  const Doubles distance = root(distance2);
  // the distance from edge i, w_i times the height sqrt(det) / |edge|, against the clearance
  const Doubles margin = clearance(k, g, distance), margin2 = margin * margin;
  const Longs a = q.wa * q.wa * q.det > margin2 * (q.bb + q.cc - 2.0 * q.bc);
  const Longs b = q.wb * q.wb * q.det > margin2 * q.cc, c = q.wc * q.wc * q.det > margin2 * q.bb;
  clear.of_edges = a & b & c;
  clear.of_corners = (a & b) | (b & c) | (c & a);
  clear.opposite = b ? (c ? Longs{} : Longs{} + 2) : Longs{} + 1;
  return {closest.wb, closest.wc, distance, closest.inside, is_above(x)};
}

/// Stores the weights of the lanes whose bits are set in `some`.
PLYFORM_INLINE void store_weights(const Group& g, const SimdFoot& foot, unsigned some) {
  alignas(sizeof(Doubles)) double wb[lanes], wc[lanes];
  store_lanes(wb, foot.wb), store_lanes(wc, foot.wc);
  for (int i = 0; i < lanes; ++i)
    if (has(some, i)) g.point[i]->w[0] = wb[i], g.point[i]->w[1] = wc[i];
}

/// A number of 32 bits per lane.
using Ints = std::int32_t __attribute__((vector_size(4 * lanes)));

/// The faces of each point, which has one at least: numbers of the first and how many follow.
struct FaceLists {
  Ints first, more;
};

PLYFORM_INLINE FaceLists face_lists(const Group& g) {
  FaceLists lists;
  for (int i = 0; i < lanes; ++i) {
    lists.first[i] = g.point[i]->first_face;
    lists.more[i] = g.point[i]->end_face - g.point[i]->first_face - 1;
  }
  return lists;
}

/// Number i of the faces of each point, and its distance at the search, mm.
struct ListedFaces {
  std::int32_t face[lanes];
  Doubles distance;
  unsigned some; ///< bits of the points that have as many; the others repeat their last
};

PLYFORM_INLINE ListedFaces listed_faces(const PlyPlyKernelContact& k, const FaceLists& lists,
                                        int i) {
  const Ints number = Ints{} + i, at = lists.first + (number < lists.more ? number : lists.more);
  ListedFaces q;
  for (int lane = 0; lane < lanes; ++lane)
    q.face[lane] = k.faces[at[lane]];
  q.distance = each_lane([&](int lane) { return double{k.face_distance[at[lane]]}; });
  q.some = bits_of(__builtin_convertvector(number <= lists.more, Longs));
  return q;
}

/// Stores the face that was found closest for each point, if one was: -1.
PLYFORM_INLINE void store_faces(const PlyPlyKernelContact& k, const Group& g, Longs closest) {
  alignas(sizeof(Longs)) std::int64_t face[lanes];
  store_lanes(face, closest);
  for (int i = 0; i < lanes; ++i) {
    PlyPlyPoint& p = *g.point[i];
    if (!has(g.real, i) || face[i] < 0 || p.face == face[i]) continue;
    p.face = static_cast<std::int32_t>(face[i]);
    p.other = distance_of_others(p, k.triangles, k.faces, k.face_distance);
  }
}

/// Closest points on any face of each point. Updates the members face, other and the weights of
/// each. Points on edges are compared in all lanes of a quad if one of its feet is outside, where
/// points that have been through their faces count as those on the face that they kept, own_inside:
/// beside an edge rounding decides which is closer, and must decide the same for any number of
/// lanes.
PLYFORM_INLINE SimdFoot closest_on_any_face(const PlyPlyKernelContact& k, const Group& g,
                                            unsigned own_inside) {
  Doubles best2 = all(far2), limit = all(far2), wb = all(0.0), wc = all(0.0);
  Longs face = Longs{} + no_face, inside{}, above{};
  Double4 node[lanes];
  load_nodes(g, k.slave_x, node);
  const FaceLists lists = face_lists(g);
  for (int i = 0;; ++i) {
    const ListedFaces listed = listed_faces(k, lists, i);
    // faces are in ascending order of distance
    const unsigned more = g.real & listed.some & ~bits_of(listed.distance > limit);
    if (more == 0) break;
    const SimdFaces x = load_faces(k, node, listed.face, k.master_x);
    const SimdPlanes plane = planes_of(x);
    const unsigned outside = ~((bits_of(plane.inside) & more) | (own_inside & ~more));
    const SimdClosest q = closest_of(x, plane, whole_quads(outside));
    const Longs at = each_lane([&](int lane) { return std::int64_t{listed.face[lane]}; });
    const Longs tied = magnitude(q.distance2 - best2) <= same_distance * best2;
    const Longs closer = mask_of(more) & (q.distance2 < best2);
    const Longs chosen = mask_of(more) & (tied ? at < face : q.distance2 < best2);
    best2 = closer ? q.distance2 : best2;
    limit = (1.0 + same_distance) * root(best2) + k.max_displacement; // with equally close faces
    wb = chosen ? q.wb : wb, wc = chosen ? q.wc : wc;
    face = chosen ? at : face;
    inside = chosen ? q.inside : inside;
    above = chosen ? is_above(x) : above;
  }
  const SimdFoot foot{wb, wc, root(best2), inside, above};
  store_weights(g, foot, g.real);
  store_faces(k, g, face);
  return foot;
}

/// Feet inside the faces `across` an edge of those that the points keep, from which they have the
/// squared distance own2 (mm^2), where they are closer: `chosen`, mask. Updates the members face,
/// other and the weights of those.
PLYFORM_INLINE SimdFoot closest_across(const PlyPlyKernelContact& k, const Group& g,
                                       const std::int32_t* across, Doubles own2, Longs& chosen) {
  Double4 node[lanes];
  load_nodes(g, k.slave_x, node);
  const SimdFaces x = load_faces(k, node, across, k.master_x);
  const SimdClosest q = closest_of(x, planes_of(x), 0);
  const Longs own = each_lane([&](int lane) { return std::int64_t{g.face[lane]}; });
  const Longs other = each_lane([&](int lane) { return std::int64_t{across[lane]}; });
  const Longs tied = magnitude(q.distance2 - own2) <= same_distance * own2;
  chosen = mask_of(g.real) & (tied ? other < own : q.distance2 < own2);
  const SimdFoot foot{q.wb, q.wc, root(smaller(q.distance2, own2)), q.inside, is_above(x)};
  store_weights(g, foot, bits_of(chosen));
  store_faces(k, g, chosen ? other : own);
  return foot;
}

/// Mask of the points whose faces need no search, as no other face can be closer: those that share
/// a node with the point's face by contact/search/fold_bound.hpp, the others because of their
/// distance at the search and the relative motion since. near_edge: mask of the points for which
/// only the face across one edge, clear.opposite, may be closer, and only with its interior, as
/// their foot is closer than that edge.
PLYFORM_INLINE Longs settled_of(const PlyPlyKernelContact& k, const Group& g, const SimdFoot& foot,
                                const SimdClearance& clear, Longs& near_edge) {
  const Doubles other = each_lane([&](int i) { return g.point[i]->other; });
  const Longs others_further = other - k.max_displacement > foot.distance;
  const Longs one_edge = others_further & foot.inside & clear.of_corners;
  near_edge = one_edge & ~clear.of_edges;
  return one_edge & clear.of_edges;
}

} // namespace
} // namespace plyform
