// SPDX-License-Identifier: GPL-3.0-or-later
// SIMD vectors for the kernels, which process four elements or contacts at a time, one per SIMD
// lane; those that are written for any number of lanes (Doubles, Vectors) process eight with
// AVX-512.
//
// Only kernel files may include it. Each kernel is compiled for any processor, with AVX2 and with
// AVX-512 (cmake/simd.cmake), and the program selects the fastest one that the processor supports
// when it runs. If two copies contained the same inline function the linker could keep the AVX2
// version for all callers: therefore everything here has internal linkage, and kernel files use
// nothing else that is inline: no Eigen, no containers. No copy contracts a * b + c, and all
// perform the same operations, and add up in the same order, by fours, so results are the same bits
// on any processor.
#pragma once

#include <cmath>
#include <cstdint>
#include <type_traits>
#ifdef __SSE2__
#include <immintrin.h>
#endif

namespace plyform {
namespace {

/// Numbers that a kernel computes at a time, one per SIMD lane: four, or eight where
/// cmake/simd.cmake says so. A quad is four successive lanes.
#ifndef PLYFORM_LANES
#define PLYFORM_LANES 4
#endif
constexpr int lanes = PLYFORM_LANES, quads = lanes / 4;

using Double4 = double __attribute__((vector_size(32)));
using Doubles = double __attribute__((vector_size(8 * lanes)));
/// mask, as comparisons give it: 0 (false) or -1 (true) per lane
using Long4 = std::int64_t __attribute__((vector_size(32)));
using Longs = std::int64_t __attribute__((vector_size(8 * lanes)));
/// The mask of comparisons of D.
template <class D>
using MaskOf = decltype(D{} < D{});

/// One vector per lane, by components.
template <class D>
struct VectorsOf {
  D x, y, z;
};
using Vector4 = VectorsOf<Double4>;
using Vectors = VectorsOf<Doubles>;

#define PLYFORM_INLINE [[gnu::always_inline]] inline

/// The name of a function in each copy of a kernel: f_generic, f_avx2, f_avx512. cmake/simd.cmake
/// says which copy is compiled (PLYFORM_COPY).
#define PLYFORM_COPY_OF(function) PLYFORM_JOINED(function, PLYFORM_COPY)
#define PLYFORM_JOINED(function, copy) PLYFORM_JOINED_NAMES(function, copy)
#define PLYFORM_JOINED_NAMES(function, copy) function##_##copy

PLYFORM_INLINE Doubles all(double a) {
  return a - Doubles{};
}

/// The numbers number(0), number(1), ..., one per lane.
template <class Number>
PLYFORM_INLINE auto each_lane(const Number& number) {
  using Wide = std::conditional_t<std::is_same_v<decltype(number(0)), double>, Doubles, Longs>;
#if PLYFORM_LANES == 8
  return Wide{number(0), number(1), number(2), number(3),
              number(4), number(5), number(6), number(7)};
#else
  return Wide{number(0), number(1), number(2), number(3)};
#endif
}

#if PLYFORM_LANES == 8
constexpr Longs lane_bits{1, 2, 4, 8, 16, 32, 64, 128};

/// The numbers of a quad.
PLYFORM_INLINE Double4 quad(Doubles a, int number) {
  return number == 0 ? __builtin_shufflevector(a, a, 0, 1, 2, 3)
                     : __builtin_shufflevector(a, a, 4, 5, 6, 7);
}

/// The numbers of all quads.
PLYFORM_INLINE Doubles joined(const Double4* quad) {
  return __builtin_shufflevector(quad[0], quad[1], 0, 1, 2, 3, 4, 5, 6, 7);
}
#else
constexpr Longs lane_bits{1, 2, 4, 8};

PLYFORM_INLINE Double4 quad(Doubles a, int) {
  return a;
}

PLYFORM_INLINE Doubles joined(const Double4* quad) {
  return quad[0];
}
#endif

/// Bit i: whether lane i of the mask is true.
PLYFORM_INLINE unsigned bits_of(Longs mask) {
#if defined(__AVX512DQ__) && PLYFORM_LANES == 8
  return _mm512_movepi64_mask(reinterpret_cast<__m512i>(mask));
#elif defined(__AVX__) && PLYFORM_LANES == 4
  return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(mask)));
#else
  unsigned bits = 0;
  for (int i = 0; i < lanes; ++i)
    bits |= static_cast<unsigned>(mask[i] & (1 << i));
  return bits;
#endif
}

/// The mask of such bits.
PLYFORM_INLINE Longs mask_of(unsigned bits) {
  return (lane_bits & std::int64_t{bits}) != 0;
}

/// Whether bit `number` is set.
PLYFORM_INLINE bool has(std::uint64_t bits, int number) {
  return (bits >> number & 1) != 0;
}

/// All bits of the quads of which one is set.
PLYFORM_INLINE unsigned whole_quads(unsigned bits) {
  unsigned whole = 0;
  for (int q = 0; q < quads; ++q)
    whole |= bits & 15U << 4 * q ? 15U << 4 * q : 0U;
  return whole;
}

using InMemory4 = double __attribute__((vector_size(32), may_alias));

/// Loads four numbers; the address must be aligned to 32 bytes, as for store.
PLYFORM_INLINE Double4 load(const double* at) {
  return *reinterpret_cast<const InMemory4*>(at);
}

PLYFORM_INLINE void store(double* at, Double4 a) {
  *reinterpret_cast<InMemory4*>(at) = a;
}

/// Stores the numbers of all lanes; the address must be aligned to their size.
template <class Number, class Wide>
PLYFORM_INLINE void store_lanes(Number* at, Wide a) {
  using InMemory [[gnu::may_alias]] = Wide;
  *reinterpret_cast<InMemory*>(at) = a;
}

