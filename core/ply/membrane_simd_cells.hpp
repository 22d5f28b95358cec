// SPDX-License-Identifier: GPL-3.0-or-later
// Crimped cells of core/model/crimp.hpp with linear yarns, one cell per lane. As answer_of there:
// (C2) by Newton's method within a bracket; a lane that has come to its end stays there, whatever
// the others do, so that its bits are those of any number of lanes. Of a yarn:
//   e = max(0, L - L_0),  T = k e / L_0,  f = T h / L,  df/dh = k/L_0 (e / L + h^2 L_0 / L^3)
#pragma once

#include "base/simd.hpp"
#include "core/ply/membrane_simd_kernel.hpp"

namespace plyform {
namespace {

/// The yarn of a cell at a height.
struct SimdHalfWave {
  Doubles longer, per_length; ///< e, mm; 1 / L, 1/mm
};

/// Both yarns at height h_1; one division for both.
PLYFORM_INLINE void find_half_waves(const KernelCell& cell, const Doubles* span2, Doubles height,
                                    SimdHalfWave* yarn) {
  const Doubles other = cell.heights - height;
  const Doubles first = root(span2[0] + height * height), second = root(span2[1] + other * other);
  const Doubles inverse = 1.0 / (first * second);
  yarn[0] = {larger(all(0.0), first - cell.length[0]), inverse * second};
  yarn[1] = {larger(all(0.0), second - cell.length[1]), inverse * first};
}

/// f and df/dh, over k / L_0.
struct SimdLift {
  Doubles force, slope;
};

PLYFORM_INLINE SimdLift lift(const SimdHalfWave& yarn, double length, Doubles height) {
  const Doubles share = yarn.longer * yarn.per_length, sine = height * yarn.per_length;
  const Doubles taut = yarn.longer > 0.0 ? all(length) : all(0.0);
  return {share * height, share + sine * sine * taut * yarn.per_length};
}

/// mm, up to which height a yarn is slack.
PLYFORM_INLINE Doubles slack_height(Doubles span, double length) {
  return root(larger(all(0.0), (length - span) * (length + span)));
}

/// h_1 of (C2) for small inclinations, to start from: e = span - L_0 + h^2 / (2 L_0).
PLYFORM_INLINE Doubles guessed_height(const KernelCell& cell, const Doubles* span, Doubles low,
                                      Doubles high) {
  const double* length = cell.length;
  const double k[2] = {cell.stiffness[0] / length[0], cell.stiffness[1] / length[1]};
  const double half[2] = {0.5 / length[0], 0.5 / length[1]};
  const Doubles more[2] = {span[0] - length[0], span[1] - length[1]};
  Doubles h = smaller(high, larger(low, all(0.5 * cell.heights)));
  for (int i = 0; i < 3; ++i) {
    const Doubles other = cell.heights - h;
    const Doubles s1 = half[0] * h * h, s2 = half[1] * other * other;
    const Doubles e1 = larger(all(0.0), more[0] + s1), e2 = larger(all(0.0), more[1] + s2);
    const Doubles slope = k[0] * (e1 + (s1 + s1)) + k[1] * (e2 + (s2 + s2));
    h -= (k[0] * e1 * h - k[1] * e2 * other) / slope;
    h = smaller(larger(h, low), high); // low where it is no number
  }
  return h;
}

/// h_1 of (C2).
PLYFORM_INLINE Doubles balanced_height(const KernelCell& cell, const Doubles* span) {
  constexpr int most = 100;      // halving alone ends after 60
  constexpr double small = 1e-8; // of the heights: such a step leaves its square, which is rounding
  const Doubles heights = all(cell.heights);
  const double *length = cell.length, *k = cell.stiffness;
  Doubles low = smaller(slack_height(span[0], length[0]), heights);
  Doubles high = larger(low, heights - smaller(slack_height(span[1], length[1]), heights));
  Doubles h = guessed_height(cell, span, low, high);
  const Doubles span2[2] = {span[0] * span[0], span[1] * span[1]};
  Longs open = low < high;
  for (int i = 0; i < most && any(open); ++i) {
    const Doubles other = heights - h;
    SimdHalfWave yarn[2];
    find_half_waves(cell, span2, h, yarn);
    const SimdLift a = lift(yarn[0], length[0], h), b = lift(yarn[1], length[1], other);
    const Doubles force = k[0] * a.force - k[1] * b.force, slope = k[0] * a.slope + k[1] * b.slope;
    const Longs steep = slope > 0.0;
    const Doubles step = steep ? -force / (steep ? slope : all(1.0)) : heights;
    const Doubles newton = h + step;
    const Longs arrived = magnitude(step) <= small * heights;
    const Doubles end = smaller(high, larger(low, newton));
    const Longs above = open & ~arrived & (force > 0.0), below = open & ~arrived & ~(force > 0.0);
    high = above ? h : high;
    low = below ? h : low;
    const Doubles next = ((newton > low) & (newton < high)) ? newton : 0.5 * (low + high);
    h = open ? (arrived ? end : next) : h;
    open &= ~arrived;
  }
  return h;
}

/// d_a N_a of both families and n w, N/mm.
struct SimdCell {
  Doubles pull[2], energy;
};

/// Of the mean stretches of both families.
PLYFORM_INLINE SimdCell cell_answer(const KernelCell& cell, Doubles stretch1, Doubles stretch2) {
  const Doubles span[2] = {cell.half_wave[0] * stretch1, cell.half_wave[1] * stretch2};
  const Doubles h = balanced_height(cell, span);
  const Doubles span2[2] = {span[0] * span[0], span[1] * span[1]};
  SimdHalfWave yarn[2];
  find_half_waves(cell, span2, h, yarn);
  SimdCell answer{{}, all(0.0)};
  for (int a = 0; a < 2; ++a) {
    answer.pull[a] =
        cell.half_wave[a] * (cell.stiffness[a] * yarn[a].longer * span[a] * yarn[a].per_length);
    answer.energy += 0.5 * cell.stiffness[a] * yarn[a].longer * yarn[a].longer;
  }
  return answer;
}

} // namespace
} // namespace plyform
