// SPDX-License-Identifier: GPL-3.0-or-later
// SIMD vectors of four numbers, for the kernels that process four elements or contacts at a time,
// one per SIMD lane.
//
// Only kernel files may include it. Each kernel is compiled for any processor and with AVX2, those
// of bending and of plies in contact also with AVX-512 (cmake/simd.cmake), and the program selects
// the fastest one that the processor supports when it runs. If two copies contained the same inline
// function the linker could keep the AVX2 version for all callers: therefore everything here has
// internal linkage, and kernel files use nothing else that is inline: no Eigen, no containers. No
// copy contracts a * b + c, and all perform the same operations, so results are the same bits on
// any processor.
#pragma once

#include <cmath>
#include <cstdint>
#ifdef __SSE2__
#include <immintrin.h>
#endif

namespace plyform {
namespace {

using Double4 = double __attribute__((vector_size(32)));
/// mask, as comparisons give it: 0 (false) or -1 (true) per lane
using Long4 = std::int64_t __attribute__((vector_size(32)));

/// Four vectors, by components.
struct Vector4 {
  Double4 x, y, z;
};

#define PLYFORM_INLINE [[gnu::always_inline]] inline

PLYFORM_INLINE Double4 all(double a) {
  return Double4{a, a, a, a};
}

using InMemory4 = double __attribute__((vector_size(32), may_alias));

/// Loads four numbers; the address must be aligned to 32 bytes, as for store.
PLYFORM_INLINE Double4 load(const double* at) {
  return *reinterpret_cast<const InMemory4*>(at);
}

PLYFORM_INLINE void store(double* at, Double4 a) {
  *reinterpret_cast<InMemory4*>(at) = a;
}

PLYFORM_INLINE Double4 larger(Double4 a, Double4 b) {
  return a > b ? a : b;
}

PLYFORM_INLINE Double4 smaller(Double4 a, Double4 b) {
  return a < b ? a : b;
}

PLYFORM_INLINE Double4 magnitude(Double4 a) {
  return reinterpret_cast<Double4>(reinterpret_cast<Long4>(a) & INT64_MAX);
}

/// |a| with the sign of b, for a >= 0.
PLYFORM_INLINE Double4 with_sign(Double4 a, Double4 b) {
  return reinterpret_cast<Double4>(reinterpret_cast<Long4>(a) |
                                   (reinterpret_cast<Long4>(b) & INT64_MIN));
}

PLYFORM_INLINE bool any(Long4 mask) {
  return (mask[0] | mask[1] | mask[2] | mask[3]) != 0;
}

PLYFORM_INLINE double sum(Double4 a) {
  return (a[0] + a[1]) + (a[2] + a[3]);
}

PLYFORM_INLINE Double4 root(Double4 a) {
#if defined(__AVX__)
  return reinterpret_cast<Double4>(_mm256_sqrt_pd(reinterpret_cast<__m256d>(a)));
#else
  return Double4{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
#endif
}

PLYFORM_INLINE Vector4 operator+(const Vector4& a, const Vector4& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

PLYFORM_INLINE Vector4 operator-(const Vector4& a, const Vector4& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

PLYFORM_INLINE Vector4 operator*(Double4 s, const Vector4& a) {
  return {s * a.x, s * a.y, s * a.z};
}

PLYFORM_INLINE Double4 dot(const Vector4& a, const Vector4& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

PLYFORM_INLINE Vector4 cross(const Vector4& a, const Vector4& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// The components of four vectors (x, y, z, ignored).
PLYFORM_INLINE Vector4 components(Double4 a, Double4 b, Double4 c, Double4 d) {
  const Double4 xz_ab = __builtin_shufflevector(a, b, 0, 4, 2, 6);
  const Double4 xz_cd = __builtin_shufflevector(c, d, 0, 4, 2, 6);
  const Double4 y_ab = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Double4 y_cd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  return {__builtin_shufflevector(xz_ab, xz_cd, 0, 1, 4, 5),
          __builtin_shufflevector(y_ab, y_cd, 0, 1, 4, 5),
          __builtin_shufflevector(xz_ab, xz_cd, 2, 3, 6, 7)};
}

/// The four vectors (x, y, z, 0).
struct Rows {
  Double4 row[4];
};

PLYFORM_INLINE Rows rows(const Vector4& v) {
  const Double4 zero = all(0.0);
  const Double4 xy_02 = __builtin_shufflevector(v.x, v.y, 0, 4, 2, 6);
  const Double4 xy_13 = __builtin_shufflevector(v.x, v.y, 1, 5, 3, 7);
  const Double4 z_02 = __builtin_shufflevector(v.z, zero, 0, 4, 2, 6);
  const Double4 z_13 = __builtin_shufflevector(v.z, zero, 1, 5, 3, 7);
  return {{__builtin_shufflevector(xy_02, z_02, 0, 1, 4, 5),
           __builtin_shufflevector(xy_13, z_13, 0, 1, 4, 5),
           __builtin_shufflevector(xy_02, z_02, 2, 3, 6, 7),
           __builtin_shufflevector(xy_13, z_13, 2, 3, 6, 7)}};
}

/// arctan(a / b) for b >= 0 and c = sqrt(a^2 + b^2), in -pi/2 .. pi/2, to 1e-15. Half the angle has
/// the tangent a / (c + b); if it exceeds 15 degrees it is reduced by 30 degrees. The polynomial is
/// minimax for the relative error (by Remez' exchange), which is 1.0e-15 up to tan(15 degrees).
PLYFORM_INLINE Double4 arctan(Double4 a, Double4 b, Double4 c) {
  constexpr double tan15 = 0.26794919243112270647, tan30 = 0.57735026918962576451;
  constexpr double pi = 3.14159265358979323846;
  const Double4 side = magnitude(a), sum = c + b;
  const Long4 far = side > tan15 * sum;
  const Double4 off = far ? all(tan30) : all(0.0);
  const Double4 t = (side - off * sum) / (sum + off * side);
  const Double4 z = t * t, z2 = z * z, z4 = z2 * z2;
  const Double4 p0 = z * 0.19999999957678302 - 0.33333333333215248;
  const Double4 p2 = z * 0.11110814826967305 - 0.1428570914925909;
  const Double4 p4 = z * 0.075343042160564311 - 0.09081725273026571;
  const Double4 p = (p0 + z2 * p2) + z4 * (p4 - z2 * 0.052221523715879417);
  const Double4 half = t + (t * z) * p; // t as a term of its own keeps all digits of small angles
  return with_sign(magnitude((half + half) + (far ? all(pi / 3) : all(0.0))), a);
}

} // namespace
} // namespace plyform