template <class D>
PLYFORM_INLINE D larger(D a, D b) {
  return a > b ? a : b;
}

template <class D>
PLYFORM_INLINE D smaller(D a, D b) {
  return a < b ? a : b;
}

template <class D>
PLYFORM_INLINE D magnitude(D a) {
  return reinterpret_cast<D>(reinterpret_cast<MaskOf<D>>(a) & INT64_MAX);
}

/// |a| with the sign of b, for a >= 0.
template <class D>
PLYFORM_INLINE D with_sign(D a, D b) {
  return reinterpret_cast<D>(reinterpret_cast<MaskOf<D>>(a) |
                             (reinterpret_cast<MaskOf<D>>(b) & INT64_MIN));
}

PLYFORM_INLINE bool any(Longs mask) {
  return bits_of(mask) != 0;
}

PLYFORM_INLINE double sum(Double4 a) {
  return (a[0] + a[1]) + (a[2] + a[3]);
}

PLYFORM_INLINE Doubles root(Doubles a) {
#if defined(__AVX512F__) && PLYFORM_LANES == 8
  // by a mask, as GCC 12 takes what _mm512_sqrt_pd leaves undefined for a fault
  return reinterpret_cast<Doubles>(_mm512_maskz_sqrt_pd(255, reinterpret_cast<__m512d>(a)));
#elif defined(__AVX__) && PLYFORM_LANES == 4
  return reinterpret_cast<Doubles>(_mm256_sqrt_pd(reinterpret_cast<__m256d>(a)));
#else
  for (int i = 0; i < lanes; ++i)
    a[i] = std::sqrt(a[i]);
  return a;
#endif
}

template <class D>
PLYFORM_INLINE VectorsOf<D> operator+(const VectorsOf<D>& a, const VectorsOf<D>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

template <class D>
PLYFORM_INLINE VectorsOf<D> operator-(const VectorsOf<D>& a, const VectorsOf<D>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

template <class D>
PLYFORM_INLINE VectorsOf<D> operator*(D s, const VectorsOf<D>& a) {
  return {s * a.x, s * a.y, s * a.z};
}

template <class D>
PLYFORM_INLINE D dot(const VectorsOf<D>& a, const VectorsOf<D>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class D>
PLYFORM_INLINE VectorsOf<D> cross(const VectorsOf<D>& a, const VectorsOf<D>& b) {
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

/// The components of one vector (x, y, z, ignored) per lane.
PLYFORM_INLINE Vectors components(const Double4* vector) {
  Double4 x[quads], y[quads], z[quads];
  for (int q = 0; q < quads; ++q) {
    const Double4* v = vector + 4 * q;
    const Vector4 four = components(v[0], v[1], v[2], v[3]);
    x[q] = four.x, y[q] = four.y, z[q] = four.z;
  }
  return {joined(x), joined(y), joined(z)};
}

/// The vectors (x, y, z, 0) of a quad.
struct Rows {
  Double4 row[4];
};

PLYFORM_INLINE Rows rows(const Vector4& v) {
  const Double4 zero{};
  const Double4 xy_02 = __builtin_shufflevector(v.x, v.y, 0, 4, 2, 6);
  const Double4 xy_13 = __builtin_shufflevector(v.x, v.y, 1, 5, 3, 7);
  const Double4 z_02 = __builtin_shufflevector(v.z, zero, 0, 4, 2, 6);
  const Double4 z_13 = __builtin_shufflevector(v.z, zero, 1, 5, 3, 7);
  return {{__builtin_shufflevector(xy_02, z_02, 0, 1, 4, 5),
           __builtin_shufflevector(xy_13, z_13, 0, 1, 4, 5),
           __builtin_shufflevector(xy_02, z_02, 2, 3, 6, 7),
           __builtin_shufflevector(xy_13, z_13, 2, 3, 6, 7)}};
}

/// The vectors of quad `number`.
PLYFORM_INLINE Rows rows(const Vectors& v, int number) {
  return rows(Vector4{quad(v.x, number), quad(v.y, number), quad(v.z, number)});
}

/// arctan(a / b) for b >= 0 and c = sqrt(a^2 + b^2), in -pi/2 .. pi/2, to 1e-15. Half the angle has
/// the tangent a / (c + b); if it exceeds 15 degrees it is reduced by 30 degrees. The polynomial is
/// minimax for the relative error (by Remez' exchange), which is 1.0e-15 up to tan(15 degrees).
PLYFORM_INLINE Doubles arctan(Doubles a, Doubles b, Doubles c) {
  constexpr double tan15 = 0.26794919243112270647, tan30 = 0.57735026918962576451;
  constexpr double pi = 3.14159265358979323846;
  const Doubles side = magnitude(a), sum = c + b;
  const Longs far = side > tan15 * sum;
  const Doubles off = far ? all(tan30) : all(0.0);
  const Doubles t = (side - off * sum) / (sum + off * side);
  const Doubles z = t * t, z2 = z * z, z4 = z2 * z2;
  const Doubles p0 = z * 0.19999999957678302 - 0.33333333333215248;
  const Doubles p2 = z * 0.11110814826967305 - 0.1428570914925909;
  const Doubles p4 = z * 0.075343042160564311 - 0.09081725273026571;
  const Doubles p = (p0 + z2 * p2) + z4 * (p4 - z2 * 0.052221523715879417);
  const Doubles half = t + (t * z) * p; // t as a term of its own keeps all digits of small angles
  return with_sign(magnitude((half + half) + (far ? all(pi / 3) : all(0.0))), a);
}

} // namespace
} // namespace plyform
