// SPDX-License-Identifier: GPL-3.0-or-later
// (N), (Q) and (F) of core/ply/membrane.hpp for four groups at a time, or with eight lanes those of
// two successive packs. All of (Q) is a symmetric stress S in the material axes, N mm: with the
// symbols of core/ply/membrane_simd_shape.hpp and tau = A0 n_c T / j of a crossing
//   q_i = sum_j S_ij k_j
//   S   = sum_a (A0 d_a N_a / lambda_a - sum_c tau_c D_c / lambda_a^2) v_a v_a^T
//         + sum_c tau_c (v_a v_b^T + v_b v_a^T) + A0 S_sheet                                    (S)
#include "core/ply/membrane_simd_shear.hpp"
#include "core/ply/membrane_simd_viscous.hpp"

namespace plyform {
namespace {

/// A0 S_sheet times `area`; energy, if asked for: times area, N mm.
PLYFORM_INLINE SimdStress sheet_stress(const KernelLaw& law, const SimdState<AnyFabric>& s,
                                       Doubles area, Doubles* energy) {
  alignas(sizeof(Doubles)) double a[lanes], b[lanes], d[lanes];
  store_lanes(a, s.a), store_lanes(b, s.b), store_lanes(d, s.d);
  SheetAnswers answers[quads];
  for (int q = 0; q < quads; ++q)
    law.sheet_law(law, a + simd_width * q, b + simd_width * q, d + simd_width * q, answers[q]);
  if (energy) *energy = area * numbers([&](int q) { return answers[q].energy; });
  return {area * numbers([&](int q) { return answers[q].s11; }),
          area * numbers([&](int q) { return answers[q].s22; }),
          area * numbers([&](int q) { return answers[q].s12; })};
}

/// (S) of triangles. n: d_a N_a, N/mm; torque: n_c T, N/mm.
template <class Of>
PLYFORM_INLINE SimdStress stress(const KernelLaw& law, const TrianglesOfQuads& t,
                                 const SimdState<Of>& s, const Doubles* n, const Doubles* torque) {
  Doubles pull[Of::most_families], tau[Of::most_crossings];
  for_families<Of>(law.families, [&](auto a) { pull[a] = n[a] * s.lambda[a]; });
  for_crossings<Of>(law, [&](auto c, auto first, auto second) {
    const Doubles shear = torque[c] * s.per_j[c];
    tau[c] = shear * area_of(t);
    Doubles away;
    if constexpr (Of::weave)
      away = shear * s.d;
    else
      away = shear * product(law, s, first, second);
    pull[first] -= away, pull[second] -= away;
  });
  SimdStress sum;
  const auto add = [&](const double* v, const double* w, Doubles by) {
    sum.s11 += (v[0] * w[0]) * by;
    sum.s22 += (v[1] * w[1]) * by;
    sum.s12 += (0.5 * (v[0] * w[1] + v[1] * w[0])) * by;
  };
  if constexpr (Of::weave) {
    sum = {pull[0] * s.area_over[0], pull[1] * s.area_over[1], tau[0]};
  } else {
    sum = {all(0.0), all(0.0), all(0.0)};
    if (law.sheet) sum = sheet_stress(law, s, area_of(t), nullptr);
    for_families<Of>(law.families, [&](int a) {
      add(law.yarns[a].along, law.yarns[a].along, pull[a] * s.area_over[a]);
    });
    for_crossings<Of>(law, [&](int c, int first, int second) {
      add(law.yarns[first].along, law.yarns[second].along, tau[c] + tau[c]);
    });
  }
  for_stitches<Of>(law, [&](auto a) {
    const double* v = law.yarns[a].along;
    add(v, v, area_of(t) * n[a] / s.lambda[a]);
  });
  return sum;
}

/// (S) with that of a melt.
template <class Of>
PLYFORM_INLINE SimdStress with_melt(const KernelLaw& law, SimdStress of, const SimdStress& melt) {
  if constexpr (!Of::weave)
    if (law.viscous) of.s11 += melt.s11, of.s22 += melt.s22, of.s12 += melt.s12;
  return of;
}

/// (F), N, of corners 1 and 2; corner 0 gets the opposite of their sum.
struct CornerForces {
  Vectors f1, f2;
};

/// (F) of triangles with this stress.
template <class Of>
PLYFORM_INLINE CornerForces corner_forces(const TrianglesOfQuads& t, const SimdState<Of>& s,
                                          const SimdStress& of) {
  const SimdGradients c = gradients(t);
  return {(c.c11 * of.s11 + c.c21 * of.s12) * s.k1 + (c.c11 * of.s12 + c.c21 * of.s22) * s.k2,
          (c.c12 * of.s11 + c.c22 * of.s12) * s.k1 + (c.c12 * of.s12 + c.c22 * of.s22) * s.k2};
}

/// Adds the forces of the triangles of a quad to their nodes.
PLYFORM_INLINE void add_forces(const SimdTriangles& t, const CornerForces& f, int number,
                               double* force) {
  const Rows f1 = rows(f.f1, number), f2 = rows(f.f2, number);
  for (int i = 0; i < simd_width; ++i) {
    double* at0 = of_node(force, t.node[0][i]);
    double* at1 = of_node(force, t.node[1][i]);
    double* at2 = of_node(force, t.node[2][i]);
    store(at1, load(at1) - f1.row[i]);
    store(at2, load(at2) - f2.row[i]);
    store(at0, load(at0) + (f1.row[i] + f2.row[i]));
  }
}

/// Subtracts the collapse penalty of (N) from n.
template <class Of>
PLYFORM_INLINE void add_collapse_penalty(const SimdLaw<Of>& law, const SimdState<Of>& s,
                                         Doubles* n) {
  for_families<Of>(law.law.families, [&](auto a) {
    n[a] -= law.yarns[a].collapse_penalty * larger(all(0.0), collapse_stretch - s.lambda[a]);
  });
}

template <class Of, bool general>
PLYFORM_INLINE void single_packs(SimdBlockWork<Of>& w, const TrianglesOfQuads& t,
                                 const SimdState<Of>& s, bool needs_penalty,
                                 const StatesOfQuads& v) {
  Doubles n[Of::most_families], torque[Of::most_crossings];
  tensions<Of, general>(w, v, s.lambda, area_of(t), n);
  if (needs_penalty) add_collapse_penalty(w.lane, s, n);
  for_crossings<Of>(w.law, [&](auto c, auto, auto) {
    torque[c] = simd_shear<Of, general>(w, c, s.gamma[c], s.gamma[c] * s.gamma[c]).torque;
  });
  if (general && w.law.shear_factors) multiply<Of>(w.law, shear_factors_of(w.law, t), torque);
  SimdStress melt{};
  if (general && w.law.viscous) melt = add_viscous<Of>(w, t, s, nullptr, torque, nullptr);
  const SimdStress of = with_melt<Of>(w.law, stress<Of>(w.law, t, s, n, torque), melt);
  const CornerForces forces = corner_forces(t, s, of);
  for (int q = 0; q < t.count; ++q)
    add_forces(*t.of[q], forces, q, w.force);
}

/// sum_c n_c p delta_a of (N), N/mm.
template <class Of>
PLYFORM_INLINE void find_held(const KernelLaw& law, const Doubles* secant, const Doubles* delta,
                              Doubles* held) {
  if constexpr (Of::weave) {
    held[0] = secant[0] * delta[0], held[1] = secant[0] * delta[1];
  } else {
    for_families<Of>(law.families, [&](int a) { held[a] = all(0.0); });
    for_crossings<Of>(law, [&](int c, int first, int second) {
      held[first] += secant[c] * delta[first], held[second] += secant[c] * delta[second];
    });
  }
}

template <class Of, bool general>
PLYFORM_INLINE void pair_packs(SimdBlockWork<Of>& w, const TrianglesOfQuads* t,
                               const SimdState<Of>* s, bool needs_penalty, const StatesOfQuads& v) {
  const Doubles share[2] = {share_of(t[0]), share_of(t[1])};
  Doubles mean[Of::most_families], n[Of::most_families];
  for_directions<Of>(
      w.law, [&](auto a) { mean[a] = share[0] * s[0].lambda[a] + share[1] * s[1].lambda[a]; });
  tensions<Of, general>(w, v, mean, area_of(t[0]) + area_of(t[1]), n);
  Doubles secant[2][Of::most_crossings], torque[2][Of::most_crossings];
  Doubles held[2][Of::most_families], delta[2][Of::most_families];
  SimdStress melt[2] = {};
  for (int i = 0; i < 2; ++i) {
    for_families<Of>(w.law.families, [&](auto a) { delta[i][a] = s[i].lambda[a] - mean[a]; });
    for_crossings<Of>(w.law, [&](auto c, auto first, auto second) {
      const Doubles deviation2 =
          delta[i][first] * delta[i][first] + delta[i][second] * delta[i][second];
      const Doubles gamma = s[i].gamma[c];
      const SimdShear shear =
          simd_shear<Of, general>(w, c, gamma, gamma * gamma + w.lane.beta * deviation2);
      secant[i][c] = shear.secant, torque[i][c] = shear.torque;
    });
    if (general && w.law.shear_factors) {
      const Doubles factor = shear_factors_of(w.law, t[i]);
      multiply<Of>(w.law, factor, secant[i]), multiply<Of>(w.law, factor, torque[i]);
    }
    find_held<Of>(w.law, secant[i], delta[i], held[i]);
    if (general && w.law.viscous)
      melt[i] = add_viscous<Of>(w, t[i], s[i], delta[i], torque[i], held[i]);
  }
  Doubles mean_held[Of::most_families];
  for_families<Of>(w.law.families,
                   [&](auto a) { mean_held[a] = share[0] * held[0][a] + share[1] * held[1][a]; });
  CornerForces forces[2];
  for (int i = 0; i < 2; ++i) {
    Doubles own[Of::most_families];
    for_families<Of>(w.law.families, [&](auto a) {
      own[a] = n[a] + w.lane.beta * (held[i][a] - mean_held[a]) +
               w.lane.yarns[a].stabilisation * delta[i][a];
    });
    for_stitches<Of>(w.law, [&](auto a) { own[a] = n[a]; });
    if (needs_penalty) add_collapse_penalty(w.lane, s[i], own);
    const SimdStress of =
        with_melt<Of>(w.law, stress<Of>(w.law, t[i], s[i], own, torque[i]), melt[i]);
    forces[i] = corner_forces(t[i], s[i], of);
  }
  for (int q = 0; q < t->count; ++q) // in the order of one pack after the other
    for (int i = 0; i < 2; ++i)
      add_forces(*t[i].of[q], forces[i], q, w.force);
}

/// Calls each(pack, triangles, states, size, needs_penalty) for all packs of a block, as many as
/// there are quads at a time (`pack`: the first of them), pairs (size 2) before single triangles
/// (size 1).
template <class Of, class Each>
PLYFORM_INLINE void for_packs(const KernelBlock& block, const SimdLaw<Of>& law, const double* place,
                              Each&& each) {
  TrianglesOfQuads triangles[batch];
  SimdState<Of> state[batch];
  const auto some = [&](int first, int packs, const SimdTriangles* t, auto of) {
    for (int begin = 0; begin < packs;) {
      int filled = 0, next = begin;
      for (; filled < batch && next < packs; next += quads)
        for (int i = 0; i < of; ++i)
          triangles[filled++] = of_quads(t + of * next + i, of, packs - next);
      const bool needs_penalty = find_states(triangles, filled, law, place, state);
      for (int i = 0; i < filled; i += of, begin += quads)
        each(first + begin, triangles + i, state + i, of, needs_penalty);
    }
  };
  some(0, block.pair_packs, block.triangles, Count<2>{});
  some(block.pair_packs, block.single_packs, block.triangles + 2 * block.pair_packs, Count<1>{});
}

/// The states of the packs from `pack` on.
template <class Of, class States>
PLYFORM_INLINE OfQuads<States> states_of(const KernelLaw& law, States* of_block, int pack,
                                         int count) {
  const int of_pack = directions<Of>(law);
  return of_quads(of_block + of_pack * pack, of_pack, count);
}

template <class Of, bool general>
PLYFORM_INLINE KernelReport block_forces(const KernelBlock& block, const KernelLaw& law,
                                         const double* x, double per_dt) {
  alignas(32) double place[4 * most_block_nodes];
  gather_places(block.nodes, block.node_count, x, place);
  double* force = &block.force->x;
  for (int i = 0; i < block.node_count; ++i)
    store(force + 4 * i, Double4{});
  const SimdLaw<Of> lane = simd_law<Of>(law, per_dt);
  SimdBlockWork<Of> w{law, lane, force, per_dt, Double4{}, Double4{}};
  Longs collapsed{};
  for_packs<Of>(block, lane, place,
                [&](int pack, const auto* t, const auto* s, auto of, bool needs_penalty) {
                  for (int i = 0; needs_penalty && i < of; ++i)
                    collapsed |= simd_collapsed(s[i]);
                  const StatesOfQuads states{states_of<Of>(law, block.begin, pack, t->count),
                                             states_of<Of>(law, block.end, pack, t->count)};
                  if constexpr (of == 2)
                    pair_packs<Of, general>(w, t, s, needs_penalty, states);
                  else
                    single_packs<Of, general>(w, *t, *s, needs_penalty, states);
                });
  return {0.5 * sum(w.lost), 0.5 * sum(w.torn), sum(w.flowed), any(collapsed)};
}

/// (E) of the triangles of some packs without the yarns, N mm.
template <class Of, bool general, class Size>
PLYFORM_INLINE void triangle_energies(const SimdBlockWork<Of>& w, const TrianglesOfQuads* t,
                                      const SimdState<Of>* s, Size size, const Doubles* mean,
                                      Doubles* of_sides, Doubles* of_shear) {
  for (int i = 0; i < size; ++i) {
    Doubles delta[Of::most_families], sides = all(0.0), shear = all(0.0);
    for_families<Of>(w.law.families, [&](auto a) {
      delta[a] = s[i].lambda[a] - mean[a];
      sides += side_energy(w.lane.yarns[a], s[i].lambda[a], delta[a]);
    });
    for_crossings<Of>(w.law, [&](auto c, auto first, auto second) {
      const Doubles deviation2 = delta[first] * delta[first] + delta[second] * delta[second];
      const Doubles gamma = s[i].gamma[c];
      shear += shear_energy<Of, general>(w, c, gamma, gamma * gamma + w.lane.beta * deviation2);
    });
    if (general && w.law.shear_factors) shear *= shear_factors_of(w.law, t[i]);
    const Doubles own = area_of(t[i]);
    of_sides[i] = own * sides, of_shear[i] = own * shear;
    if constexpr (!Of::weave)
      if (w.law.sheet) {
        Doubles of_sheet;
        sheet_stress(w.law, s[i], own, &of_sheet);
        of_shear[i] += of_sheet;
      }
  }
}

template <class Of, bool general>
PLYFORM_INLINE KernelEnergy block_energy(const KernelBlock& block, const KernelLaw& law,
                                         const double* x, double per_dt) {
  alignas(32) double place[4 * most_block_nodes];
  gather_places(block.nodes, block.node_count, x, place);
  const SimdLaw<Of> lane = simd_law<Of>(law, 0.0);
  const SimdBlockWork<Of> w{law, lane, nullptr, per_dt, Double4{}, Double4{}};
  Double4 fibre{}, shear{}, stitch{};
  for_packs<Of>(block, lane, place, [&](int pack, const auto* t, const auto* s, auto of, bool) {
    const auto begin = states_of<Of>(law, block.begin, pack, t->count);
    Doubles area = all(0.0), mean[Of::most_families], stitches = all(0.0);
    for_directions<Of>(law, [&](auto a) { mean[a] = all(0.0); });
    for (int i = 0; i < of; ++i) {
      const Doubles share = share_of(t[i]);
      area += area_of(t[i]);
      for_directions<Of>(law, [&](auto a) { mean[a] += share * s[i].lambda[a]; });
    }
    for_stitches<Of>(law,
                     [&](auto a) { stitches += stitch_energy<Of, general>(w, a, mean[a], begin); });
    const Doubles of_yarns = area * yarn_energies<Of, general>(w, mean, begin),
                  of_stitches = area * stitches;
    Doubles of_sides[of], of_shear[of];
    triangle_energies<Of, general>(w, t, s, of, mean, of_sides, of_shear);
    for (int q = 0; q < t->count; ++q) {
      fibre += quad(of_yarns, q), stitch += quad(of_stitches, q);
      for (int i = 0; i < of; ++i)
        fibre += quad(of_sides[i], q), shear += quad(of_shear[i], q);
    }
  });
  return {sum(fibre), sum(shear), sum(stitch)};
}

/// Whether a weave has laws that are more than straight lines and short polynomials.
PLYFORM_INLINE bool is_general(const KernelLaw& law) {
  bool general = law.crimped || law.viscous || law.shear_factors ||
                 law.crossing[0].shear_terms == 0 || law.crossing[0].both_signs;
  for (int a = 0; a < 2 + law.stitches; ++a)
    general = general || law.yarns[a].by_law || law.yarns[a].buckles;
  return general;
}

/// Calls compute(Of, general) for what the fabric is.
template <class Compute>
PLYFORM_INLINE auto for_fabric(const KernelLaw& law, const Compute& compute) {
  if (!law.weave || law.stitches > 2) return compute(AnyFabric{}, Count<1>{});
  const auto of_laws = [&](auto of) {
    return is_general(law) ? compute(of, Count<1>{}) : compute(of, Count<0>{});
  };
  if (law.stitches == 0) return of_laws(Weave{});
  if (law.stitches == 1) return of_laws(StitchedWeave<1>{});
  return of_laws(StitchedWeave<2>{});
}

PLYFORM_INLINE KernelReport membrane_kernel(const KernelBlock& block, const KernelLaw& law,
                                            const double* x, double per_dt) {
  return for_fabric(law, [&](auto of, auto general) {
    return block_forces<decltype(of), general != 0>(block, law, x, per_dt);
  });
}

PLYFORM_INLINE KernelEnergy membrane_energy_kernel(const KernelBlock& block, const KernelLaw& law,
                                                   const double* x, double per_dt) {
  return for_fabric(law, [&](auto of, auto general) {
    return block_energy<decltype(of), general != 0>(block, law, x, per_dt);
  });
}

} // namespace

KernelReport PLYFORM_COPY_OF(membrane_kernel)(const KernelBlock& block, const KernelLaw& law,
                                              const double* x, double per_dt) {
  return membrane_kernel(block, law, x, per_dt);
}

KernelEnergy PLYFORM_COPY_OF(membrane_energy)(const KernelBlock& block, const KernelLaw& law,
                                              const double* x, double per_dt) {
  return membrane_energy_kernel(block, law, x, per_dt);
}

} // namespace plyform
