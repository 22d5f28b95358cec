// SPDX-License-Identifier: GPL-3.0-or-later
// (S), (P) and (M) of contact/forces/ply_ply.hpp, a point per lane, with the law of
// contact/forces/contact_law.hpp. A point keeps its face (PlyPlyPoint::face) while its foot is
// inside that face and no other face can have come closer; else those of its faces that may be
// closest are searched.
#include "contact/simd/ply_ply_closest.hpp"
#include "contact/simd/ply_ply_point_forces.hpp"

#include <cstring>

namespace plyform {
namespace {

using Pair2 = double __attribute__((vector_size(16)));

PLYFORM_INLINE void add3(double* at, Double4 row) {
  Pair2 low; // not aligned to its size in memory
  std::memcpy(&low, at, sizeof(low));
  low += Pair2{row[0], row[1]};
  std::memcpy(at, &low, sizeof(low));
  at[2] += row[2];
}

/// Adds the forces of the points to their nodes and to the corners of their faces.
PLYFORM_INLINE void add_forces(const PlyPlyKernelContact& k, const Group& g, const SimdWeights& w,
                               const SimdForces& f) {
  const Vectors at_b = f.couple1 - w.b * f.on_node, at_c = f.couple2 - w.c * f.on_node;
  for (int q = 0; q < quads; ++q) {
    const Rows on_node = rows(f.on_node, q), on_b = rows(at_b, q), on_c = rows(at_c, q);
    for (int i = 0; i < 4; ++i) {
      const int lane = 4 * q + i;
      if (!has(g.real, lane)) continue;
      const std::int32_t* t = k.triangles + 3 * static_cast<std::int64_t>(g.face[lane]);
      add3(k.slave_force + 3 * static_cast<std::int64_t>(g.point[lane]->node), on_node.row[i]);
      add3(k.master_force + 3 * static_cast<std::int64_t>(t[1]), on_b.row[i]);
      add3(k.master_force + 3 * static_cast<std::int64_t>(t[2]), on_c.row[i]);
      add3(k.master_force + 3 * static_cast<std::int64_t>(t[0]),
           -(on_node.row[i] + on_b.row[i] + on_c.row[i]));
    }
  }
}

/// Upper bound of the sine of the fold between the face of a point that is not settled and those
/// around it: the share of its motion along its own face that may close on the next one.
PLYFORM_INLINE double fold_ahead(const PlyPlyKernelContact& k, const PlyPlyPoint& point) {
  if (!k.fold_bound) return 1.0;
  const double sine = (2.0 / 1.2) * k.fold_bound[point.face]; // contact/search/fold_bound.hpp
  return sine < 1.0 ? sine : 1.0;
}

/// What the passes over up to 64 points find of them. Points are numbered within the chunk; sets of
/// them have a bit per point.
struct Chunk {
  static constexpr int most = 64;
  alignas(64) double distance[most];  ///< mm
  alignas(64) double distance2[most]; ///< mm^2, from the face kept
  alignas(64) double thickness[most]; ///< r of contact/forces/contact_law.hpp
  std::int32_t across[most];          ///< face across the edge of those in near_edge
  std::uint64_t touching = 0;
  std::uint64_t inside = 0;    ///< whose foot is inside the face
  std::uint64_t above = 0;     ///< on the side that the face's normal points to
  std::uint64_t settled = 0;   ///< to which no other face can be closer
  std::uint64_t near_edge = 0; ///< to which only the face across one edge can be closer
};

/// PlyPlyPoint::side; 0 on edges: a node may slide round the free edge of the sheet to the other
/// side.
PLYFORM_INLINE std::int32_t side_of(const Chunk& chunk, int number) {
  return !has(chunk.inside, number) ? 0 : has(chunk.above, number) ? 1 : -1;
}

/// Adds the lanes of a mask to a set of points, the first lane at `first`.
PLYFORM_INLINE void add(std::uint64_t& set, Longs mask, int first) {
  set |= std::uint64_t{bits_of(mask)} << first;
}

PLYFORM_INLINE void put(std::uint64_t& set, int number, bool in) {
  set = (set & ~(std::uint64_t{1} << number)) | std::uint64_t{in} << number;
}

/// Takes the point with the lowest number out of the set.
PLYFORM_INLINE int take_first(std::uint64_t& set) {
  const int number = __builtin_ctzll(set);
  set &= set - 1;
  return number;
}

/// Stores the faces across the edges opposite to these corners, and returns the mask of the points
/// that have several.
PLYFORM_INLINE Longs store_across(const PlyPlyKernelContact& k, const Group& g, Longs opposite,
                                  std::int32_t* across) {
  alignas(sizeof(Longs)) std::int64_t corner[lanes];
  store_lanes(corner, opposite);
  for (int i = 0; i < lanes; ++i)
    across[i] = k.faces_across[3 * static_cast<std::int64_t>(g.face[i]) + corner[i]];
  return each_lane([&](int i) { return std::int64_t{across[i]}; }) == several_faces;
}

/// r of contact/forces/contact_law.hpp at the closest point of the face that a point keeps.
PLYFORM_INLINE double thickness_at(const PlyPlyKernelContact& k, const PlyPlyPoint& point) {
  if (!k.slave_ratio) return 1.0;
  const std::int32_t* t = k.triangles + 3 * static_cast<std::int64_t>(point.face);
  const double a = k.master_ratio[t[0]], b = k.master_ratio[t[1]], c = k.master_ratio[t[2]];
  const double other = a + point.w[0] * (b - a) + point.w[1] * (c - a);
  return other + k.slave_share * (k.slave_ratio[point.node] - other);
}

/// First pass: closest points on the faces that the points keep.
PLYFORM_INLINE void project_on_known_faces(const PlyPlyKernelContact& k, const std::int32_t* active,
                                           int count, Chunk& chunk) {
  for (int first = 0; first < count; first += lanes) {
    std::int32_t number[lanes];
    for (int i = 0; i < lanes; ++i)
      number[i] = first + i < count ? first + i : -1;
    const Group g = group_of(k, active, number);
    const SimdFaces x = load_faces(k, g, k.slave_x, k.master_x);
    SimdClearance clear;
    Doubles distance2;
    const SimdFoot foot = foot_of(k, g, x, distance2, clear);
    Longs near_edge;
    const Longs settled = settled_of(k, g, foot, clear, near_edge);
    if (any(near_edge)) near_edge &= ~store_across(k, g, clear.opposite, chunk.across + first);
    store_weights(g, foot, g.real);
    const Doubles thickness = each_lane([&](int i) { return thickness_at(k, *g.point[i]); });
    store_lanes(chunk.distance + first, foot.distance);
    store_lanes(chunk.distance2 + first, distance2);
    store_lanes(chunk.thickness + first, thickness);
    add(chunk.touching, foot.distance < k.distance * thickness + k.sliding_gap, first);
    add(chunk.inside, foot.inside, first);
    add(chunk.above, foot.above, first);
    add(chunk.settled, settled, first);
    add(chunk.near_edge, near_edge, first);
  }
}

/// Stores what a search has found of the points of these lanes, a bit of `some` per lane.
PLYFORM_INLINE void store_feet(const Group& g, const PlyPlyKernelContact& k, const SimdFoot& foot,
                               unsigned some, Chunk& chunk) {
  alignas(sizeof(Doubles)) double distance[lanes];
  store_lanes(distance, foot.distance);
  const Doubles thickness = each_lane([&](int i) { return thickness_at(k, *g.point[i]); });
  const unsigned touching = bits_of(foot.distance < k.distance * thickness + k.sliding_gap);
  const unsigned inside = bits_of(foot.inside), above = bits_of(foot.above);
  for (int i = 0; i < lanes; ++i) {
    if (!has(some, i)) continue;
    chunk.distance[g.number[i]] = distance[i];
    chunk.thickness[g.number[i]] = thickness[i];
    put(chunk.touching, g.number[i], has(touching, i));
    put(chunk.inside, g.number[i], has(inside, i));
    put(chunk.above, g.number[i], has(above, i));
  }
}

/// The next points of `searched`, one per lane, which are taken out of it.
PLYFORM_INLINE Group take_group(const PlyPlyKernelContact& k, const std::int32_t* active,
                                std::uint64_t& searched) {
  std::int32_t number[lanes];
  for (int i = 0; i < lanes; ++i)
    number[i] = searched != 0 ? take_first(searched) : -1;
  return group_of(k, active, number);
}

/// Second pass for points in `searched` that are near one edge.
PLYFORM_INLINE void search_across(const PlyPlyKernelContact& k, const std::int32_t* active,
                                  std::uint64_t searched, Chunk& chunk) {
  while (searched != 0) {
    const Group g = take_group(k, active, searched);
    std::int32_t across[lanes];
    for (int i = 0; i < lanes; ++i) {
      const std::int32_t face = chunk.across[g.number[i]];
      across[i] = face == no_face ? g.face[i] : face; // then nothing is closer
    }
    const Doubles own2 = each_lane([&](int i) { return chunk.distance2[g.number[i]]; });
    Longs chosen;
    const SimdFoot foot = closest_across(k, g, across, own2, chosen);
    store_feet(g, k, foot, bits_of(chosen), chunk);
  }
}

/// Second pass for the other points in `searched`: closest points on any of their faces.
PLYFORM_INLINE void search_faces(const PlyPlyKernelContact& k, const std::int32_t* active,
                                 std::uint64_t searched, Chunk& chunk) {
  while (searched != 0) {
    const Group g = take_group(k, active, searched);
    unsigned own_inside = 0;
    for (int i = 0; i < lanes; ++i)
      own_inside |= (has(chunk.inside, g.number[i]) ? 1U : 0U) << i;
    store_feet(g, k, closest_on_any_face(k, g, own_inside), g.real, chunk);
  }
}

/// Points by fours in the order in which their forces are summed, which must not depend on the
/// number of lanes: where fewer are left to a four, -1 stands for none.
struct Order {
  std::int32_t number[Chunk::most + lanes];
  int count = 0;
};

PLYFORM_INLINE void append(Order& order, int number) {
  order.number[order.count++] = number;
}

PLYFORM_INLINE void fill_up(Order& order, int multiple) {
  while (order.count % multiple != 0)
    append(order, -1);
}

/// Takes the points of those successive fours that all touch and are settled out of `points`, and
/// appends them.
PLYFORM_INLINE void take_settled(const Chunk& chunk, std::uint64_t& points, Order& order) {
  for (int first = 0; first < Chunk::most; first += 4) {
    std::uint64_t four = points & std::uint64_t{15} << first;
    if ((four & ~(chunk.touching & chunk.settled)) != 0) continue;
    points &= ~four;
    while (four != 0)
      append(order, take_first(four));
    fill_up(order, 4);
  }
}

/// Updates gap, side and path length of a point that does not touch.
PLYFORM_INLINE void update_open_point(const PlyPlyKernelContact& k, std::int32_t index,
                                      double distance, double thickness, std::int32_t side,
                                      SimdTotals& sums) {
  constexpr double first_share = step_share + shallow_share; // of the depth, once it has closed
  PlyPlyPoint& at = k.points[index];
  const double last_gap = at.gap;
  at.gap = distance - k.distance * thickness;
  at.side = side; // it may close on this side later
  if (last_gap < 1e300 &&
      last_gap > at.gap) // active in the step before, and closing: step_ratio_of
    keep_smaller(sums.step_ratio,
                 all((at.gap + first_share * k.depth_limit * thickness) / (last_gap - at.gap)));
  const double* s = at.memory.s;
  if (at.memory.normal_force != 0.0 || at.memory.damping_force != 0.0 || s[0] != 0.0 ||
      s[1] != 0.0 || s[2] != 0.0)
    k.open(k.self, index, last_gap);
  k.free_until[index] = k.path_length + (at.gap - k.sliding_gap);
}

/// Stores what the forces have changed, and tells of points that are too deep or have gone through.
PLYFORM_INLINE void store_points(const PlyPlyKernelContact& k, const std::int32_t* active,
                                 const Group& g, const Chunk& chunk, const SimdPoints& p) {
  const SimdHistory& m = p.memory;
  const double packed = k.loading.packed;
  const unsigned deep =
      bits_of((-p.gap > (0.5 * k.distance + packed) * p.thickness) | // a law without a depth limit
              (-p.gap >= (packed + deepest_valid * k.max_depth) * p.thickness));
  for (int q = 0; q < quads; ++q) {
    const Rows memory = rows(Columns{{m.s.x, m.s.y, m.s.z, m.damping_force}}, q);
    const Rows gap = rows(Columns{{m.normal_force, m.slip, p.area, p.gap}}, q);
    for (int i = 0; i < 4; ++i) {
      const int lane = 4 * q + i, number = g.number[lane];
      if (!has(g.real, lane)) continue;
      PlyPlyPoint& at = *g.point[lane];
      const std::int32_t side = side_of(chunk, number);
      if (at.side * side < 0 || has(deep, lane))
        k.fault(k.self, active[number], chunk.distance[number]);
      at.side = side;
      store_row(&at, memory_row, memory.row[i]);
      store_row(&at, gap_row, gap.row[i]);
    }
  }
}

/// Values of the master's nodes at the feet of points.
PLYFORM_INLINE Doubles at_feet(const PlyPlyKernelContact& k, const Group& g, const SimdWeights& w,
                               const double* values) {
  const auto corner = [&](int j) {
    return each_lane(
        [&](int i) { return values[k.triangles[3 * std::int64_t{g.point[i]->face} + j]]; });
  };
  const Doubles a = corner(0);
  return a + w.b * (corner(1) - a) + w.c * (corner(2) - a);
}

/// Values of the slave's nodes.
PLYFORM_INLINE Doubles at_nodes(const Group& g, const double* values) {
  return each_lane([&](int i) { return values[g.point[i]->node]; });
}

/// degC, at the feet of points the means of both plies: those of the film between.
PLYFORM_INLINE Doubles film_temperatures(const PlyPlyKernelContact& k, const Group& g,
                                         const SimdWeights& w) {
  if (!k.slave_celsius) return all(__builtin_nan(""));
  return 0.5 * (at_nodes(g, k.slave_celsius) + at_feet(k, g, w, k.master_celsius));
}

/// b A of (V).
PLYFORM_INLINE Doubles vacuum_area(const PlyPlyKernelContact& k, const Group& g,
                                   const SimdWeights& w) {
  if (k.per_vacuum_gap <= 0.0) return all(0.0);
  const Doubles own = at_nodes(g, k.slave_area), face = at_feet(k, g, w, k.master_area);
  return smaller(own, face) * (1.0 - 0.5 * smaller(own / face, all(1.0)));
}

/// Third pass: forces of touching points.
PLYFORM_INLINE void press(const PlyPlyKernelContact& k, const std::int32_t* active,
                          const std::int32_t* number, const Chunk& chunk, SimdTotals& sums) {
  const Group g = group_of(k, active, number);
  const SimdFaces x = load_faces(k, g, k.slave_x, k.master_x);
  const SimdFaces u = load_faces(k, g, k.slave_motion, k.master_motion);
  const Columns held = load_columns(g.point, memory_row), last = load_columns(g.point, gap_row);
  const Doubles distance = each_lane([&](int i) { return chunk.distance[g.number[i]]; });
  const Doubles thickness = each_lane([&](int i) { return chunk.thickness[g.number[i]]; });
  const SimdWeights w{each_lane([&](int i) { return g.point[i]->w[0]; }),
                      each_lane([&](int i) { return g.point[i]->w[1]; })};
  const Doubles fold = each_lane(
      [&](int i) { return has(chunk.settled, g.number[i]) ? 0.0 : fold_ahead(k, *g.point[i]); });
  SimdPoints p{last.of[2],
               distance - k.distance * thickness,
               last.of[3],
               thickness,
               load_compacted(k, g.point),
               k.stuck ? each_lane([&](int i) { return g.point[i]->by_angle; }) : all(1.0),
               vacuum_area(k, g, w),
               film_temperatures(k, g, w),
               {held.of[3], last.of[0], last.of[1], {held.of[0], held.of[1], held.of[2]}},
               {}};
  for (int i = 0; i < lanes && k.keeps; ++i)
    p.kept[i] = &g.point[i]->kept;
  const SimdForces f = forces_of(k, x, u, w, distance, fold, mask_of(g.real), p, sums);
  add_forces(k, g, w, f);
  store_points(k, active, g, chunk, p);
  store_compacted(k, g.point, g.real, p.compacted);
  for (int i = 0; i < lanes; ++i)
    sums.touching += has(g.real, i) ? 1 : 0;
}

PLYFORM_INLINE void process_chunk(const PlyPlyKernelContact& k, const std::int32_t* active,
                                  int count, SimdTotals& sums) {
  Chunk chunk;
  project_on_known_faces(k, active, count, chunk);
  std::uint64_t points = ~std::uint64_t{0} >> (Chunk::most - count);
  const std::uint64_t searched = points & ~chunk.settled;
  Order order;
  take_settled(chunk, points, order);
  search_across(k, active, searched & chunk.near_edge, chunk);
  search_faces(k, active, searched & ~chunk.near_edge, chunk);
  for (std::uint64_t open = points & ~chunk.touching; open != 0;) {
    const int n = take_first(open);
    update_open_point(k, active[n], chunk.distance[n], chunk.thickness[n], side_of(chunk, n), sums);
  }
  for (std::uint64_t touching = points & chunk.touching; touching != 0;)
    append(order, take_first(touching));
  fill_up(order, lanes);
  for (int i = 0; i < order.count; i += lanes)
    press(k, active, order.number + i, chunk, sums);
}

PLYFORM_INLINE PlyPlyKernelTotals sheet_kernel(const PlyPlyKernelContact& k) {
  SimdTotals sums;
  for (int i = 0; i < k.active_count; i += Chunk::most)
    process_chunk(k, k.active + i,
                  k.active_count - i < Chunk::most ? k.active_count - i : Chunk::most, sums);
  return {sum(sums.elastic),    sum(sums.friction),        sum(sums.damping),
          sum(sums.compaction), sum(sums.vacuum),          largest(sums.penetration),
          largest(sums.slip),   smallest(sums.step_ratio), sums.touching};
}

} // namespace

PlyPlyKernelTotals PLYFORM_COPY_OF(ply_ply_kernel)(const PlyPlyKernelContact& contact) {
  return sheet_kernel(contact);
}

} // namespace plyform
