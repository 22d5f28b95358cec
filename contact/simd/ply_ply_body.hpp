// SPDX-License-Identifier: GPL-3.0-or-later
// (S), (P) and (M) of contact/forces/ply_ply.hpp for four points at a time, with the law of
// contact/forces/contact_law.hpp. A point keeps its face (PlyPlyPoint::face) while its foot is
// inside that face and no other face can have come closer; else those of its faces that may be
// closest are searched.
//
// With B = b - a, C = c - a, N = B x C of the face, n = N / |N|, v_1 = u_b - u_a, v_2 = u_c - u_a,
// and the edges opposite to the corners E_1 = -C, E_2 = B, (W) and (C) of
// contact/forces/face_rotation.hpp are
//   turn = [ (n.v_2) B - (n.v_1) C - 1/2 (B.v_2 - C.v_1) n ] / |N|                          (W')
//   F_j  = [ (E_j.K) n - 1/2 (K.n) E_j ] / |N|   from a couple K, j = 1, 2;  F_0 = -F_1 - F_2 (C')
#include "contact/simd/ply_ply_closest.hpp"

namespace plyform {
namespace {

using Pair2 = double __attribute__((vector_size(16), may_alias, aligned(8)));

PLYFORM_INLINE void add3(double* at, Double4 row) {
  Pair2& low = *reinterpret_cast<Pair2*>(at);
  low += Pair2{row[0], row[1]};
  at[2] += row[2];
}

/// The state of four points that the computation of their forces changes.
struct SimdPoints {
  Double4 area, gap, last_gap;
  SimdHistory memory;
};

struct SimdForces {
  Vector4 on_node, couple1, couple2; ///< of (C') on corners b and c
};

/// Normal force and friction of four points whose feet are known; `touch`: those that touch; fold:
/// as of fold_ahead.
PLYFORM_INLINE SimdForces forces_of(const PlyPlyKernelContact& k, const SimdFaces& x,
                                    const SimdFaces& u, const SimdFoot& foot, Double4 fold,
                                    Long4 touch, SimdPoints& p, SimdTotals& sums) {
  const Double4 zero = all(0.0);
  const Vector4 arm = x.p - foot.wb * x.b - foot.wc * x.c;
  const Vector4 motion = u.p - foot.wb * u.b - foot.wc * u.c;
  const Double4 depth = k.distance - foot.distance;
  const Vector4 normal = (1.0 / foot.distance) * arm;
  const Double4 area = touch ? p.area : zero;
  const Long4 known = p.last_gap < 1e300;
  const Double4 opened = known ? smaller(p.last_gap, zero) : zero;
  const Double4 dp = known ? p.last_gap - p.gap : -dot(normal, motion);
  const Double4 pressure = normal_pressure(k, area, depth, opened, dp, touch, p.memory, sums);
  SimdForces f{p.memory.normal_force * normal, {zero, zero, zero}, {zero, zero, zero}};
  Double4 stored2 = zero;
  if (k.friction > 0.0) {
    const Vector4 across = cross(x.b, x.c);
    const Double4 per_size = 1.0 / root(square(across));
    const Vector4 n = per_size * across;
    const Double4 v1 = dot(n, u.b), v2 = dot(n, u.c);
    const Double4 spin = 0.5 * (dot(x.b, u.c) - dot(x.c, u.b));
    const Vector4 turn = per_size * (v2 * x.b - v1 * x.c - spin * n); // (W')
    const Vector4 slip = motion - cross(turn, arm);                   // (P)
    const Vector4& s = p.memory.s;
    const Vector4 tangential =
        friction_of(k, area, pressure, normal, s + cross(turn, s), slip, touch, p.memory, sums);
    f.on_node = f.on_node + tangential;
    const Vector4 couple = cross(tangential, arm); // -r x T of (M)
    const Double4 half = 0.5 * dot(couple, n);
    f.couple1 = per_size * (half * x.c - dot(x.c, couple) * n); // (C'), E_1 = -C
    f.couple2 = per_size * (dot(x.b, couple) * n - half * x.b);
    stored2 = square(p.memory.s);
  }
  sums.elastic +=
      0.5 * area * (k.stiffness * depth * depth / room_of(k, depth) + k.tangential * stored2);
  Double4 closing = dp;
  if (any(fold > 0.0)) closing = fold > 0.0 ? larger(dp, zero) + fold * root(square(motion)) : dp;
  sums.step_ratio = smaller(sums.step_ratio, step_ratio_of(k, depth, closing));
  sums.penetration = larger(sums.penetration, touch ? depth : zero);
  return f;
}

/// Adds the forces of the points in `touch` to their nodes and to the corners of their faces.
PLYFORM_INLINE void add_forces(const PlyPlyKernelContact& k, PlyPlyPoint* const* point,
                               const SimdFoot& foot, const SimdForces& f, Long4 touch) {
  const Rows on_node = rows(f.on_node);
  const Rows on_b = rows(f.couple1 - foot.wb * f.on_node);
  const Rows on_c = rows(f.couple2 - foot.wc * f.on_node);
  for (int i = 0; i < simd_width; ++i) {
    if (!touch[i]) continue;
    const std::int32_t* t = k.triangles + 3 * static_cast<std::int64_t>(point[i]->face);
    add3(k.slave_force + 3 * static_cast<std::int64_t>(point[i]->node), on_node.row[i]);
    add3(k.master_force + 3 * static_cast<std::int64_t>(t[1]), on_b.row[i]);
    add3(k.master_force + 3 * static_cast<std::int64_t>(t[2]), on_c.row[i]);
    add3(k.master_force + 3 * static_cast<std::int64_t>(t[0]),
         -(on_node.row[i] + on_b.row[i] + on_c.row[i]));
  }
}

/// Up to four points. Those from `count` on are copies of the first, to fill the SIMD lanes; `real`
/// is their mask.
struct Group {
  PlyPlyPoint* point[simd_width];
  std::int32_t index[simd_width];
  int count;
  Long4 real;
};

PLYFORM_INLINE Group group_of(const PlyPlyKernelContact& k, const std::int32_t* index, int left) {
  Group g;
  g.count = left < simd_width ? left : simd_width;
  for (int i = 0; i < simd_width; ++i) {
    g.index[i] = index[i < g.count ? i : 0];
    g.point[i] = k.points + g.index[i];
  }
  g.real = Long4{0, 1, 2, 3} < static_cast<std::int64_t>(g.count);
  return g;
}

PLYFORM_INLINE Long4 remembered(const Group& g) {
  return Long4{g.point[0]->face, g.point[1]->face, g.point[2]->face, g.point[3]->face};
}

/// Upper bound of the sine of the fold between the face of a point that is not settled and those
/// around it: the share of its motion along its own face that may close on the next one.
PLYFORM_INLINE double fold_ahead(const PlyPlyKernelContact& k, const PlyPlyPoint& point) {
  if (!k.fold_bound) return 1.0;
  const double sine = (2.0 / 1.2) * k.fold_bound[point.face]; // contact/search/fold_bound.hpp
  return sine < 1.0 ? sine : 1.0;
}

/// Computes the forces of up to four points that touch, x their positions, foot their closest
/// points, and fold as of fold_ahead, 0 for those that are settled.
PLYFORM_INLINE void press(const PlyPlyKernelContact& k, const Group& g, const SimdFaces& x,
                          const SimdFoot& foot, Double4 fold, SimdTotals& sums) {
  const SimdFaces u = load_faces(k, g.point, remembered(g), k.slave_motion, k.master_motion);
  const Rows held = load_columns(g.point, memory_row), last = load_columns(g.point, gap_row);
  SimdPoints p;
  SimdHistory& m = p.memory;
  m.s = {held.row[0], held.row[1], held.row[2]};
  m.damping_force = held.row[3];
  m.normal_force = last.row[0], m.slip = last.row[1], p.area = last.row[2];
  p.last_gap = last.row[3];
  p.gap = foot.distance - k.distance;
  const SimdForces f = forces_of(k, x, u, foot, fold, g.real, p, sums);
  add_forces(k, g.point, foot, f, g.real);
  const Double4 height = dot(cross(x.b, x.c), x.p);
  // 0 on edges: a node may slide round the free edge of the sheet to the other side
  const Long4 side = foot.inside & (height >= 0.0 ? Long4{1, 1, 1, 1} : Long4{-1, -1, -1, -1});
  const Long4 deep = (foot.distance < 0.5 * k.distance) | // for a law without a depth limit
                     (k.distance - foot.distance >= deepest_valid * k.max_depth);
  const Rows s = transposed({{m.s.x, m.s.y, m.s.z, m.damping_force}});
  const Rows b = transposed({{m.normal_force, m.slip, p.area, p.gap}});
  for (int i = 0; i < g.count; ++i) {
    PlyPlyPoint& at = *g.point[i];
    if (at.side * side[i] < 0 || deep[i]) k.fault(k.self, g.index[i], foot.distance[i]);
    at.side = static_cast<std::int32_t>(side[i]);
    store_row(&at, memory_row, s.row[i]);
    store_row(&at, gap_row, b.row[i]);
  }
  sums.touching += g.count;
}

/// Updates gap, side and path length of a point that does not touch.
PLYFORM_INLINE void update_open_point(const PlyPlyKernelContact& k, std::int32_t index,
                                      double distance, bool inside, SimdTotals& sums) {
  PlyPlyPoint& at = k.points[index];
  const double last_gap = at.gap;
  at.gap = distance - k.distance;
  if (last_gap < 1e300) // it was active in the step before
    sums.step_ratio =
        smaller(sums.step_ratio, step_ratio_of(k, all(-at.gap), all(last_gap - at.gap)));
  at.side = 0;
  if (inside) { // it may close on this side later
    const std::int32_t* t = k.triangles + 3 * static_cast<std::int64_t>(at.face);
    const double* a = k.master_x + 3 * static_cast<std::int64_t>(t[0]);
    const double* b = k.master_x + 3 * static_cast<std::int64_t>(t[1]);
    const double* c = k.master_x + 3 * static_cast<std::int64_t>(t[2]);
    const double* p = k.slave_x + 3 * static_cast<std::int64_t>(at.node);
    double height = 0.0;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, l = (i + 2) % 3;
      height += ((b[j] - a[j]) * (c[l] - a[l]) - (b[l] - a[l]) * (c[j] - a[j])) * (p[i] - a[i]);
    }
    at.side = height >= 0.0 ? 1 : -1;
  }
  if (at.memory.normal_force != 0.0 || at.memory.damping_force != 0.0)
    k.open(k.self, index, last_gap);
  k.free_until[index] = k.path_length + at.gap;
}

/// State of up to 64 points between the three passes: those whose forces the first pass could not
/// compute, because their faces must be searched or because not all four of their group touch.
/// Points are numbered within the chunk.
struct Chunk {
  static constexpr int most = 64;
  alignas(32) double distance[most]; ///< mm
  bool inside[most];                 ///< the foot is inside the face
  bool settled[most];                ///< no other face can be closer
  std::int32_t to_search[2][most];   ///< points whose faces must be searched; [1]: with edges
  int search_count[2] = {0, 0};
  std::int32_t pending[most]; ///< points whose forces are not yet computed, ascending
  int pending_count = 0;
};

PLYFORM_INLINE void store_foot(Chunk& chunk, const std::int32_t* number, int count,
                               const SimdFoot& foot) {
  for (int i = 0; i < count; ++i) {
    chunk.distance[number[i]] = foot.distance[i];
    chunk.inside[number[i]] = foot.inside[i] != 0;
  }
}

/// First pass: closest points on the faces that the points keep, and the forces of those groups of
/// four in which every point touches and certainly has its closest point on that face (is settled).
PLYFORM_INLINE void project_on_known_faces(const PlyPlyKernelContact& k, const std::int32_t* active,
                                           int count, Chunk& chunk, SimdTotals& sums) {
  for (int first = 0; first < count; first += simd_width) {
    const Group g = group_of(k, active + first, count - first);
    const SimdFaces x = load_faces(k, g.point, remembered(g), k.slave_x, k.master_x);
    SimdClearance clear;
    const SimdFoot foot = foot_of(k, g.point, x, clear);
    Long4 interiors_only;
    const Long4 settled = settled_of(k, g.point, foot, clear, interiors_only);
    store_weights(g.point, g.count, foot);
    if (!any(~(settled & (foot.distance < k.distance)))) {
      press(k, g, x, foot, all(0.0), sums);
      continue;
    }
    const std::int32_t number[simd_width] = {first, first + 1, first + 2, first + 3};
    store_foot(chunk, number, g.count, foot);
    for (int i = 0; i < g.count; ++i) {
      chunk.pending[chunk.pending_count++] = first + i;
      chunk.settled[first + i] = settled[i] != 0;
      if (settled[i]) continue;
      const int edges = interiors_only[i] ? 0 : 1;
      chunk.to_search[edges][chunk.search_count[edges]++] = first + i;
    }
  }
}

/// Second pass: closest points of the points whose faces must be searched.
PLYFORM_INLINE void search_faces(const PlyPlyKernelContact& k, const std::int32_t* active,
                                 bool edges, Chunk& chunk) {
  for (int first = 0; first < chunk.search_count[edges]; first += simd_width) {
    const int left = chunk.search_count[edges] - first;
    std::int32_t number[simd_width], index[simd_width];
    for (int i = 0; i < simd_width; ++i) {
      number[i] = chunk.to_search[edges][first + (i < left ? i : 0)];
      index[i] = active[number[i]];
    }
    const Group g = group_of(k, index, left);
    store_foot(chunk, number, g.count, closest_on_any_face(k, g.point, g.count, edges));
  }
}

/// Third pass: forces of up to four touching points whose closest points are now known.
PLYFORM_INLINE void press_pending(const PlyPlyKernelContact& k, const std::int32_t* active,
                                  const std::int32_t* number, int count, const Chunk& chunk,
                                  SimdTotals& sums) {
  std::int32_t index[simd_width];
  Double4 distance, fold;
  Long4 inside;
  for (int i = 0; i < simd_width; ++i) {
    const std::int32_t from = number[i < count ? i : 0];
    index[i] = active[from];
    fold[i] = chunk.settled[from] ? 0.0 : fold_ahead(k, k.points[index[i]]);
    distance[i] = chunk.distance[from];
    inside[i] = chunk.inside[from] ? -1 : 0;
  }
  const Group g = group_of(k, index, count);
  PlyPlyPoint* const* p = g.point;
  const Double4 wb{p[0]->w[0], p[1]->w[0], p[2]->w[0], p[3]->w[0]};
  const Double4 wc{p[0]->w[1], p[1]->w[1], p[2]->w[1], p[3]->w[1]};
  press(k, g, load_faces(k, p, remembered(g), k.slave_x, k.master_x), {wb, wc, distance, inside},
        fold, sums);
}

PLYFORM_INLINE void process_chunk(const PlyPlyKernelContact& k, const std::int32_t* active,
                                  int count, SimdTotals& sums) {
  Chunk chunk;
  project_on_known_faces(k, active, count, chunk, sums);
  search_faces(k, active, false, chunk);
  search_faces(k, active, true, chunk);
  std::int32_t touching[Chunk::most];
  int touching_count = 0;
  for (int i = 0; i < chunk.pending_count; ++i) {
    const std::int32_t n = chunk.pending[i];
    if (chunk.distance[n] < k.distance)
      touching[touching_count++] = n;
    else
      update_open_point(k, active[n], chunk.distance[n], chunk.inside[n], sums);
  }
  for (int i = 0; i < touching_count; i += simd_width)
    press_pending(k, active, touching + i, touching_count - i, chunk, sums);
}

PLYFORM_INLINE PlyPlyKernelTotals sheet_kernel(const PlyPlyKernelContact& k) {
  SimdTotals sums;
  for (int i = 0; i < k.active_count; i += Chunk::most)
    process_chunk(k, k.active + i,
                  k.active_count - i < Chunk::most ? k.active_count - i : Chunk::most, sums);
  return {
      sum(sums.elastic),  sum(sums.friction),        sum(sums.damping), largest(sums.penetration),
      largest(sums.slip), smallest(sums.step_ratio), sums.touching};
}

} // namespace
} // namespace plyform
