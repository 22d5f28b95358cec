// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of crossings of the kernel of core/ply/membrane_simd.hpp: (C) and (D) of
// core/model/shear_law.hpp. All numbers are per area: times n_c.
#pragma once

#include "core/ply/membrane_simd_yarns.hpp"

namespace plyform {
namespace {

/// Of a crossing: n_c p and n_c T of core/ply/membrane.hpp, N/mm.
struct SimdShear {
  Doubles secant, torque;
};

/// Of C_o and C_e: C_o/g, C_e/g and W_e/g^2, N/mm.
struct SimdSides {
  Doubles odd, even, even_energy;
};

/// (D). g: rad.
PLYFORM_INLINE SimdShear of_both_signs(const KernelLaw& law, const SimdSides& sides, Doubles gamma,
                                       Doubles g) {
  const double b = law.side_cubic;
  const Doubles u = gamma / larger(g, all(least_shear)), u2 = u * u;
  const Doubles phi = u * ((1.0 + b) - b * u2), rise = (1.0 + b) - (3.0 * b) * u2;
  const Doubles turn = rise * sides.even_energy;
  const Doubles secant = sides.odd + phi * sides.even - u * turn;
  return {secant, gamma * secant + g * turn};
}

/// The last of the pieces that begins at or below g, which lies in this interval.
PLYFORM_INLINE const ShearPiece* piece_at(const KernelCrossing& law, double g, double interval) {
  const ShearPiece* at = law.piece + law.interval[static_cast<int>(interval)].first_piece;
  at += at[1].begin <= g ? 1 : 0;
  while (at[1].begin <= g) // of an interval that is wider than a piece
    ++at;
  return at;
}

/// Four successive numbers of a piece in each lane.
struct SimdRow {
  Doubles number[4];
};

PLYFORM_INLINE SimdRow row_of(const ShearPiece* const* piece, int row) {
  Double4 number[4][quads];
  for (int q = 0; q < quads; ++q) {
    const auto of = [&](int lane) { return load(&piece[simd_width * q + lane]->begin + 4 * row); };
    const Double4 a = of(0), b = of(1), c = of(2), d = of(3);
    const Double4 even_ab = __builtin_shufflevector(a, b, 0, 4, 2, 6),
                  even_cd = __builtin_shufflevector(c, d, 0, 4, 2, 6),
                  odd_ab = __builtin_shufflevector(a, b, 1, 5, 3, 7),
                  odd_cd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
    number[0][q] = __builtin_shufflevector(even_ab, even_cd, 0, 1, 4, 5);
    number[1][q] = __builtin_shufflevector(odd_ab, odd_cd, 0, 1, 4, 5);
    number[2][q] = __builtin_shufflevector(even_ab, even_cd, 2, 3, 6, 7);
    number[3][q] = __builtin_shufflevector(odd_ab, odd_cd, 2, 3, 6, 7);
  }
  return {{joined(number[0]), joined(number[1]), joined(number[2]), joined(number[3])}};
}

/// Of a table.
PLYFORM_INLINE SimdShear shear_on_pieces(const KernelLaw& law, const KernelCrossing& crossing,
                                         Doubles gamma, Doubles measure2) {
  const Doubles measure = root(measure2), g = larger(measure, all(least_shear));
  alignas(sizeof(Doubles)) double angle[lanes], interval[lanes];
  store_lanes(angle, g);
  store_lanes(interval, smaller(g * crossing.per_width, all(crossing.intervals - 1))); // of NaN too
  const ShearPiece* piece[lanes];
  for (int i = 0; i < lanes; ++i)
    piece[i] = piece_at(crossing, angle[i], interval[i]);
  const auto [begin, o0, o1, o2] = row_of(piece, 0).number;
  const auto [o3, e0, e1, e2] = row_of(piece, 1).number;
  const Doubles t = g - begin, odd = ((o3 * t + o2) * t + o1) * t + o0;
  if (!crossing.both_signs) {
    const Doubles secant = odd / g;
    return {secant, secant * gamma};
  }
  const auto [e3, w0, none, nothing] = row_of(piece, 2).number;
  const Doubles even = ((e3 * t + e2) * t + e1) * t + e0;
  const Doubles energy =
      w0 + t * (e0 + t * (e1 * (1.0 / 2.0) + t * (e2 * (1.0 / 3.0) + t * (e3 * (1.0 / 4.0)))));
  const Doubles per_g = 1.0 / g;
  return of_both_signs(law, {odd * per_g, even * per_g, energy * (per_g * per_g)}, gamma, measure);
}

/// C_e/g and W_e/g^2 of a polynomial.
PLYFORM_INLINE SimdSides even_polynomial(const KernelCrossing& law, Doubles odd, Doubles measure2) {
  Doubles even = all(0.0), energy = all(0.0);
  for (int i = law.shear_terms - 1; i >= 0; --i) {
    even = even * measure2 + law.even[i];
    energy = energy * measure2 + law.even[i] * (0.5 / (i + 1));
  }
  return {odd, even, energy};
}

/// Of g^2 = measure2.
template <class Of, bool general>
PLYFORM_INLINE SimdShear simd_shear(const SimdBlockWork<Of>& w, int crossing, Doubles gamma,
                                    Doubles measure2) {
  const KernelCrossing& law = w.law.crossing[crossing];
  const int terms = law.shear_terms;
  if (general && law.intervals > 0) return shear_on_pieces(w.law, law, gamma, measure2);
  if (!general || terms > 0) {
    const Doubles* k = w.lane.crossing[crossing].shear;
    Doubles p = k[2];
    if (terms > 3) {
      p = k[terms - 1];
      for (int i = terms - 2; i >= 2; --i)
        p = p * measure2 + k[i];
    }
    p = (p * measure2 + k[1]) * measure2 + k[0];
    if (general && law.both_signs)
      return of_both_signs(w.law, even_polynomial(law, p, measure2), gamma, root(measure2));
    return {p, p * gamma};
  }
  alignas(sizeof(Doubles)) double angle[lanes], measure[lanes], secant[lanes], torque[lanes];
  store_lanes(angle, gamma), store_lanes(measure, measure2);
  for (int q = 0; q < lanes; q += simd_width)
    w.law.shear(w.law, crossing, angle + q, measure + q, secant + q, torque + q);
  return {numbers([&](int q) { return secant + simd_width * q; }),
          numbers([&](int q) { return torque + simd_width * q; })};
}

/// What temperatures make of C_e.
PLYFORM_INLINE Doubles shear_factors_of(const KernelLaw& law, const TrianglesOfQuads& t) {
  return numbers([&](int q) { return law.shear_factors[t.of[q] - law.first].of; });
}

/// Multiplies a number of each crossing.
template <class Of>
PLYFORM_INLINE void multiply(const KernelLaw& law, Doubles factor, Doubles* of_crossings) {
  for_crossings<Of>(law, [&](auto c, auto, auto) { of_crossings[c] *= factor; });
}

/// n_c Es, N/mm, of g^2.
template <class Of, bool general>
PLYFORM_INLINE Doubles shear_energy(const SimdBlockWork<Of>& w, int crossing, Doubles gamma,
                                    Doubles measure2) {
  const KernelCrossing& law = w.law.crossing[crossing];
  const int terms = law.shear_terms;
  if (!general || (terms > 0 && !law.both_signs)) {
    Doubles energy = all(0.0);
    for (int i = terms - 1; i >= 0; --i)
      energy = (energy + w.lane.crossing[crossing].shear[i] * (0.5 / (i + 1))) * measure2;
    return energy;
  }
  alignas(sizeof(Doubles)) double angle[lanes], measure[lanes], energy[lanes];
  store_lanes(angle, gamma), store_lanes(measure, measure2);
  for (int q = 0; q < lanes; q += simd_width)
    w.law.shear_energy(w.law, crossing, angle + q, measure + q, energy + q);
  return numbers([&](int q) { return energy + simd_width * q; });
}

} // namespace
} // namespace plyform
