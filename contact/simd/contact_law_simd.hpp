// SPDX-License-Identifier: GPL-3.0-or-later
// (N) and (T) of contact/forces/contact_law.hpp for a contact per SIMD lane, and other functions
// that the contact kernels share. Only those kernels may include this file, as
// base/simd.hpp.
#pragma once

#include "base/simd.hpp"
#include "contact/simd/contact_points.hpp"

#include <cstddef>

namespace plyform {
namespace {

PLYFORM_INLINE Doubles square(const Vectors& a) {
  return dot(a, a);
}

/// Loads (x, y, z, 0) of one node from an array of 3 numbers per node.
PLYFORM_INLINE Double4 load3(const double* at) {
#if defined(__AVX__)
  const Long4 three{-1, -1, -1, 0};
  return reinterpret_cast<Double4>(_mm256_maskload_pd(at, reinterpret_cast<__m256i>(three)));
#else
  return Double4{at[0], at[1], at[2], 0.0};
#endif
}

/// The transpose of a 4 x 4 matrix.
PLYFORM_INLINE Rows transposed(const Rows& r) {
  const Double4 a = __builtin_shufflevector(r.row[0], r.row[1], 0, 4, 2, 6);
  const Double4 b = __builtin_shufflevector(r.row[0], r.row[1], 1, 5, 3, 7);
  const Double4 c = __builtin_shufflevector(r.row[2], r.row[3], 0, 4, 2, 6);
  const Double4 d = __builtin_shufflevector(r.row[2], r.row[3], 1, 5, 3, 7);
  return {{__builtin_shufflevector(a, c, 0, 1, 4, 5), __builtin_shufflevector(b, d, 0, 1, 4, 5),
           __builtin_shufflevector(a, c, 2, 3, 6, 7), __builtin_shufflevector(b, d, 2, 3, 6, 7)}};
}

/// Whether four numbers of a contact point, at offsets of a, b, c, d bytes, are contiguous and
/// aligned to 32 bytes: a row.
consteval bool is_row(std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
  constexpr std::size_t next = sizeof(double);
  return a % sizeof(Double4) == 0 && b == a + next && c == b + next && d == c + next;
}

/// Loads the row of a contact point that begins `row` bytes from its start (InMemory4 may alias its
/// members).
template <class Point>
PLYFORM_INLINE Double4 load_row(const Point* point, std::size_t row) {
  static_assert(alignof(Point) == sizeof(Double4));
  return *reinterpret_cast<const InMemory4*>(reinterpret_cast<const char*>(point) + row);
}

/// Stores four numbers to the row that begins `row` bytes from the start of the point.
template <class Point>
PLYFORM_INLINE void store_row(Point* point, std::size_t row, Double4 a) {
  static_assert(alignof(Point) == sizeof(Double4));
  *reinterpret_cast<InMemory4*>(reinterpret_cast<char*>(point) + row) = a;
}

/// One row of each point: of[i] has number i of all of them.
struct Columns {
  Doubles of[4];
};

template <class Point>
PLYFORM_INLINE Columns load_columns(Point* const* point, std::size_t row) {
  Double4 part[4][quads];
  for (int q = 0; q < quads; ++q) {
    Point* const* p = point + 4 * q;
    const Rows columns = transposed(
        {{load_row(p[0], row), load_row(p[1], row), load_row(p[2], row), load_row(p[3], row)}});
    for (int i = 0; i < 4; ++i)
      part[i][q] = columns.row[i];
  }
  return {{joined(part[0]), joined(part[1]), joined(part[2]), joined(part[3])}};
}

/// The rows of the points of quad `number`.
PLYFORM_INLINE Rows rows(const Columns& c, int number) {
  return transposed({{quad(c.of[0], number), quad(c.of[1], number), quad(c.of[2], number),
                      quad(c.of[3], number)}});
}

/// Stores columns, as load_columns returns them, to that row of the first `count` points.
template <class Point>
PLYFORM_INLINE void store_columns(Point* const* point, int count, std::size_t row,
                                  const Columns& columns) {
  for (int q = 0; q < quads; ++q) {
    const Rows r = rows(columns, q);
    for (int i = 0; i < 4 && 4 * q + i < count; ++i)
      store_row(point[4 * q + i], row, r.row[i]);
  }
}

PLYFORM_INLINE double smallest(Double4 a) {
  const double low = a[0] < a[1] ? a[0] : a[1], high = a[2] < a[3] ? a[2] : a[3];
  return low < high ? low : high;
}

PLYFORM_INLINE double largest(Double4 a) {
  const double low = a[0] > a[1] ? a[0] : a[1], high = a[2] > a[3] ? a[2] : a[3];
  return low > high ? low : high;
}

/// ContactTotals of the kernels: sums, maxima and minima over every fourth contact. With eight
/// lanes the two quads are added one after the other, so that sums are those of four lanes.
struct SimdTotals {
  Double4 elastic{}, friction{}, damping{}, compaction{}, vacuum{};
  Double4 penetration{}, slip{};
  Double4 step_ratio = Double4{1e300, 1e300, 1e300, 1e300};
  int touching = 0;
};

PLYFORM_INLINE void add(Double4& sum, Doubles a) {
  for (int q = 0; q < quads; ++q)
    sum += quad(a, q);
}

PLYFORM_INLINE void keep_larger(Double4& largest, Doubles a) {
  for (int q = 0; q < quads; ++q)
    largest = larger(largest, quad(a, q));
}

PLYFORM_INLINE void keep_smaller(Double4& smallest, Doubles a) {
  for (int q = 0; q < quads; ++q)
    smallest = smaller(smallest, quad(a, q));
}

/// ContactHistory of a contact per lane.
struct SimdHistory {
  Doubles damping_force, normal_force, slip;
  Vectors s;
};

/// s rotated into the plane normal to n, with its length preserved.
PLYFORM_INLINE Vectors into_plane(const Vectors& s, const Vectors& n) {
  const Vectors flat = s - dot(n, s) * n;
  const Doubles length2 = square(s), flat2 = square(flat);
  const Doubles by = flat2 > 0.0 ? root(length2 / flat2) : all(0.0);
  return by * flat;
}

/// q of contact/forces/contact_law.hpp at `depth` (mm) beyond the densest packing.
PLYFORM_INLINE Doubles room_of(const ContactKernelLaw& k, Doubles depth) {
  return larger(1.0 - depth * depth * k.per_depth2, all(least_remaining));
}

/// Pressure (N/mm^2) and work per area (N/mm) of a curve at a depth (mm), held beyond its ends.
struct OnTable {
  double pressure, energy;
};
PLYFORM_INLINE OnTable on_table(const CompactionTable& t, double depth) {
  if (!(depth > 0.0)) return {0.0, 0.0};
  const double at = depth * t.per_spacing;
  int i = at < t.pieces ? static_cast<int>(at) : t.pieces;
  i = i < t.pieces ? i : t.pieces - 1;
  const double along = at - i < 1.0 ? at - i : 1.0, p = t.pressure[i];
  const double rise = along * (t.pressure[i + 1] - p);
  return {p + rise, t.energy[i] + along / t.per_spacing * (p + 0.5 * rise)};
}

/// Depth (mm) at which a curve has a pressure (N/mm^2).
PLYFORM_INLINE double depth_on_table(const CompactionTable& t, double pressure) {
  int low = 0, high = t.pieces; // pressure[low] <= pressure < pressure[high]
  if (!(pressure < t.pressure[high])) return t.packed;
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    (t.pressure[middle] <= pressure ? low : high) = middle;
  }
  return (low + (pressure - t.pressure[low]) / (t.pressure[low + 1] - t.pressure[low])) /
         t.per_spacing;
}

/// At the end of a curve: N/mm^2, and the slope there, N/mm^3.
PLYFORM_INLINE double last_pressure(const CompactionTable& t) {
  return t.pressure[t.pieces];
}
PLYFORM_INLINE double last_rise(const CompactionTable& t) {
  return (t.pressure[t.pieces] - t.pressure[t.pieces - 1]) * t.per_spacing;
}

/// What a contact that has been `compacted` (mm) deep bears at a depth (mm), stores, and has lost
/// per area since it was first loaded: (C) of contact/forces/contact_law.hpp.
struct Compacted {
  double pressure, stored, lost; ///< N/mm^2, N/mm, N/mm
};
PLYFORM_INLINE Compacted compacted_at(const ContactKernelLaw& k, double depth, double compacted) {
  const OnTable most = on_table(k.loading, compacted);
  if (!k.compacted) {
    const OnTable now = on_table(k.loading, depth);
    return {now.pressure, now.energy, 0.0};
  }
  const double from = depth_on_table(k.unloading, most.pressure);
  const OnTable back = on_table(k.unloading, from),
                now = on_table(k.unloading, from - (compacted - depth));
  return {now.pressure, now.energy, most.energy - back.energy};
}

/// The greatest depths so far (mm) of points of slave nodes, if the law asks for them.
template <class Point>
PLYFORM_INLINE Doubles load_compacted(const ContactKernelLaw& k, Point* const* point) {
  if (!k.compacted) return all(0.0);
  return each_lane([&](int i) { return k.compacted[point[i]->node]; });
}

/// `some`: a bit for each lane that has a point of its own.
template <class Point>
PLYFORM_INLINE void store_compacted(const ContactKernelLaw& k, Point* const* point, unsigned some,
                                    Doubles compacted) {
  if (!k.compacted) return;
  alignas(sizeof(Doubles)) double most[lanes];
  store_lanes(most, compacted);
  for (int i = 0; i < lanes; ++i)
    if (has(some, i)) k.compacted[point[i]->node] = most[i];
}

/// Elastic pressure (N/mm^2) and twice the energy per area (N/mm) of contacts at `depth` (mm).
struct SimdElastic {
  Doubles pressure, energy2;
};

/// The law of a contact per lane. compacted: mm, their greatest depths so far, which are updated
/// where `counted`; area: mm^2, of what is lost.
PLYFORM_INLINE SimdElastic elastic_of(const ContactKernelLaw& k, Doubles area, Doubles depth,
                                      Longs counted, Doubles& compacted, SimdTotals& sums) {
  if (k.sliding_gap > 0.0) depth = larger(depth, all(0.0)); // nothing presses across a gap
  if (k.loading.pieces == 0) {
    const Doubles q = room_of(k, depth), rate = k.stiffness * depth;
    return {rate / (q * q), rate * depth / q};
  }
  const Doubles packed = all(k.loading.packed), beyond = larger(depth - packed, all(0.0));
  const Doubles q = room_of(k, beyond), rate = k.stiffness * beyond;
  const Doubles inside = smaller(depth, packed);
  alignas(sizeof(Doubles)) double at[lanes], most[lanes], p[lanes], e[lanes], lost[lanes];
  store_lanes(at, inside), store_lanes(most, compacted);
  for (int i = 0; i < lanes; ++i) {
    const double now = at[i] > most[i] ? at[i] : most[i];
    const Compacted c = compacted_at(k, at[i], now);
    p[i] = c.pressure, e[i] = c.stored;
    lost[i] = now > most[i] ? c.lost - compacted_at(k, most[i], most[i]).lost : 0.0;
    most[i] = now;
  }
  const auto lanes_of = [](const double* v) { return each_lane([v](int i) { return v[i]; }); };
  compacted = counted ? lanes_of(most) : compacted;
  add(sums.compaction, counted ? area * lanes_of(lost) : all(0.0));
  const double rise = last_rise(k.loading); // goes on beyond the curve
  return {lanes_of(p) + beyond * rise + rate / (q * q),
          2.0 * (lanes_of(e) + beyond * (last_pressure(k.loading) + 0.5 * rise * beyond)) +
              rate * beyond / q};
}

/// ContactTotals::step_ratio of contacts at `depth` that closed by `dp` (mm) in the last step.
/// A contact that is still open may close its gap and then use its share of the depth limit.
PLYFORM_INLINE Doubles step_ratio_of(const ContactKernelLaw& k, Doubles depth, Doubles dp) {
  const Doubles inside = larger(depth, all(0.0)), open = inside - depth;
  const Doubles left = larger(1.0 - inside * (1.0 / k.depth_limit), all(0.0)), left2 = left * left;
  const Doubles share = step_share + shallow_share * (left2 * left2 * left);
  const Doubles way = open + share * (k.depth_limit - inside);
  return dp > 0.0 ? larger(way, all(0.0)) / dp : all(1e300);
}

/// (N) per area before forming: normal pressure, N/mm^2, of contacts whose elastic pressure is
/// known. opened: mm, minus their depth in the step before, 0 if they were open then; dp: mm,
/// change of depth in this step (negative depths included); per_thickness: 1 over r. Sets the
/// forces in m (N) and adds the work of damping where `counted`.
PLYFORM_INLINE Doubles normal_pressure(const ContactKernelLaw& k, Doubles area, Doubles elastic,
                                       Doubles depth, Doubles opened, Doubles dp,
                                       Doubles per_thickness, Longs counted, SimdHistory& m,
                                       SimdTotals& sums) {
  const Doubles resistance = larger(k.damping_per_dt * (depth + opened), -elastic);
  const Doubles viscous = area * resistance;
  add(sums.damping, counted ? 0.5 * (viscous + m.damping_force) * dp : all(0.0));
  m.damping_force = viscous;
  const Doubles pressure = per_thickness * (elastic + resistance);
  m.normal_force = area * pressure;
  return pressure;
}

/// What friction beyond Coulomb's law goes by.
struct SimdSliding {
  Doubles by_angle;      ///< f_a of contact/forces/friction_law.hpp
  Doubles per_thickness; ///< 1 over r: before forming the area is that times as large
  Doubles celsius;       ///< degC, of the film; NaN: not known
  double* kept[lanes];   ///< of SlidingPlace
};

/// |s| that is left of `stretch` (mm) by contact/forces/friction_law.hpp, point by point.
PLYFORM_INLINE Doubles stuck_of(const ContactKernelLaw& k, Doubles area, Doubles pressure,
                                const Vectors& held, Doubles stretch, Doubles slip,
                                const SimdSliding& by, Longs touch) {
  alignas(sizeof(Doubles)) double a[lanes], p[lanes], h[lanes], s[lanes], w[lanes], f[lanes],
      r[lanes], t[lanes], left[lanes];
  store_lanes(a, area), store_lanes(p, pressure), store_lanes(h, root(square(held)));
  store_lanes(s, stretch), store_lanes(w, slip), store_lanes(f, by.by_angle);
  store_lanes(r, by.per_thickness), store_lanes(t, by.celsius);
  const unsigned asked = bits_of(touch);
  for (int i = 0; i < lanes; ++i)
    left[i] = !has(asked, i) ? 0.0
                             : k.stuck(k.sliding, {s[i], h[i], k.tangential / r[i], p[i] / r[i],
                                                   w[i], f[i], a[i], t[i], by.kept[i]});
  return each_lane([&](int i) { return left[i]; });
}

/// (T): friction force, N, under `pressure` (N/mm^2). n: normals; remembered: s (mm) of the step
/// before, rotated with the body; slip: relative displacement in this step, mm. Uses k.friction and
/// k.tangential, or k.stuck.
PLYFORM_INLINE Vectors friction_of(const ContactKernelLaw& k, Doubles area, Doubles pressure,
                                   const Vectors& n, const Vectors& remembered, const Vectors& slip,
                                   const SimdSliding& by, Longs touch, SimdHistory& m,
                                   SimdTotals& sums) {
  const Doubles zero = all(0.0);
  const Vectors old = into_plane(remembered, n);
  const Vectors trial = old + slip - dot(n, slip) * n;
  const Doubles stiffness = area * k.tangential;
  const Doubles stretch = root(square(trial));
  const Doubles limit = k.stuck ? stuck_of(k, area, pressure, old, stretch, m.slip, by, touch)
                                : (touch ? (k.friction / k.tangential) * pressure : zero);
  m.s = (stretch > limit ? limit / stretch : all(1.0)) * trial;
  m.slip += touch ? larger(stretch - limit, zero) : zero;
  keep_larger(sums.slip, touch ? m.slip : zero);
  add(sums.friction, 0.5 * stiffness * dot(old + m.s, trial - m.s));
  return -stiffness * m.s;
}

} // namespace
} // namespace plyform
