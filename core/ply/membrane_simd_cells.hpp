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

PLYFORM_INLINE SimdHalfWave half_wave(Doubles span2, double length, Doubles height) {
  const Doubles now = root(span2 + height * height);
  return {larger(all(0.0), now - length), 1.0 / now};
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

/// h_1 of (C2).
PLYFORM_INLINE Doubles balanced_height(const KernelCell& cell, const Doubles* span) {
  constexpr int most = 100;       // halving alone ends after 60
  constexpr double small = 1e-12; // of the heights: the step after leaves its square
  const Doubles heights = all(cell.heights);
  const double *length = cell.length, *k = cell.stiffness;
  Doubles low = smaller(slack_height(span[0], length[0]), heights);
  Doubles high = larger(low, heights - smaller(slack_height(span[1], length[1]), heights));
  Doubles h = smaller(high, larger(low, 0.5 * heights));
  const Doubles span2[2] = {span[0] * span[0], span[1] * span[1]};
  Longs open = low < high;
  for (int i = 0; i < most && any(open); ++i) {
    const Doubles other = heights - h;
    const SimdLift a = lift(half_wave(span2[0], length[0], h), length[0], h),
                   b = lift(half_wave(span2[1], length[1], other), length[1], other);
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
  SimdCell answer{{}, all(0.0)};
  for (int a = 0; a < 2; ++a) {
    const SimdHalfWave yarn =
        half_wave(span[a] * span[a], cell.length[a], a == 0 ? h : cell.heights - h);
    answer.pull[a] =
        cell.half_wave[a] * (cell.stiffness[a] * yarn.longer * span[a] * yarn.per_length);
    answer.energy += 0.5 * cell.stiffness[a] * yarn.longer * yarn.longer;
  }
  return answer;
}

} // namespace
} // namespace plyform
