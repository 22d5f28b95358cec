// SPDX-License-Identifier: GPL-3.0-or-later
// Kinematics of the triangles of the kernel of core/ply/membrane_simd.hpp, one per lane:
//   a = k_1.k_1,  b = k_2.k_2,  d = k_1.k_2,  J = sqrt(a b - d^2) = lambda_1 lambda_2 sin(omega)
//   gamma = omega0 - pi/2 + arctan(d / J)
#pragma once

#include "core/ply/element_limits.hpp"
#include "core/ply/membrane_simd_kernel.hpp"
#include "core/ply/simd_kernel_body.hpp"

namespace plyform {
namespace {

using TrianglesOfQuads = OfQuads<const SimdTriangles>;

/// KernelLaw with each number copied to all SIMD lanes.
struct SimdYarns {
  Doubles stiffness, compression, viscosity, stabilisation, collapse_penalty; ///< viscosity: N/mm
};

struct SimdLaw {
  SimdYarns yarns[2];
  Doubles angle, beta, shear[most_shear_terms];
};

PLYFORM_INLINE SimdLaw simd_law(const KernelLaw& law, double per_dt) {
  SimdLaw l;
  for (int a = 0; a < 2; ++a) {
    const KernelYarns& y = law.yarns[a];
    l.yarns[a] = {all(y.stiffness), all(y.compression), all(y.viscosity * per_dt),
                  all(y.stabilisation), all(y.collapse_penalty)};
  }
  l.angle = all(law.angle), l.beta = all(law.beta);
  for (int i = 0; i < most_shear_terms; ++i)
    l.shear[i] = all(law.shear[i]);
  return l;
}

/// Kinematics of a vector of triangles: the symbols at the head of this file.
struct SimdState {
  Vectors k1, k2;
  Doubles a, b, d, lambda1, lambda2, j;
  Doubles gamma, area_a, area_b, per_j; ///< area_a: A0 / a; per_j: 1 / J
};

/// mm, from corner 0 to another.
PLYFORM_INLINE Vectors side(const TrianglesOfQuads& t, int corner, const double* place) {
  Double4 to[lanes];
  for (int q = 0; q < quads; ++q)
    for (int i = 0; i < simd_width; ++i)
      to[simd_width * q + i] = load(of_node(place, t.of[q]->node[corner][i])) -
                               load(of_node(place, t.of[q]->node[0][i]));
  return components(to);
}

/// FibreGradients, 1/mm.
struct SimdGradients {
  Doubles c11, c12, c21, c22;
};

PLYFORM_INLINE SimdGradients gradients(const TrianglesOfQuads& t) {
  return {
      numbers([&](int q) { return t.of[q]->c11; }), numbers([&](int q) { return t.of[q]->c12; }),
      numbers([&](int q) { return t.of[q]->c21; }), numbers([&](int q) { return t.of[q]->c22; })};
}

/// A0, mm^2.
PLYFORM_INLINE Doubles area_of(const TrianglesOfQuads& t) {
  return numbers([&](int q) { return t.of[q]->area; });
}

PLYFORM_INLINE Doubles share_of(const TrianglesOfQuads& t) {
  return numbers([&](int q) { return t.of[q]->share; });
}

PLYFORM_INLINE void find_lengths(const TrianglesOfQuads& t, const double* place, SimdState& s) {
  const Vectors g1 = side(t, 1, place), g2 = side(t, 2, place);
  const SimdGradients c = gradients(t);
  const Vectors k1 = c.c11 * g1 + c.c12 * g2; // (11)
  const Vectors k2 = c.c21 * g1 + c.c22 * g2;
  const Doubles a = dot(k1, k1), b = dot(k2, k2), d = dot(k1, k2), ab = a * b;
  constexpr double least_sine2 = least_sine * least_sine;
  // by component: whole vectors compile to slower copies
  s.k1.x = k1.x, s.k1.y = k1.y, s.k1.z = k1.z;
  s.k2.x = k2.x, s.k2.y = k2.y, s.k2.z = k2.z;
  s.a = a, s.b = b, s.d = d;
  s.j = root(larger(ab - d * d, least_sine2 * ab));
  s.lambda1 = root(a), s.lambda2 = root(b);
}

/// Computes the shear angles. Returns the mask of triangles that have collapsed, have an active
/// collapse penalty, or are not finite.
PLYFORM_INLINE Longs find_angle(const TrianglesOfQuads& t, const SimdLaw& law, SimdState& s) {
  const Doubles length2 = s.lambda1 * s.lambda2;
  const Doubles ab = s.a * s.b, aj = s.a * s.j, bj = s.b * s.j;
  const Doubles inverse = 1.0 / (ab * s.j), area = area_of(t) * inverse;
  s.area_a = area * bj, s.area_b = area * aj, s.per_j = inverse * ab;
  s.gamma = law.angle + arctan(s.d, s.j, length2);
  const Longs valid = (s.lambda1 > all(collapse_stretch)) & (s.lambda2 > all(collapse_stretch)) &
                      (s.j > least_sine_between * length2);
  return ~valid;
}

/// Mask of collapsed triangles, as collapsed() of core/ply/membrane.hpp; NaN counts as collapsed.
PLYFORM_INLINE Longs simd_collapsed(const SimdState& s) {
  const Longs valid = (s.lambda1 > all(least_stretch)) & (s.lambda2 > all(least_stretch)) &
                      (s.j > least_sine_between * (s.lambda1 * s.lambda2));
  return ~valid;
}

/// Kinematics of `count` vectors of triangles; returns whether any triangle needs the test for
/// collapse and the collapse penalty.
PLYFORM_INLINE bool find_states(const TrianglesOfQuads* t, int count, const SimdLaw& law,
                                const double* place, SimdState* s) {
  for (int i = 0; i < count; ++i)
    find_lengths(t[i], place, s[i]);
  Longs needs_penalty{};
  for (int i = 0; i < count; ++i)
    needs_penalty |= find_angle(t[i], law, s[i]);
  return any(needs_penalty);
}

} // namespace
} // namespace plyform
