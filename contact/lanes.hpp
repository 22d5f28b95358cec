// SPDX-License-Identifier: GPL-3.0-or-later
// Four numbers side by side, for the kernels that do four elements or contacts at a time.
//
// Only for the files that hold such a kernel. Each is compiled twice, for any processor and with
// AVX2 (cmake/lanes.cmake), and the faster one is chosen when the program runs. So that the linker
// cannot take a function compiled with AVX2 for all, everything here has internal linkage and such
// files use nothing else that is inline: no Eigen, no containers. Neither copy contracts a * b + c,
// and both do the same operations: the same bits on any processor.
#pragma once

#include <cmath>
#include <cstdint>
#ifdef __SSE2__
#include <immintrin.h>
#endif

namespace plyform {
namespace {

using Double4 = double __attribute__((vector_size(32)));
using Long4 = std::int64_t __attribute__((vector_size(32))); ///< of a comparison: 0 or -1

/// Three components of four vectors.
struct Vector4 {
  Double4 x, y, z;
};

#define PLYFORM_INLINE [[gnu::always_inline]] inline

PLYFORM_INLINE Double4 all(double a) {
  return Double4{a, a, a, a};
}

using InMemory4 = double __attribute__((vector_size(32), may_alias));

/// Aligned to 32 bytes.
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

/// Four vectors (x, y, z, anything) to their components.
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

/// arctan(a / b) for b >= 0, in -pi/2 .. pi/2, to 3e-16. With the nearest of 0, 30, 60 and 90
/// degrees taken off first, |t| <= tan(15 degrees) and the series of arctan has its last bit after
/// fourteen terms.
PLYFORM_INLINE Double4 arctan(Double4 a, Double4 b) {
  constexpr double half = 0.5, root3 = 0.86602540378443864676; // sines of 30 and 60 degrees
  constexpr double tan15 = 0.26794919243112270647, pi = 3.14159265358979323846;
  const Double4 side = magnitude(a);
  const Long4 first = side > tan15 * b, second = side > b, third = side * tan15 > b;
  const Double4 c = third ? all(0.0) : second ? all(half) : first ? all(root3) : all(1.0);
  const Double4 s = third ? all(1.0) : second ? all(root3) : first ? all(half) : all(0.0);
  const Double4 angle = third ? all(pi / 2) : second ? all(pi / 3) : first ? all(pi / 6) : all(0.0);
  const Double4 t = (side * c - b * s) / (b * c + side * s);
  const Double4 z = t * t, zz = z * z;
  Double4 even = all(1.0 / 25), odd = all(-1.0 / 27);
  even = even * zz + 1.0 / 21, odd = odd * zz - 1.0 / 23;
  even = even * zz + 1.0 / 17, odd = odd * zz - 1.0 / 19;
  even = even * zz + 1.0 / 13, odd = odd * zz - 1.0 / 15;
  even = even * zz + 1.0 / 9, odd = odd * zz - 1.0 / 11;
  even = even * zz + 1.0 / 5, odd = odd * zz - 1.0 / 7;
  even = even * zz, odd = odd * zz - 1.0 / 3;
  // t stands alone, so that small angles keep all their digits
  return with_sign(magnitude(angle + (t + t * (even + z * odd))), a);
}

} // namespace
} // namespace plyform
