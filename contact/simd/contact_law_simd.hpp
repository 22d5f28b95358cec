// SPDX-License-Identifier: GPL-3.0-or-later
// (N) and (T) of contact/forces/contact_law.hpp for four contacts at a time, and other functions
// that the contact kernels share. Only those kernels may include this file, as
// contact/simd/simd.hpp.
#pragma once

#include "contact/simd/contact_points.hpp"
#include "contact/simd/simd.hpp"

#include <cstddef>

namespace plyform {
namespace {

constexpr int simd_width = 4;

PLYFORM_INLINE Double4 square(const Vector4& a) {
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

/// Loads one row of four points, transposed: row[i] of the result is column i, of all four points.
template <class Point>
PLYFORM_INLINE Rows load_columns(Point* const* point, std::size_t row) {
  return transposed({{load_row(point[0], row), load_row(point[1], row), load_row(point[2], row),
                      load_row(point[3], row)}});
}

/// Stores columns, as load_columns returns them, to that row of the first `count` of four points.
template <class Point>
PLYFORM_INLINE void store_columns(Point* const* point, int count, std::size_t row,
                                  const Rows& columns) {
  const Rows r = transposed(columns);
  for (int i = 0; i < count; ++i)
    store_row(point[i], row, r.row[i]);
}

PLYFORM_INLINE double smallest(Double4 a) {
  const double low = a[0] < a[1] ? a[0] : a[1], high = a[2] < a[3] ? a[2] : a[3];
  return low < high ? low : high;
}

PLYFORM_INLINE double largest(Double4 a) {
  const double low = a[0] > a[1] ? a[0] : a[1], high = a[2] > a[3] ? a[2] : a[3];
  return low > high ? low : high;
}

/// ContactTotals of the kernels: sums, maxima and minima per SIMD lane, over every fourth contact.
struct SimdTotals {
  Double4 elastic = all(0.0), friction = all(0.0), damping = all(0.0);
  Double4 penetration = all(0.0), slip = all(0.0);
  Double4 step_ratio = all(1e300);
  int touching = 0;
};

/// ContactHistory of four contacts.
struct SimdHistory {
  Double4 damping_force, normal_force, slip;
  Vector4 s;
};

/// s rotated into the plane normal to n, with its length preserved.
PLYFORM_INLINE Vector4 into_plane(const Vector4& s, const Vector4& n) {
  const Vector4 flat = s - dot(n, s) * n;
  const Double4 length2 = square(s), flat2 = square(flat);
  const Double4 by = flat2 > 0.0 ? root(length2 / flat2) : all(0.0);
  return by * flat;
}

/// q of contact/forces/contact_law.hpp at `depth` (mm).
template <class Contact>
PLYFORM_INLINE Double4 room_of(const Contact& k, Double4 depth) {
  return larger(1.0 - depth * depth * k.per_depth2, all(least_room));
}

/// ContactTotals::step_ratio of four contacts at `depth` that closed by `dp` (mm) in the last step.
/// A contact that is still open may close its gap and then use step_share of the depth limit.
template <class Contact>
PLYFORM_INLINE Double4 step_ratio_of(const Contact& k, Double4 depth, Double4 dp) {
  const Double4 inside = larger(depth, all(0.0)), open = inside - depth;
  const Double4 way = open + step_share * (k.max_depth - inside);
  return dp > 0.0 ? larger(way, all(0.0)) / dp : all(1e300);
}

/// (N) per area: normal pressure, N/mm^2, of contacts `depth` mm deep. opened: mm, minus their
/// depth in the step before, 0 if they were open then; dp: mm, change of depth in this step
/// (negative depths included). Sets the forces in m (N) and adds the work of damping where
/// `counted`. Uses k.stiffness, k.damping_per_dt, k.per_depth2.
template <class Contact>
PLYFORM_INLINE Double4 normal_pressure(const Contact& k, Double4 area, Double4 depth,
                                       Double4 opened, Double4 dp, Long4 counted, SimdHistory& m,
                                       SimdTotals& sums) {
  const Double4 q = room_of(k, depth);
  const Double4 pressure = k.stiffness * depth / (q * q); // N/mm^2, elastic and viscous
  const Double4 resistance = larger(k.damping_per_dt * (depth + opened), -pressure);
  const Double4 viscous = area * resistance;
  sums.damping += counted ? 0.5 * (viscous + m.damping_force) * dp : all(0.0);
  m.damping_force = viscous;
  m.normal_force = area * (pressure + resistance);
  return pressure + resistance;
}

/// (T): friction force, N, under `pressure` (N/mm^2). n: normals; remembered: s (mm) of the step
/// before, rotated with the body; slip: relative displacement in this step, mm. Uses k.friction and
/// k.tangential.
template <class Contact>
PLYFORM_INLINE Vector4 friction_of(const Contact& k, Double4 area, Double4 pressure,
                                   const Vector4& n, const Vector4& remembered, const Vector4& slip,
                                   Long4 touch, SimdHistory& m, SimdTotals& sums) {
  const Double4 zero = all(0.0);
  const Vector4 old = into_plane(remembered, n);
  const Vector4 trial = old + slip - dot(n, slip) * n;
  const Double4 stiffness = area * k.tangential;
  const Double4 limit = touch ? (k.friction / k.tangential) * pressure : zero;
  const Double4 stretch = root(square(trial));
  m.s = (stretch > limit ? limit / stretch : all(1.0)) * trial;
  m.slip += touch ? larger(stretch - limit, zero) : zero;
  sums.slip = larger(sums.slip, touch ? m.slip : zero);
  sums.friction += 0.5 * stiffness * dot(old + m.s, trial - m.s);
  return -stiffness * m.s;
}

} // namespace
} // namespace plyform
