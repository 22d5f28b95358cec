// SPDX-License-Identifier: GPL-3.0-or-later
// Springs, dashpots and branches of core/model/viscous_shear.hpp, one per SIMD lane, for kernels.
#pragma once

#include "core/ply/simd_kernel_body.hpp"
#include "core/ply/viscous_kernel.hpp"

namespace plyform {
namespace {

/// The first of the states of what is computed together.
struct ViscousStatesOfQuads {
  OfQuads<const SimdNumbers> begin;
  OfQuads<SimdNumbers> end;
};

PLYFORM_INLINE Doubles state_before(const ViscousStatesOfQuads& s, int number) {
  return numbers([&](int q) { return s.begin.of[q][number].of; });
}
PLYFORM_INLINE void set_state(const ViscousStatesOfQuads& s, int number, Doubles value) {
  for (int q = 0; q < s.end.count; ++q)
    store(s.end.of[q][number].of, quad(value, q));
}

/// Moves a torque to q1 and adds what is lost: work less what its spring stores more.
PLYFORM_INLINE Doubles moved_to(const ViscousStatesOfQuads& s, int number, Doubles q0, Doubles q1,
                                Doubles change, double per_modulus, Doubles& lost) {
  lost += 0.5 * (q0 + q1) * (change - (q1 - q0) * per_modulus);
  set_state(s, number, q1);
  return q1;
}

/// q_1 of (B) of core/model/viscous_shear.hpp for D = c v, of a dashpot behind a spring.
PLYFORM_INLINE Doubles move_dashpot(const ViscousStatesOfQuads& s, int number, Doubles viscosity,
                                    const KernelSpring& spring, Doubles change, Doubles& lost) {
  constexpr double least = 1e-300; // where there is neither a viscosity nor a step
  const Doubles q0 = state_before(s, number);
  const Doubles share = viscosity / larger(viscosity + spring.by_dt, all(least));
  return moved_to(s, number, q0, share * (q0 + spring.stiffness * change), change,
                  spring.per_stiffness, lost);
}

/// (X)
struct SimdBranch {
  Doubles keep, rise;
};

PLYFORM_INLINE Doubles move_branch(const ViscousStatesOfQuads& s, int number,
                                   const KernelBranch& law, const SimdBranch& step, Doubles change,
                                   Doubles& lost) {
  const Doubles q0 = state_before(s, number);
  return moved_to(s, number, q0, step.keep * q0 + step.rise * change, change, law.per_modulus,
                  lost);
}

/// e^-s and (1 - e^-s)/s for s >= 0, to 1e-15. With s = n ln 2 + r and |r| <= ln 2 / 2, the series
/// of (1 - e^-r)/r keeps all digits of small s.
PLYFORM_INLINE SimdBranch decay(Doubles age) {
  constexpr double per_ln2 = 1.4426950408889634074, ln2_high = 6.93147180369123816490e-01,
                   ln2_low = 1.90821492927058770002e-10;
  constexpr double whole = 6755399441055744.0; // 1.5 * 2^52: added, it rounds to whole numbers
  constexpr double of[] = {1.0,
                           -1.0 / 2,
                           1.0 / 6,
                           -1.0 / 24,
                           1.0 / 120,
                           -1.0 / 720,
                           1.0 / 5040,
                           -1.0 / 40320,
                           1.0 / 362880,
                           -1.0 / 3628800,
                           1.0 / 39916800.0,
                           -1.0 / 479001600.0,
                           1.0 / 6227020800.0};
  const Doubles s = smaller(age, all(700.0)), t = s * per_ln2 + whole, n = t - whole;
  const Longs power = reinterpret_cast<Longs>(t) - reinterpret_cast<Longs>(all(whole));
  const Doubles r = (s - n * ln2_high) - n * ln2_low;
  Doubles p = all(of[12]);
  for (int i = 11; i >= 0; --i)
    p = p * r + of[i];
  const Doubles keep = (1.0 - r * p) * reinterpret_cast<Doubles>((1023 - power) << 52);
  const Longs small = n == 0.0;
  return {keep, small ? p : (1.0 - keep) / larger(s, all(0.25))};
}

/// (X) of a branch whose time is `factor` times that of its law, if factors are given.
PLYFORM_INLINE SimdBranch branch_step(const KernelBranch& law, bool factors, Doubles factor) {
  if (!factors) return {all(law.keep), all(law.rise)};
  const SimdBranch d = decay(law.age / factor);
  return {d.keep, law.modulus * d.rise};
}

/// Smooths a rate of change, and keeps the largest, in states `number` and the next.
PLYFORM_INLINE void smooth_rate(const ViscousStatesOfQuads& s, int number, Doubles change,
                                double per_dt, double smoothing) {
  const Doubles before = state_before(s, number),
                rate = before + smoothing * (change * per_dt - before);
  set_state(s, number, rate);
  set_state(s, number + 1, larger(state_before(s, number + 1), magnitude(rate)));
}

} // namespace
} // namespace plyform
