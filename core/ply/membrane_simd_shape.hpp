// SPDX-License-Identifier: GPL-3.0-or-later
// Kinematics of the triangles of the kernel of core/ply/membrane_simd.hpp, one per lane. Of the
// material axes:
//   a = k_1.k_1,  b = k_2.k_2,  d = k_1.k_2,  J = |k_1 x k_2| = sqrt(a b - d^2)
// All else follows from these four. Of a family with components v:
//   lambda^2 = v_1^2 a + 2 v_1 v_2 d + v_2^2 b
// Of a crossing of the families v and w:
//   D = v_1 w_1 a + (v_1 w_2 + v_2 w_1) d + v_2 w_2 b,  j = |v_1 w_2 - v_2 w_1| J
//   gamma = omega0 - pi/2 + arctan(D / j)
#pragma once

#include "core/ply/element_limits.hpp"
#include "core/ply/membrane_simd_kernel.hpp"
#include "core/ply/simd_kernel_body.hpp"

namespace plyform {
namespace {

using TrianglesOfQuads = OfQuads<const SimdTriangles>;

/// Calls each(c, first, second) for all crossings.
template <class Of, class Each>
PLYFORM_INLINE void for_crossings(const KernelLaw& law, const Each& each) {
  if constexpr (Of::weave) {
    each(Count<0>{}, Count<0>{}, Count<1>{});
  } else {
    for (int c = 0; c < law.crossings; ++c)
      each(c, law.crossing[c].first, law.crossing[c].second);
  }
}

/// Families and directions of stitches together.
template <class Of>
PLYFORM_INLINE int directions(const KernelLaw& law) {
  if constexpr (Of::weave) return Of::most_families;
  return law.families + law.stitches;
}

/// Calls each(a) for all directions of stitches, which are numbered behind the families.
template <class Of, class Each>
PLYFORM_INLINE void for_stitches(const KernelLaw& law, const Each& each) {
  if constexpr (Of::weave) {
    if constexpr (Of::stitches > 0) each(Count<2>{});
    if constexpr (Of::stitches > 1) each(Count<3>{});
  } else {
    for (int a = law.families; a < law.families + law.stitches; ++a)
      each(a);
  }
}

/// Calls each(a) for all families and all stitches.
template <class Of, class Each>
PLYFORM_INLINE void for_directions(const KernelLaw& law, const Each& each) {
  for_families<Of>(law.families, each);
  for_stitches<Of>(law, each);
}

/// KernelLaw with each number copied to all SIMD lanes.
struct SimdYarns {
  Doubles stiffness, compression, viscosity, stabilisation, collapse_penalty; ///< viscosity: N/mm
};

struct SimdStitches {
  Doubles stiffness, taut_at, breaking;
};

struct SimdCrossing {
  Doubles angle, shear[most_shear_terms];
};

template <class Of>
struct SimdLaw {
  const KernelLaw& law;
  SimdYarns yarns[Of::most_families];
  SimdStitches stitches[Of::most_families]; ///< by the numbers that they have among families
  SimdCrossing crossing[Of::most_crossings];
  Doubles beta;
};

template <class Of>
PLYFORM_INLINE SimdLaw<Of> simd_law(const KernelLaw& law, double per_dt) {
  SimdLaw<Of> l{law, {}, {}, {}, all(law.beta)};
  for_families<Of>(law.families, [&](int a) {
    const KernelYarns& y = law.yarns[a];
    l.yarns[a] = {all(y.stiffness), all(y.compression), all(y.viscosity * per_dt),
                  all(y.stabilisation), all(y.collapse_penalty)};
  });
  for_stitches<Of>(law, [&](int a) {
    const KernelYarns& y = law.yarns[a];
    l.stitches[a] = {all(y.stiffness), all(y.taut_at), all(y.breaking)};
  });
  for_crossings<Of>(law, [&](int c, int, int) {
    l.crossing[c].angle = all(law.crossing[c].angle);
    for (int i = 0; i < most_shear_terms; ++i)
      l.crossing[c].shear[i] = all(law.crossing[c].shear[i]);
  });
  return l;
}

/// Kinematics of a vector of triangles: the symbols at the head of this file.
template <class Of>
struct SimdState {
  Vectors k1, k2;
  Doubles a, b, d, j;
  Doubles lambda[Of::most_families];
  Doubles area_over[Of::most_families]; ///< A0 / lambda^2 of yarns
  Doubles gamma[Of::most_crossings];
  Doubles per_j[Of::most_crossings]; ///< 1 / j
};

/// D of a crossing.
template <class Of, class Family>
PLYFORM_INLINE Doubles product(const KernelLaw& law, const SimdState<Of>& s, Family first,
                               Family second) {
  const double *v = law.yarns[first].along, *w = law.yarns[second].along;
  return (v[0] * w[0]) * s.a + (v[0] * w[1] + v[1] * w[0]) * s.d + (v[1] * w[1]) * s.b;
}

/// mm, from corner 0 to another.
PLYFORM_INLINE Vectors side(const TrianglesOfQuads& t, int corner, const double* place) {
  Double4 to[lanes];
  for (int q = 0; q < quads; ++q)
    for (int i = 0; i < simd_width; ++i)
      to[simd_width * q + i] = load(of_node(place, t.of[q]->node[corner][i])) -
                               load(of_node(place, t.of[q]->node[0][i]));
  return components(to);
}

/// AxesGradients, 1/mm.
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

template <class Of>
PLYFORM_INLINE void find_lengths(const TrianglesOfQuads& t, const KernelLaw& law,
                                 const double* place, SimdState<Of>& s) {
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
  if constexpr (Of::weave)
    s.lambda[0] = root(a), s.lambda[1] = root(b);
  else
    for_families<Of>(law.families, [&](int f) { s.lambda[f] = root(product(law, s, f, f)); });
  for_stitches<Of>(law, [&](auto f) { s.lambda[f] = root(product(law, s, f, f)); });
}

/// Stretches of the material axes.
template <class Of>
PLYFORM_INLINE Doubles axis_stretch(const SimdState<Of>& s, int axis) {
  if constexpr (Of::weave) return s.lambda[axis];
  return root(axis == 0 ? s.a : s.b);
}

/// Shear angle of the one crossing of a weave: three quotients by one division.
template <int directions>
PLYFORM_INLINE void find_shear(const TrianglesOfQuads& t,
                               const SimdLaw<StitchedWeave<directions>>& law,
                               SimdState<StitchedWeave<directions>>& s) {
  const Doubles length2 = s.lambda[0] * s.lambda[1];
  const Doubles ab = s.a * s.b, aj = s.a * s.j, bj = s.b * s.j;
  const Doubles inverse = 1.0 / (ab * s.j), area = area_of(t) * inverse;
  s.area_over[0] = area * bj, s.area_over[1] = area * aj, s.per_j[0] = inverse * ab;
  s.gamma[0] = law.crossing[0].angle + arctan(s.d, s.j, length2);
}

PLYFORM_INLINE void find_shear(const TrianglesOfQuads& t, const SimdLaw<AnyFabric>& law,
                               SimdState<AnyFabric>& s) {
  const KernelLaw& of = law.law;
  for_families<AnyFabric>(
      of.families, [&](int a) { s.area_over[a] = area_of(t) / (s.lambda[a] * s.lambda[a]); });
  for_crossings<AnyFabric>(of, [&](int c, int first, int second) {
    const Doubles length2 = s.lambda[first] * s.lambda[second];
    const Doubles j = larger(of.crossing[c].sine * s.j, least_sine * length2);
    s.gamma[c] = law.crossing[c].angle + arctan(product(of, s, first, second), j, length2);
    s.per_j[c] = 1.0 / j;
  });
}

/// Computes the shear angles. Returns the mask of triangles that have collapsed, have an active
/// collapse penalty, or are not finite.
template <class Of>
PLYFORM_INLINE Longs find_angles(const TrianglesOfQuads& t, const SimdLaw<Of>& law,
                                 SimdState<Of>& s) {
  find_shear(t, law, s);
  const Doubles length1 = axis_stretch(s, 0), length2 = axis_stretch(s, 1);
  Longs valid = (length1 > all(collapse_stretch)) & (length2 > all(collapse_stretch)) &
                (s.j > least_sine_between * (length1 * length2));
  if constexpr (!Of::weave)
    for_families<Of>(law.law.families,
                     [&](int a) { valid &= s.lambda[a] > all(collapse_stretch); });
  return ~valid;
}

/// Mask of collapsed triangles, as collapsed() of core/ply/membrane.hpp; NaN counts as collapsed.
template <class Of>
PLYFORM_INLINE Longs simd_collapsed(const SimdState<Of>& s) {
  const Doubles length1 = axis_stretch(s, 0), length2 = axis_stretch(s, 1);
  const Longs valid = (length1 > all(least_stretch)) & (length2 > all(least_stretch)) &
                      (s.j > least_sine_between * (length1 * length2));
  return ~valid;
}

/// Kinematics of `count` vectors of triangles; returns whether any triangle needs the test for
/// collapse and the collapse penalty.
template <class Of>
PLYFORM_INLINE bool find_states(const TrianglesOfQuads* t, int count, const SimdLaw<Of>& law,
                                const double* place, SimdState<Of>* s) {
  for (int i = 0; i < count; ++i)
    find_lengths(t[i], law.law, place, s[i]);
  Longs needs_penalty{};
  for (int i = 0; i < count; ++i)
    needs_penalty |= find_angles(t[i], law, s[i]);
  return any(needs_penalty);
}

} // namespace
} // namespace plyform
