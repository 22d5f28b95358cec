// SPDX-License-Identifier: GPL-3.0-or-later
// Forces between a tool and nodes, one per lane, whose gaps and normals have been measured.
#include "contact/simd/tool_ply_kernel.hpp"

#include "contact/simd/contact_law_simd.hpp"

namespace plyform {
namespace {

/// As many points as there are lanes. Those from `count` on are copies of the first; `real` is the
/// mask of the others.
struct ToolGroup {
  ToolPlyPoint* point[lanes];
  int count;
  Longs real;
};

PLYFORM_INLINE ToolGroup group_of(const ToolPlyKernelContact& k, int first) {
  ToolGroup g;
  g.count = k.active_count - first < lanes ? k.active_count - first : lanes;
  for (int i = 0; i < lanes; ++i)
    g.point[i] = k.points + k.active[first + (i < g.count ? i : 0)];
  g.real = mask_of((1U << g.count) - 1);
  return g;
}

/// Rows of a ToolPlyPoint. The last column of the third holds the node, an integer: it is not used
/// as a number.
enum ToolRow : std::size_t {
  memory_row = offsetof(ToolPlyPoint, memory.s),
  gap_row = offsetof(ToolPlyPoint, memory.normal_force),
  normal_row = offsetof(ToolPlyPoint, normal)
};
static_assert(is_row(memory_row, offsetof(ToolPlyPoint, memory.s[1]),
                     offsetof(ToolPlyPoint, memory.s[2]),
                     offsetof(ToolPlyPoint, memory.damping_force)));
static_assert(is_row(gap_row, offsetof(ToolPlyPoint, memory.slip), offsetof(ToolPlyPoint, gap),
                     offsetof(ToolPlyPoint, last_gap)));
static_assert(is_row(normal_row, offsetof(ToolPlyPoint, normal[1]),
                     offsetof(ToolPlyPoint, normal[2]), offsetof(ToolPlyPoint, node)));

PLYFORM_INLINE Doubles areas(const ToolPlyKernelContact& k, const ToolGroup& g) {
  return each_lane([&](int i) { return k.area[g.point[i]->node]; });
}

/// 1 over r of contact/forces/contact_law.hpp.
PLYFORM_INLINE Doubles per_thickness_of(const ToolPlyKernelContact& k, const ToolGroup& g) {
  if (!k.thickness_ratio) return all(1.0);
  return 1.0 / each_lane([&](int i) { return k.thickness_ratio[g.point[i]->node]; });
}

/// degC, means of tool and ply: those of the film between.
PLYFORM_INLINE Doubles film_temperatures(const ToolPlyKernelContact& k, const ToolGroup& g) {
  if (!k.celsius) return all(__builtin_nan(""));
  return 0.5 * (each_lane([&](int i) { return k.celsius[g.point[i]->node]; }) + k.tool_celsius);
}

PLYFORM_INLINE Vectors motions(const ToolPlyKernelContact& k, const ToolGroup& g) {
  Double4 u[lanes];
  for (int i = 0; i < lanes; ++i)
    u[i] = load3(k.motion + 3 * static_cast<std::int64_t>(g.point[i]->node));
  return components(u);
}

/// `to`: bits of the lanes whose nodes get their force.
PLYFORM_INLINE void set_forces(const ToolPlyKernelContact& k, const ToolGroup& g, const Vectors& f,
                               unsigned to) {
  for (int q = 0; q < quads; ++q) {
    const Rows r = rows(f, q);
    for (int i = 0; i < 4; ++i) {
      if (!has(to, 4 * q + i)) continue;
      double* at = k.force + 3 * static_cast<std::int64_t>(g.point[4 * q + i]->node);
      at[0] = r.row[i][0], at[1] = r.row[i][1], at[2] = r.row[i][2];
    }
  }
}

PLYFORM_INLINE Vectors everywhere(const double* v) {
  return {all(v[0]), all(v[1]), all(v[2])};
}

/// Forces (N) on the nodes; `counted`: lanes that are in the sums. For a point that has opened the
/// energy of its tangential spring is counted as frictional dissipation; with area 0 the law then
/// resets its history but for the slip, which is reset here.
PLYFORM_INLINE Vectors forces_of(const ToolPlyKernelContact& k, const ToolGroup& g,
                                 const Vectors& normal, Doubles gap, Doubles last_gap,
                                 Doubles per_thickness, Longs touch, Longs counted, SimdHistory& m,
                                 SimdTotals& sums) {
  const Doubles zero = all(0.0), whole = areas(k, g), area = touch ? whole : zero;
  const Doubles depth = -gap * per_thickness, dp = (last_gap - gap) * per_thickness;
  const Doubles opening = counted & ~touch ? whole : zero;
  add(sums.friction, 0.5 * opening * k.tangential * square(m.s));
  Doubles compacted = load_compacted(k, g.point);
  const SimdElastic elastic = elastic_of(k, area, depth, touch, compacted, sums);
  store_compacted(k, g.point, (1U << g.count) - 1, compacted);
  const Doubles pressure =
      normal_pressure(k, area, elastic.pressure, depth, per_thickness * smaller(last_gap, zero), dp,
                      per_thickness, counted, m, sums);
  Vectors f = m.normal_force * normal;
  if (k.friction > 0.0) {
    const Vectors slip = motions(k, g) - everywhere(k.tool_motion);
    SimdSliding by{all(1.0), per_thickness, film_temperatures(k, g), {}};
    for (int i = 0; i < lanes && k.keeps; ++i)
      by.kept[i] = k.kept_at + g.point[i]->node;
    f = f + friction_of(k, area, pressure, normal, m.s, slip, by, touch, m, sums);
    m.slip = touch ? m.slip : zero;
  }
  add(sums.elastic, 0.5 * area * (elastic.energy2 + k.tangential * square(m.s)));
  keep_larger(sums.penetration, touch ? depth : zero);
  sums.touching += __builtin_popcount(bits_of(touch));
  return f;
}

/// The lanes of `others` get back what they had.
PLYFORM_INLINE void restore(SimdHistory& m, const SimdHistory& before, Longs others) {
  const auto back = [&](Doubles& now, Doubles then) { now = others ? then : now; };
  back(m.damping_force, before.damping_force), back(m.normal_force, before.normal_force);
  back(m.slip, before.slip);
  back(m.s.x, before.s.x), back(m.s.y, before.s.y), back(m.s.z, before.s.z);
}

/// Sum of the forces on the nodes, N, over every fourth contact, as SimdTotals.
struct SimdSum {
  Double4 x{}, y{}, z{};
};

PLYFORM_INLINE void press_group(const ToolPlyKernelContact& k, const ToolGroup& g, SimdTotals& sums,
                                SimdSum& on_nodes) {
  const Columns n = load_columns(g.point, normal_row), held = load_columns(g.point, memory_row);
  const Columns gaps = load_columns(g.point, gap_row);
  const Vectors normal{n.of[0], n.of[1], n.of[2]};
  const Doubles last_gap = gaps.of[3], gap = gaps.of[2] - dot(normal, everywhere(k.advance));
  SimdHistory m{held.of[3], gaps.of[0], gaps.of[1], {held.of[0], held.of[1], held.of[2]}};
  const Longs touch = g.real & (gap < k.sliding_gap);
  const Doubles per_thickness = per_thickness_of(k, g);
  keep_smaller(sums.step_ratio,
               step_ratio_of(k, -gap * per_thickness, (last_gap - gap) * per_thickness));
  Longs loaded = touch | (m.normal_force != 0.0) | (m.damping_force != 0.0);
  if (k.sliding_gap > 0.0) loaded |= square(m.s) > 0.0;
  const unsigned pressed = whole_quads(bits_of(g.real & loaded)); // what four lanes would compute
  if (pressed != 0) {
    const Longs counted = g.real & mask_of(pressed);
    const SimdHistory before = m;
    const Vectors f =
        forces_of(k, g, normal, gap, last_gap, per_thickness, touch, counted, m, sums);
    if (pressed != whole_quads(~0U)) restore(m, before, ~mask_of(pressed));
    set_forces(k, g, f, bits_of(counted));
    add(on_nodes.x, counted ? f.x : all(0.0));
    add(on_nodes.y, counted ? f.y : all(0.0));
    add(on_nodes.z, counted ? f.z : all(0.0));
    store_columns(g.point, g.count, memory_row, {{m.s.x, m.s.y, m.s.z, m.damping_force}});
  }
  store_columns(g.point, g.count, gap_row, {{m.normal_force, m.slip, gap, last_gap}});
}

PLYFORM_INLINE ToolPlyKernelTotals tool_kernel(const ToolPlyKernelContact& k) {
  SimdTotals sums;
  SimdSum f;
  for (int first = 0; first < k.active_count; first += lanes)
    press_group(k, group_of(k, first), sums, f);
  return {sum(sums.elastic),
          sum(sums.friction),
          sum(sums.damping),
          sum(sums.compaction),
          largest(sums.penetration),
          largest(sums.slip),
          smallest(sums.step_ratio),
          sums.touching,
          {sum(f.x), sum(f.y), sum(f.z)}};
}

} // namespace

ToolPlyKernelTotals PLYFORM_COPY_OF(tool_ply_kernel)(const ToolPlyKernelContact& contact) {
  return tool_kernel(contact);
}

} // namespace plyform
