// SPDX-License-Identifier: GPL-3.0-or-later
// Laws with rates of the kernel of core/ply/membrane_simd.hpp: core/ply/viscous_membrane.hpp, whose
// symbols these are.
#pragma once

#include "core/ply/membrane_simd_yarns.hpp"
#include "core/ply/viscous_lanes.hpp"

namespace plyform {
namespace {

/// (S) of core/ply/membrane_simd_kernel.cpp, N mm.
struct SimdStress {
  Doubles s11, s22, s12;
};

PLYFORM_INLINE ViscousStatesOfQuads viscous_states(const KernelViscous& v,
                                                   const TrianglesOfQuads& t) {
  ViscousStatesOfQuads s;
  s.begin.count = s.end.count = t.count;
  for (int q = 0; q < quads; ++q) {
    const auto at = v.states * (t.of[q] - v.first);
    s.begin.of[q] = v.begin + at, s.end.of[q] = v.end + at;
  }
  return s;
}

/// Factors of viscosities and of times.
PLYFORM_INLINE Doubles factors_of(const KernelViscous& v, const TrianglesOfQuads& t) {
  if (!v.factors) return all(1.0);
  return numbers([&](int q) { return v.factors[t.of[q] - v.first].of; });
}

/// c, N mm s. driven: the right side of (B), N mm.
PLYFORM_INLINE Doubles viscosity_of(const KernelViscous& v, int index, Doubles angle,
                                    Doubles driven, Doubles factor) {
  const KernelViscousCrossing& law = v.crossing[index];
  if (law.terms > 0) {
    const Doubles g2 = angle * angle;
    Doubles c = all(law.viscosity[law.terms - 1]);
    for (int i = law.terms - 2; i >= 0; --i)
      c = c * g2 + law.viscosity[i];
    return factor * c;
  }
  alignas(sizeof(Doubles)) double g[lanes], of[lanes], by[lanes], c[lanes];
  store_lanes(g, angle), store_lanes(of, driven), store_lanes(by, factor);
  for (int q = 0; q < lanes; q += simd_width)
    v.viscosity(v, index, g + q, of + q, by + q, c + q);
  return numbers([&](int q) { return c + simd_width * q; });
}

/// Takes a crossing over a step; X: its `count` numbers at the end. torque: Q of each, N mm.
/// Returns what is lost, N mm a cell.
PLYFORM_INLINE Doubles step_crossing(const KernelViscous& v, int index,
                                     const ViscousStatesOfQuads& s, Doubles factor,
                                     const Doubles* X, int count, Doubles* torque) {
  const KernelViscousCrossing& law = v.crossing[index];
  const int x = law.first_state, q = x + 3, rates = q + 3 * (1 + law.branches);
  Doubles change[3], lost = all(0.0);
  for (int i = 0; i < count; ++i) {
    change[i] = v.moves * (X[i] - state_before(s, x + i));
    set_state(s, x + i, X[i]);
    torque[i] = all(0.0);
  }
  if (law.dashpot) {
    const Doubles driven = state_before(s, q) + law.shear.stiffness * change[0];
    const Doubles c = viscosity_of(v, index, X[0], driven, factor);
    for (int i = 0; i < count; ++i)
      torque[i] = move_dashpot(s, q + i, c, i == 0 ? law.shear : law.deviation, change[i], lost);
  }
  for (int k = 0; k < law.branches; ++k) {
    const SimdBranch step = branch_step(law.branch[k], v.factors != nullptr, factor);
    for (int i = 0; i < count; ++i)
      torque[i] += move_branch(s, q + 3 * (k + 1) + i, law.branch[k], step, change[i], lost);
  }
  smooth_rate(s, rates, change[0], v.per_dt, law.smoothing);
  return lost;
}

/// Takes a melt over a step: (F). Adds to (S), and what is lost, N/mm.
PLYFORM_INLINE void step_melt(const KernelViscous& v, const SimdState<AnyFabric>& s,
                              const ViscousStatesOfQuads& states, Doubles factor, Doubles area,
                              SimdStress& sum, Doubles& lost) {
  const KernelMelt& law = v.melt;
  const double e = law.across[0], g = law.across[1]; // k across e_1 is e k_1 + g k_2
  const Doubles c11 = s.a, c12 = e * s.a + g * s.d,
                c22 = (e * e) * s.a + (2.0 * e * g) * s.d + (g * g) * s.b;
  const Doubles now[] = {c11 - 1.0, c22 - 1.0, c12};
  Doubles d[3];
  for (int i = 0; i < 3; ++i) {
    d[i] = v.moves * (now[i] - state_before(states, law.first_state + i));
    set_state(states, law.first_state + i, now[i]);
  }
  // with lambda v = |k_1 x k| and t = u / lambda
  const Doubles per_c11 = 1.0 / c11, t = c12 * per_c11;
  const Doubles v2 = larger(all(least_stretch * least_stretch), c22 - t * c12), per_v2 = 1.0 / v2,
                per_lv = 1.0 / root(c11 * v2);
  const Doubles change[] = {(d[2] - t * d[0]) * per_lv,
                            (0.5 * d[1] - t * d[2] + 0.5 * t * t * d[0]) * per_v2};
  Doubles n[2];
  for (int i = 0; i < 2; ++i)
    n[i] = move_dashpot(states, law.first_state + 3 + i, factor * law.viscosity[i], law.spring,
                        change[i], lost);
  smooth_rate(states, law.first_state + 5, change[0], v.per_dt, law.smoothing);
  const Doubles sheared = n[0] * per_lv, apart = n[1] * per_v2;
  const Doubles s11 = t * (t * apart - (sheared + sheared)), s12 = sheared - t * apart;
  sum.s11 += area * (s11 + (2.0 * e) * s12 + (e * e) * apart);
  sum.s12 += (area * g) * (s12 + e * apart);
  sum.s22 += (area * (g * g)) * apart;
}

/// Takes triangles over a step. deviation: delta_a, or null of triangles alone. Adds n_c Q (N/mm)
/// to the torques of crossings, and (H) over beta to what is held; returns the stress of a melt.
template <class Of>
PLYFORM_INLINE SimdStress add_viscous(const SimdBlockWork<Of>& w, const TrianglesOfQuads& t,
                                      const SimdState<Of>& s, const Doubles* deviation,
                                      Doubles* torque, Doubles* held) {
  const KernelViscous& v = *w.law.viscous;
  const ViscousStatesOfQuads states = viscous_states(v, t);
  const Doubles factor = factors_of(v, t), area = area_of(t);
  const Doubles root_beta = root(w.lane.beta), per_root_beta = 1.0 / root_beta;
  SimdStress melt{all(0.0), all(0.0), all(0.0)};
  Doubles lost = all(0.0);
  const auto step = [&](int index, auto crossing, auto first, auto second) {
    const double cells = v.crossing[index].cells;
    Doubles X[3] = {s.gamma[crossing], all(0.0), all(0.0)}, q[3];
    if (deviation) X[1] = root_beta * deviation[first], X[2] = root_beta * deviation[second];
    lost += cells * step_crossing(v, index, states, factor, X, deviation ? 3 : 1, q);
    torque[crossing] += cells * q[0];
    if (!deviation) return;
    held[first] += cells * per_root_beta * q[1];
    held[second] += cells * per_root_beta * q[2];
  };
  if constexpr (Of::weave) {
    step(0, Count<0>{}, Count<0>{}, Count<1>{});
  } else {
    for (int k = 0; k < v.crossings; ++k) {
      const int c = v.crossing[k].crossing;
      step(k, c, w.law.crossing[c].first, w.law.crossing[c].second);
    }
    if (v.has_melt) step_melt(v, s, states, factor, area, melt, lost);
  }
  set_state(states, 0, state_before(states, 0) + area * lost);
  return melt;
}

} // namespace
} // namespace plyform
