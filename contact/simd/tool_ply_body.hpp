// SPDX-License-Identifier: GPL-3.0-or-later
// Forces between a tool and four nodes at a time, whose gaps and normals have been measured.
#include "contact/simd/contact_law_simd.hpp"
#include "contact/simd/tool_ply_kernel.hpp"

namespace plyform {
namespace {

/// Up to four points. Those from `count` on are copies of the first, to fill the SIMD lanes; `real`
/// is their mask.
struct ToolGroup {
  ToolPlyPoint* point[lanes];
  int count;
  Long4 real;
};

PLYFORM_INLINE ToolGroup group_of(const ToolPlyKernelContact& k, int first) {
  ToolGroup g;
  g.count = k.active_count - first < lanes ? k.active_count - first : lanes;
  for (int i = 0; i < lanes; ++i)
    g.point[i] = k.points + k.active[first + (i < g.count ? i : 0)];
  g.real = Long4{0, 1, 2, 3} < static_cast<std::int64_t>(g.count);
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

PLYFORM_INLINE Double4 areas(const ToolPlyKernelContact& k, const ToolGroup& g) {
  return Double4{k.area[g.point[0]->node], k.area[g.point[1]->node], k.area[g.point[2]->node],
                 k.area[g.point[3]->node]};
}

PLYFORM_INLINE Vector4 motions(const ToolPlyKernelContact& k, const ToolGroup& g) {
  Double4 u[lanes];
  for (int i = 0; i < lanes; ++i)
    u[i] = load3(k.motion + 3 * static_cast<std::int64_t>(g.point[i]->node));
  return components(u);
}

PLYFORM_INLINE void set_forces(const ToolPlyKernelContact& k, const ToolGroup& g,
                               const Vector4& f) {
  const Rows r = rows(f);
  for (int i = 0; i < g.count; ++i) {
    double* at = k.force + 3 * static_cast<std::int64_t>(g.point[i]->node);
    at[0] = r.row[i][0], at[1] = r.row[i][1], at[2] = r.row[i][2];
  }
}

PLYFORM_INLINE Vector4 everywhere(const double* v) {
  return {all(v[0]), all(v[1]), all(v[2])};
}

/// Forces (N) on four nodes. For a point that has opened the energy of its tangential spring is
/// counted as frictional dissipation; with area 0 the law then resets its history but for the slip,
/// which is reset here.
PLYFORM_INLINE Vector4 forces_of(const ToolPlyKernelContact& k, const ToolGroup& g,
                                 const Vector4& normal, Double4 gap, Double4 last_gap, Long4 touch,
                                 SimdHistory& m, SimdTotals& sums) {
  const Double4 zero = all(0.0), whole = areas(k, g), area = touch ? whole : zero;
  const Double4 depth = -gap, dp = last_gap - gap;
  const Double4 opening = g.real & ~touch ? whole : zero;
  sums.friction += 0.5 * opening * k.tangential * square(m.s);
  const Double4 pressure =
      normal_pressure(k, area, depth, smaller(last_gap, zero), dp, g.real, m, sums);
  Vector4 f = m.normal_force * normal;
  if (k.friction > 0.0) {
    const Vector4 slip = motions(k, g) - everywhere(k.tool_motion);
    f = f + friction_of(k, area, pressure, normal, m.s, slip, touch, m, sums);
    m.slip = touch ? m.slip : zero;
  }
  sums.elastic +=
      0.5 * area * (k.stiffness * depth * depth / room_of(k, depth) + k.tangential * square(m.s));
  sums.penetration = larger(sums.penetration, touch ? depth : zero);
  for (int i = 0; i < g.count; ++i)
    sums.touching += touch[i] ? 1 : 0;
  return f;
}

PLYFORM_INLINE void press_group(const ToolPlyKernelContact& k, const ToolGroup& g, SimdTotals& sums,
                                Vector4& on_nodes) {
  const Columns n = load_columns(g.point, normal_row), held = load_columns(g.point, memory_row);
  const Columns gaps = load_columns(g.point, gap_row);
  const Vector4 normal{n.of[0], n.of[1], n.of[2]};
  const Double4 last_gap = gaps.of[3], gap = gaps.of[2] - dot(normal, everywhere(k.advance));
  SimdHistory m{held.of[3], gaps.of[0], gaps.of[1], {held.of[0], held.of[1], held.of[2]}};
  const Long4 touch = g.real & (gap < 0.0);
  sums.step_ratio = smaller(sums.step_ratio, step_ratio_of(k, -gap, last_gap - gap));
  if (any(touch | (m.normal_force != 0.0) | (m.damping_force != 0.0))) {
    const Vector4 f = forces_of(k, g, normal, gap, last_gap, touch, m, sums);
    set_forces(k, g, f);
    on_nodes = on_nodes +
               Vector4{g.real ? f.x : all(0.0), g.real ? f.y : all(0.0), g.real ? f.z : all(0.0)};
    store_columns(g.point, g.count, memory_row, {{m.s.x, m.s.y, m.s.z, m.damping_force}});
  }
  store_columns(g.point, g.count, gap_row, {{m.normal_force, m.slip, gap, last_gap}});
}

PLYFORM_INLINE ToolPlyKernelTotals tool_kernel(const ToolPlyKernelContact& k) {
  SimdTotals sums;
  Vector4 f{all(0.0), all(0.0), all(0.0)};
  for (int first = 0; first < k.active_count; first += lanes)
    press_group(k, group_of(k, first), sums, f);
  return {sum(sums.elastic),  sum(sums.friction),
          sum(sums.damping),  largest(sums.penetration),
          largest(sums.slip), smallest(sums.step_ratio),
          sums.touching,      {sum(f.x), sum(f.y), sum(f.z)}};
}

} // namespace
} // namespace plyform
