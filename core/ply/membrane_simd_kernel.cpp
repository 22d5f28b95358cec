// SPDX-License-Identifier: GPL-3.0-or-later
// (N), (Q) and (F) of core/ply/membrane.hpp for four groups at a time, or with eight lanes those of
// two successive packs. With the symbols of core/ply/membrane_simd_shape.hpp and
//   tau = A0 n_c p gamma / J
// (Q) can be written without unit vectors:
//   q_1 = (A0 d_1 N_1 / lambda_1 - tau d / a) k_1 + tau k_2, and so with 1 and 2 exchanged     (Q')
#include "core/ply/membrane_simd_shape.hpp"

namespace plyform {
namespace {

/// Number of vectors of triangles that pass through each stage of the computation together, so that
/// the processor overlaps the latency of their square roots. Even, so that pairs are not separated.
constexpr int batch = 8;

/// Data that all packs of a block share.
struct SimdBlockWork {
  const KernelLaw& law;
  const SimdLaw& lane;
  double* force;
  double per_dt; ///< 1/s, as of membrane_kernel
  Double4 lost;  ///< twice the work lost
};

/// Compressive strain beyond the buckling strain; 0 for yarns that have not buckled.
PLYFORM_INLINE Doubles buckled_by(const KernelYarns& yarns, Doubles strain) {
  return larger(all(0.0), -yarns.buckling_strain - strain);
}

/// d_a W_a', N/mm, of a law that the kernel knows. `general`: it does not know all laws of the
/// fabric, or its yarns can buckle.
template <bool general>
PLYFORM_INLINE Doubles yarn_tension(const SimdBlockWork& w, int family, Doubles strain) {
  const SimdYarns& yarns = w.lane.yarns[family];
  const KernelYarns& law = w.law.yarns[family];
  const Doubles n = strain * (strain > 0.0 ? yarns.stiffness : yarns.compression);
  return general && law.buckles ? n + law.buckling_drop * buckled_by(law, strain) : n;
}

/// n_c p, N/mm, for g^2.
template <bool general>
PLYFORM_INLINE Doubles simd_secant(const SimdBlockWork& w, Doubles measure2) {
  const int terms = w.law.shear_terms;
  if (!general || terms > 0) {
    const Doubles* k = w.lane.shear;
    Doubles p = k[2];
    if (terms > 3) {
      p = k[terms - 1];
      for (int i = terms - 2; i >= 2; --i)
        p = p * measure2 + k[i];
    }
    return (p * measure2 + k[1]) * measure2 + k[0];
  }
  return by_quads(measure2, [&](const double* at, double* p) { w.law.secant(w.law, at, p); });
}

/// What the yarns of some packs remember at the begin of the step and at its end.
struct StatesOfQuads {
  OfQuads<const SimdYarnStates> begin;
  OfQuads<SimdYarnStates> end;
};

/// Row `row` of what a family remembers at the begin of the step.
PLYFORM_INLINE Doubles remembered(const StatesOfQuads& states, int family, int row) {
  return numbers([&](int q) { return states.begin.of[q]->of[family][row]; });
}

/// Tensions of yarns of linear laws, with viscosity while taut. n1, n2: d_a N, N/mm. Adds twice the
/// work lost (N mm) to w.lost.
template <bool general>
PLYFORM_INLINE void viscous_tensions(SimdBlockWork& w, const StatesOfQuads& v, Doubles mean1,
                                     Doubles mean2, Doubles area, Doubles& n1, Doubles& n2) {
  n1 = yarn_tension<general>(w, 0, mean1 - 1.0);
  n2 = yarn_tension<general>(w, 1, mean2 - 1.0);
  const Doubles change1 = mean1 - remembered(v, 0, 0), change2 = mean2 - remembered(v, 1, 0);
  const Doubles now1 = n1 > 0.0 ? w.lane.yarns[0].viscosity * change1 : all(0.0);
  const Doubles now2 = n2 > 0.0 ? w.lane.yarns[1].viscosity * change2 : all(0.0);
  const Doubles lost =
      area * ((now1 + remembered(v, 0, 1)) * change1 + (now2 + remembered(v, 1, 1)) * change2);
  for (int q = 0; q < v.end.count; ++q) {
    SimdYarnStates& end = *v.end.of[q];
    w.lost += quad(lost, q);
    store(end.of[0][0], quad(mean1, q)), store(end.of[1][0], quad(mean2, q));
    store(end.of[0][1], quad(now1, q)), store(end.of[1][1], quad(now2, q));
  }
  n1 += now1, n2 += now2;
}

/// Answers of a family's law for some packs, whatever it is; `values`: which of them is returned.
/// end: where it writes what it remembers.
template <class End>
PLYFORM_INLINE Doubles by_law(const SimdBlockWork& w, int family, Doubles strain,
                              const OfQuads<const SimdYarnStates>& begin, const End& end,
                              double (KernelAnswers::*values)[simd_width], Doubles* lost) {
  alignas(sizeof(Doubles)) double strains[lanes], value[lanes] = {}, losses[lanes] = {};
  store_lanes(strains, strain);
  for (int q = 0; q < begin.count; ++q) {
    KernelAnswers answers;
    w.law.evaluate(w.law, family, w.per_dt, strains + simd_width * q, begin.of[q]->of[family],
                   end(q), answers);
    for (int i = 0; i < simd_width; ++i) {
      value[simd_width * q + i] = (answers.*values)[i];
      losses[simd_width * q + i] = answers.lost[i];
    }
  }
  if (lost) *lost = numbers([&](int q) { return losses + simd_width * q; });
  return numbers([&](int q) { return value + simd_width * q; });
}

/// The tension of a family by its law, d_a N, N/mm, and what it loses.
PLYFORM_INLINE Doubles tension_by_law(SimdBlockWork& w, int family, const StatesOfQuads& v,
                                      Doubles mean, Doubles area) {
  Doubles lost;
  const Doubles n = by_law(
      w, family, mean - 1.0, v.begin, [&](int q) { return v.end.of[q]->of[family]; },
      &KernelAnswers::value, &lost);
  for (int q = 0; q < v.end.count; ++q)
    w.lost += 2.0 * quad(area * lost, q);
  return n;
}

/// Tensions of both families at their mean stretches, d_a N, N/mm, without what holds single
/// triangles.
template <bool general>
PLYFORM_INLINE void tensions(SimdBlockWork& w, const StatesOfQuads& v, Doubles mean1, Doubles mean2,
                             Doubles area, Doubles& n1, Doubles& n2) {
  if (!general || !w.law.by_law) return viscous_tensions<general>(w, v, mean1, mean2, area, n1, n2);
  n1 = tension_by_law(w, 0, v, mean1, area);
  n2 = tension_by_law(w, 1, v, mean2, area);
}

/// (F), N, of corners 1 and 2; corner 0 gets the opposite of their sum.
struct CornerForces {
  Vectors f1, f2;
};

/// (Q') and (F) of triangles. n1, n2: d_a N_a, N/mm; secant: n_c p, N/mm.
PLYFORM_INLINE CornerForces corner_forces(const TrianglesOfQuads& t, const SimdState& s, Doubles n1,
                                          Doubles n2, Doubles secant) {
  const Doubles shear = secant * s.gamma * s.per_j, tau = shear * area_of(t);
  const Doubles away = shear * s.d;
  const Doubles s1 = (n1 * s.lambda1 - away) * s.area_a;
  const Doubles s2 = (n2 * s.lambda2 - away) * s.area_b;
  const SimdGradients c = gradients(t);
  return {(c.c11 * s1 + c.c21 * tau) * s.k1 + (c.c11 * tau + c.c21 * s2) * s.k2,
          (c.c12 * s1 + c.c22 * tau) * s.k1 + (c.c12 * tau + c.c22 * s2) * s.k2};
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

/// Subtracts the collapse penalty of (N) from n1 and n2.
PLYFORM_INLINE void add_collapse_penalty(const SimdLaw& law, const SimdState& s, Doubles& n1,
                                         Doubles& n2) {
  n1 -= law.yarns[0].collapse_penalty * larger(all(0.0), collapse_stretch - s.lambda1);
  n2 -= law.yarns[1].collapse_penalty * larger(all(0.0), collapse_stretch - s.lambda2);
}

template <bool general>
PLYFORM_INLINE void single_packs(SimdBlockWork& w, const TrianglesOfQuads& t, const SimdState& s,
                                 bool needs_penalty, const StatesOfQuads& v) {
  Doubles n1, n2;
  tensions<general>(w, v, s.lambda1, s.lambda2, area_of(t), n1, n2);
  if (needs_penalty) add_collapse_penalty(w.lane, s, n1, n2);
  const CornerForces forces =
      corner_forces(t, s, n1, n2, simd_secant<general>(w, s.gamma * s.gamma));
  for (int q = 0; q < t.count; ++q)
    add_forces(*t.of[q], forces, q, w.force);
}

template <bool general>
PLYFORM_INLINE void pair_packs(SimdBlockWork& w, const TrianglesOfQuads* t, const SimdState* s,
                               bool needs_penalty, const StatesOfQuads& v) {
  const Doubles share[2] = {share_of(t[0]), share_of(t[1])};
  const Doubles mean1 = share[0] * s[0].lambda1 + share[1] * s[1].lambda1;
  const Doubles mean2 = share[0] * s[0].lambda2 + share[1] * s[1].lambda2;
  Doubles n1, n2;
  tensions<general>(w, v, mean1, mean2, area_of(t[0]) + area_of(t[1]), n1, n2);
  Doubles secant[2], held1[2], held2[2]; // n_c p delta_a
  Doubles delta1[2], delta2[2];
  for (int i = 0; i < 2; ++i) {
    delta1[i] = s[i].lambda1 - mean1, delta2[i] = s[i].lambda2 - mean2;
    const Doubles deviation2 = delta1[i] * delta1[i] + delta2[i] * delta2[i];
    secant[i] = simd_secant<general>(w, s[i].gamma * s[i].gamma + w.lane.beta * deviation2);
    held1[i] = secant[i] * delta1[i], held2[i] = secant[i] * delta2[i];
  }
  const Doubles mean_held1 = share[0] * held1[0] + share[1] * held1[1];
  const Doubles mean_held2 = share[0] * held2[0] + share[1] * held2[1];
  CornerForces forces[2];
  for (int i = 0; i < 2; ++i) {
    const SimdYarns &warp = w.lane.yarns[0], &weft = w.lane.yarns[1];
    Doubles own1 = n1 + w.lane.beta * (held1[i] - mean_held1) + warp.stabilisation * delta1[i];
    Doubles own2 = n2 + w.lane.beta * (held2[i] - mean_held2) + weft.stabilisation * delta2[i];
    if (needs_penalty) add_collapse_penalty(w.lane, s[i], own1, own2);
    forces[i] = corner_forces(t[i], s[i], own1, own2, secant[i]);
  }
  for (int q = 0; q < t->count; ++q) // in the order of one pack after the other
    for (int i = 0; i < 2; ++i)
      add_forces(*t[i].of[q], forces[i], q, w.force);
}

/// A compile-time integer, passed as an argument.
template <int n>
struct Count {
  constexpr operator int() const { return n; }
};

PLYFORM_INLINE int at_most(int a, int b) {
  return a < b ? a : b;
}

/// Calls each(pack, triangles, states, size, needs_penalty) for all packs of a block, as many as
/// there are quads at a time (`pack`: the first of them), pairs (size 2) before single triangles
/// (size 1).
template <class Each>
PLYFORM_INLINE void for_packs(const KernelBlock& block, const SimdLaw& law, const double* place,
                              Each&& each) {
  TrianglesOfQuads triangles[batch];
  SimdState state[batch];
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

template <bool general>
PLYFORM_INLINE KernelReport block_forces(const KernelBlock& block, const KernelLaw& law,
                                         const double* x, double per_dt) {
  alignas(32) double place[4 * most_block_nodes];
  gather_places(block.nodes, block.node_count, x, place);
  double* force = &block.force->x;
  for (int i = 0; i < block.node_count; ++i)
    store(force + 4 * i, Double4{});
  const SimdLaw lane = simd_law(law, per_dt);
  SimdBlockWork w{law, lane, force, per_dt, Double4{}};
  Longs collapsed{};
  for_packs(block, lane, place,
            [&](int pack, const auto* t, const auto* s, auto of, bool needs_penalty) {
              for (int i = 0; needs_penalty && i < of; ++i)
                collapsed |= simd_collapsed(s[i]);
              const StatesOfQuads states{of_quads(block.begin + pack, 1, t->count),
                                         of_quads(block.end + pack, 1, t->count)};
              if constexpr (of == 2)
                pair_packs<general>(w, t, s, needs_penalty, states);
              else
                single_packs<general>(w, *t, *s, needs_penalty, states);
            });
  return {0.5 * sum(w.lost), any(collapsed)};
}

/// d_a W_a, N/mm, what a family stores. begin: what it remembers.
template <bool general>
PLYFORM_INLINE Doubles yarn_energy(const SimdBlockWork& w, int family, Doubles strain,
                                   const OfQuads<const SimdYarnStates>& begin) {
  const SimdYarns& yarns = w.lane.yarns[family];
  const KernelYarns& law = w.law.yarns[family];
  if (general && w.law.by_law) {
    SimdYarnStates end; // of no use: this is no step
    return by_law(
        w, family, strain, begin, [&](int) { return end.of[family]; }, &KernelAnswers::stored,
        nullptr);
  }
  const Doubles e = 0.5 * strain * strain * (strain > 0.0 ? yarns.stiffness : yarns.compression);
  if (!general || !law.buckles) return e;
  const Doubles beyond = buckled_by(law, strain);
  return e - 0.5 * law.buckling_drop * beyond * beyond;
}

/// n_c Ws, N/mm, of g^2.
template <bool general>
PLYFORM_INLINE Doubles shear_energy(const SimdBlockWork& w, Doubles measure2) {
  if (!general || w.law.shear_terms > 0) {
    Doubles energy = all(0.0);
    for (int i = w.law.shear_terms - 1; i >= 0; --i)
      energy = (energy + w.lane.shear[i] * (0.5 / (i + 1))) * measure2;
    return energy;
  }
  return by_quads(measure2, [&](const double* at, double* e) { w.law.shear_energy(w.law, at, e); });
}

/// Stabilisation and collapse penalty of (E) times d_a, N/mm.
PLYFORM_INLINE Doubles side_energy(const SimdYarns& yarns, Doubles lambda, Doubles delta) {
  const Doubles folded = larger(all(0.0), collapse_stretch - lambda);
  return 0.5 * (yarns.stabilisation * delta * delta + yarns.collapse_penalty * folded * folded);
}

template <bool general>
PLYFORM_INLINE KernelEnergy block_energy(const KernelBlock& block, const KernelLaw& law,
                                         const double* x, double per_dt) {
  alignas(32) double place[4 * most_block_nodes];
  gather_places(block.nodes, block.node_count, x, place);
  const SimdLaw lane = simd_law(law, 0.0);
  const SimdBlockWork w{law, lane, nullptr, per_dt, Double4{}};
  const SimdYarns &warp = lane.yarns[0], &weft = lane.yarns[1];
  Double4 fibre{}, shear{};
  for_packs(block, lane, place, [&](int pack, const auto* t, const auto* s, auto of, bool) {
    const auto begin = of_quads(block.begin + pack, 1, t->count);
    Doubles area = all(0.0), mean1 = area, mean2 = area;
    for (int i = 0; i < of; ++i) {
      const Doubles share = share_of(t[i]);
      area += area_of(t[i]);
      mean1 += share * s[i].lambda1, mean2 += share * s[i].lambda2;
    }
    const Doubles of_yarns = area * (yarn_energy<general>(w, 0, mean1 - 1.0, begin) +
                                     yarn_energy<general>(w, 1, mean2 - 1.0, begin));
    Doubles of_sides[of], of_shear[of];
    for (int i = 0; i < of; ++i) {
      const Doubles delta1 = s[i].lambda1 - mean1, delta2 = s[i].lambda2 - mean2;
      const Doubles deviation2 = delta1 * delta1 + delta2 * delta2;
      const Doubles own = area_of(t[i]);
      of_sides[i] =
          own * (side_energy(warp, s[i].lambda1, delta1) + side_energy(weft, s[i].lambda2, delta2));
      of_shear[i] =
          own * shear_energy<general>(w, s[i].gamma * s[i].gamma + lane.beta * deviation2);
    }
    for (int q = 0; q < t->count; ++q) {
      fibre += quad(of_yarns, q);
      for (int i = 0; i < of; ++i)
        fibre += quad(of_sides[i], q), shear += quad(of_shear[i], q);
    }
  });
  return {sum(fibre), sum(shear)};
}

PLYFORM_INLINE bool is_general(const KernelLaw& law) {
  return law.by_law || law.yarns[0].buckles || law.yarns[1].buckles || law.shear_terms == 0;
}

PLYFORM_INLINE KernelReport membrane_kernel(const KernelBlock& block, const KernelLaw& law,
                                            const double* x, double per_dt) {
  return is_general(law) ? block_forces<true>(block, law, x, per_dt)
                         : block_forces<false>(block, law, x, per_dt);
}

PLYFORM_INLINE KernelEnergy membrane_energy_kernel(const KernelBlock& block, const KernelLaw& law,
                                                   const double* x, double per_dt) {
  return is_general(law) ? block_energy<true>(block, law, x, per_dt)
                         : block_energy<false>(block, law, x, per_dt);
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
