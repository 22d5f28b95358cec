// SPDX-License-Identifier: GPL-3.0-or-later
// (N), (Q) and (F) of core/ply/membrane.hpp for four groups at a time. With
//   a = k_1.k_1,  b = k_2.k_2,  d = k_1.k_2,  J = sqrt(a b - d^2) = lambda_1 lambda_2 sin(omega)
//   gamma = omega0 - pi/2 + arctan(d / J),  tau = A0 n_c p gamma / J
// (Q) can be written without unit vectors:
//   q_1 = (A0 d_1 N_1 / lambda_1 - tau d / a) k_1 + tau k_2, and so with 1 and 2 exchanged     (Q')
#include "core/ply/element_limits.hpp"
#include "core/ply/membrane_simd_kernel.hpp"
#include "core/ply/simd_kernel_body.hpp"

namespace plyform {
namespace {

/// Number of SimdTriangles that pass through each stage of the computation together, so that the
/// processor overlaps the latency of their square roots. Even, so that pairs are not separated.
constexpr int batch = 8;

/// KernelLaw with each number copied to all SIMD lanes.
struct SimdYarns {
  Double4 stiffness, compression, viscosity, stabilisation, collapse_penalty; ///< viscosity: N/mm
};

struct SimdLaw {
  SimdYarns yarns[2];
  Double4 angle, beta, shear[most_shear_terms];
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

/// Kinematics of four triangles: the symbols at the head of this file.
struct SimdState {
  Vector4 k1, k2;
  Double4 a, b, d, lambda1, lambda2, j;
  Double4 gamma, area_a, area_b, per_j; ///< area_a: A0 / a; per_j: 1 / J
};

PLYFORM_INLINE void find_lengths(const SimdTriangles& t, const double* place, SimdState& s) {
  const auto side = [&](int corner, int lane) {
    return load(of_node(place, t.node[corner][lane])) - load(of_node(place, t.node[0][lane]));
  };
  const Vector4 g1 = components(side(1, 0), side(1, 1), side(1, 2), side(1, 3));
  const Vector4 g2 = components(side(2, 0), side(2, 1), side(2, 2), side(2, 3));
  const Vector4 k1 = load(t.c11) * g1 + load(t.c12) * g2; // (11)
  const Vector4 k2 = load(t.c21) * g1 + load(t.c22) * g2;
  const Double4 a = dot(k1, k1), b = dot(k2, k2), d = dot(k1, k2), ab = a * b;
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
PLYFORM_INLINE Long4 find_angle(const SimdTriangles& t, const SimdLaw& law, SimdState& s) {
  const Double4 length2 = s.lambda1 * s.lambda2;
  const Double4 ab = s.a * s.b, aj = s.a * s.j, bj = s.b * s.j;
  const Double4 inverse = 1.0 / (ab * s.j), area = load(t.area) * inverse;
  s.area_a = area * bj, s.area_b = area * aj, s.per_j = inverse * ab;
  s.gamma = law.angle + arctan(s.d, s.j, length2);
  const Long4 valid = (s.lambda1 > all(collapse_stretch)) & (s.lambda2 > all(collapse_stretch)) &
                      (s.j > least_sine_between * length2);
  return ~valid;
}

/// Mask of collapsed triangles, as collapsed() of core/ply/membrane.hpp; NaN counts as collapsed.
PLYFORM_INLINE Long4 simd_collapsed(const SimdState& s) {
  const Long4 valid = (s.lambda1 > all(least_stretch)) & (s.lambda2 > all(least_stretch)) &
                      (s.j > least_sine_between * (s.lambda1 * s.lambda2));
  return ~valid;
}

/// Data that all packs of a block share.
struct SimdBlockWork {
  const KernelLaw& law;
  const SimdLaw& lane;
  double* force;
  Double4 work;
};

/// Compressive strain beyond the buckling strain; 0 for yarns that have not buckled.
PLYFORM_INLINE Double4 buckled_by(const KernelYarns& yarns, Double4 strain) {
  return larger(all(0.0), -yarns.buckling_strain - strain);
}

/// d_a W_a', N/mm. `general`: some law of the fabric is a table, or its yarns can buckle.
template <bool general>
PLYFORM_INLINE Double4 yarn_tension(const SimdBlockWork& w, int family, Double4 strain) {
  const SimdYarns& yarns = w.lane.yarns[family];
  const KernelYarns& law = w.law.yarns[family];
  if (!general || !law.table) {
    const Double4 n = strain * (strain > 0.0 ? yarns.stiffness : yarns.compression);
    return general && law.buckles ? n + law.buckling_drop * buckled_by(law, strain) : n;
  }
  alignas(32) double at[simd_width], n[simd_width];
  store(at, strain);
  w.law.tension(w.law, family, at, n);
  return load(n);
}

/// n_c p, N/mm, for four g^2.
template <bool general>
PLYFORM_INLINE Double4 simd_secant(const SimdBlockWork& w, Double4 measure2) {
  const int terms = w.law.shear_terms;
  if (!general || terms > 0) {
    const Double4* k = w.lane.shear;
    Double4 p = k[2];
    if (terms > 3) {
      p = k[terms - 1];
      for (int i = terms - 2; i >= 2; --i)
        p = p * measure2 + k[i];
    }
    return (p * measure2 + k[1]) * measure2 + k[0];
  }
  alignas(32) double at[simd_width], p[simd_width];
  store(at, measure2);
  w.law.secant(w.law, at, p);
  return load(p);
}

/// Adds the viscous tensions of four groups to n1 and n2 (N/mm), and twice their work (N mm) to
/// w.work.
PLYFORM_INLINE void add_viscosity(SimdBlockWork& w, SimdViscosity& v, Double4 mean1, Double4 mean2,
                                  Double4 area, Double4& n1, Double4& n2) {
  const Double4 change1 = mean1 - load(v.lambda[0]), change2 = mean2 - load(v.lambda[1]);
  const Double4 now1 = n1 > 0.0 ? w.lane.yarns[0].viscosity * change1 : all(0.0);
  const Double4 now2 = n2 > 0.0 ? w.lane.yarns[1].viscosity * change2 : all(0.0);
  w.work += area * ((now1 + load(v.tension[0])) * change1 + (now2 + load(v.tension[1])) * change2);
  store(v.lambda[0], mean1), store(v.lambda[1], mean2);
  store(v.tension[0], now1), store(v.tension[1], now2);
  n1 += now1, n2 += now2;
}

/// Adds (Q') and (F) of four triangles to their nodes. n1, n2: d_a N_a, N/mm; secant: n_c p, N/mm.
PLYFORM_INLINE void add_forces(const SimdTriangles& t, const SimdState& s, Double4 n1, Double4 n2,
                               Double4 secant, double* force) {
  const Double4 shear = secant * s.gamma * s.per_j, tau = shear * load(t.area);
  const Double4 away = shear * s.d;
  const Double4 s1 = (n1 * s.lambda1 - away) * s.area_a;
  const Double4 s2 = (n2 * s.lambda2 - away) * s.area_b;
  const Double4 c11 = load(t.c11), c12 = load(t.c12), c21 = load(t.c21), c22 = load(t.c22);
  const Rows f1 = rows((c11 * s1 + c21 * tau) * s.k1 + (c11 * tau + c21 * s2) * s.k2);
  const Rows f2 = rows((c12 * s1 + c22 * tau) * s.k1 + (c12 * tau + c22 * s2) * s.k2);
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
PLYFORM_INLINE void add_collapse_penalty(const SimdLaw& law, const SimdState& s, Double4& n1,
                                         Double4& n2) {
  n1 -= law.yarns[0].collapse_penalty * larger(all(0.0), collapse_stretch - s.lambda1);
  n2 -= law.yarns[1].collapse_penalty * larger(all(0.0), collapse_stretch - s.lambda2);
}

template <bool general>
PLYFORM_INLINE void single_pack(SimdBlockWork& w, const SimdTriangles& t, const SimdState& s,
                                bool needs_penalty, SimdViscosity& v) {
  Double4 n1 = yarn_tension<general>(w, 0, s.lambda1 - 1.0);
  Double4 n2 = yarn_tension<general>(w, 1, s.lambda2 - 1.0);
  add_viscosity(w, v, s.lambda1, s.lambda2, load(t.area), n1, n2);
  if (needs_penalty) add_collapse_penalty(w.lane, s, n1, n2);
  add_forces(t, s, n1, n2, simd_secant<general>(w, s.gamma * s.gamma), w.force);
}

template <bool general>
PLYFORM_INLINE void pair_pack(SimdBlockWork& w, const SimdTriangles* t, const SimdState* s,
                              bool needs_penalty, SimdViscosity& v) {
  const Double4 share[2] = {load(t[0].share), load(t[1].share)};
  const Double4 mean1 = share[0] * s[0].lambda1 + share[1] * s[1].lambda1;
  const Double4 mean2 = share[0] * s[0].lambda2 + share[1] * s[1].lambda2;
  Double4 n1 = yarn_tension<general>(w, 0, mean1 - 1.0);
  Double4 n2 = yarn_tension<general>(w, 1, mean2 - 1.0);
  add_viscosity(w, v, mean1, mean2, load(t[0].area) + load(t[1].area), n1, n2);
  Double4 secant[2], held1[2], held2[2]; // n_c p delta_a
  Double4 delta1[2], delta2[2];
  for (int i = 0; i < 2; ++i) {
    delta1[i] = s[i].lambda1 - mean1, delta2[i] = s[i].lambda2 - mean2;
    const Double4 deviation2 = delta1[i] * delta1[i] + delta2[i] * delta2[i];
    secant[i] = simd_secant<general>(w, s[i].gamma * s[i].gamma + w.lane.beta * deviation2);
    held1[i] = secant[i] * delta1[i], held2[i] = secant[i] * delta2[i];
  }
  const Double4 mean_held1 = share[0] * held1[0] + share[1] * held1[1];
  const Double4 mean_held2 = share[0] * held2[0] + share[1] * held2[1];
  for (int i = 0; i < 2; ++i) {
    const SimdYarns &warp = w.lane.yarns[0], &weft = w.lane.yarns[1];
    Double4 own1 = n1 + w.lane.beta * (held1[i] - mean_held1) + warp.stabilisation * delta1[i];
    Double4 own2 = n2 + w.lane.beta * (held2[i] - mean_held2) + weft.stabilisation * delta2[i];
    if (needs_penalty) add_collapse_penalty(w.lane, s[i], own1, own2);
    add_forces(t[i], s[i], own1, own2, secant[i], w.force);
  }
}

/// Kinematics of `count` SimdTriangles; returns whether any triangle needs the test for collapse
/// and the collapse penalty.
PLYFORM_INLINE bool find_states(const SimdTriangles* t, int count, const SimdLaw& law,
                                const double* place, SimdState* s) {
  for (int i = 0; i < count; ++i)
    find_lengths(t[i], place, s[i]);
  Long4 needs_penalty{0, 0, 0, 0};
  for (int i = 0; i < count; ++i)
    needs_penalty |= find_angle(t[i], law, s[i]);
  return any(needs_penalty);
}

/// A compile-time integer, passed as an argument.
template <int n>
struct Count {
  constexpr operator int() const { return n; }
};

PLYFORM_INLINE int at_most(int a, int b) {
  return a < b ? a : b;
}

/// Calls each(pack, triangles, states, size, needs_penalty) for all packs of a block, pairs (size
/// 2) first, then single triangles (size 1).
template <class Each>
PLYFORM_INLINE void for_packs(const KernelBlock& block, const SimdLaw& law, const double* place,
                              Each&& each) {
  SimdState state[batch];
  const int pairs = 2 * block.pair_packs, all = pairs + block.single_packs;
  int pack = 0;
  const auto some = [&](int begin, int end, auto of) {
    const SimdTriangles* t = block.triangles + begin;
    const int size = at_most(end - begin, batch);
    const bool needs_penalty = find_states(t, size, law, place, state);
    for (int i = 0; i < size; i += of)
      each(pack++, t + i, state + i, of, needs_penalty);
  };
  for (int begin = 0; begin < pairs; begin += batch)
    some(begin, pairs, Count<2>{});
  for (int begin = pairs; begin < all; begin += batch)
    some(begin, all, Count<1>{});
}

template <bool general>
PLYFORM_INLINE KernelReport block_forces(const KernelBlock& block, const KernelLaw& law,
                                         const double* x, double per_dt) {
  alignas(32) double place[4 * most_block_nodes];
  gather_places(block.nodes, block.node_count, x, place);
  double* force = &block.force->x;
  for (int i = 0; i < block.node_count; ++i)
    store(force + 4 * i, all(0.0));
  const SimdLaw lane = simd_law(law, per_dt);
  SimdBlockWork w{law, lane, force, all(0.0)};
  Long4 collapsed{0, 0, 0, 0};
  for_packs(block, lane, place,
            [&](int pack, const auto* t, const auto* s, auto of, bool needs_penalty) {
              for (int i = 0; needs_penalty && i < of; ++i)
                collapsed |= simd_collapsed(s[i]);
              if constexpr (of == 2)
                pair_pack<general>(w, t, s, needs_penalty, block.viscosity[pack]);
              else
                single_pack<general>(w, *t, *s, needs_penalty, block.viscosity[pack]);
            });
  return {0.5 * sum(w.work), any(collapsed)}; // trapezoidal rule
}

/// d_a W_a, N/mm, of four strains.
template <bool general>
PLYFORM_INLINE Double4 yarn_energy(const SimdBlockWork& w, int family, Double4 strain) {
  const SimdYarns& yarns = w.lane.yarns[family];
  const KernelYarns& law = w.law.yarns[family];
  if (!general || !law.table) {
    const Double4 e = 0.5 * strain * strain * (strain > 0.0 ? yarns.stiffness : yarns.compression);
    if (!general || !law.buckles) return e;
    const Double4 beyond = buckled_by(law, strain);
    return e - 0.5 * law.buckling_drop * beyond * beyond;
  }
  alignas(32) double at[simd_width], energy[simd_width];
  store(at, strain);
  w.law.tension_energy(w.law, family, at, energy);
  return load(energy);
}

/// n_c Ws, N/mm, of four g^2.
template <bool general>
PLYFORM_INLINE Double4 shear_energy(const SimdBlockWork& w, Double4 measure2) {
  if (!general || w.law.shear_terms > 0) {
    Double4 energy = all(0.0);
    for (int i = w.law.shear_terms - 1; i >= 0; --i)
      energy = (energy + w.lane.shear[i] * (0.5 / (i + 1))) * measure2;
    return energy;
  }
  alignas(32) double at[simd_width], energy[simd_width];
  store(at, measure2);
  w.law.shear_energy(w.law, at, energy);
  return load(energy);
}

/// Stabilisation and collapse penalty of (E) times d_a, N/mm.
PLYFORM_INLINE Double4 side_energy(const SimdYarns& yarns, Double4 lambda, Double4 delta) {
  const Double4 folded = larger(all(0.0), collapse_stretch - lambda);
  return 0.5 * (yarns.stabilisation * delta * delta + yarns.collapse_penalty * folded * folded);
}

template <bool general>
PLYFORM_INLINE KernelEnergy block_energy(const KernelBlock& block, const KernelLaw& law,
                                         const double* x) {
  alignas(32) double place[4 * most_block_nodes];
  gather_places(block.nodes, block.node_count, x, place);
  const SimdLaw lane = simd_law(law, 0.0);
  const SimdBlockWork w{law, lane, nullptr, all(0.0)};
  const SimdYarns &warp = lane.yarns[0], &weft = lane.yarns[1];
  Double4 fibre = all(0.0), shear = all(0.0);
  for_packs(block, lane, place, [&](int, const auto* t, const auto* s, auto of, bool) {
    Double4 area = all(0.0), mean1 = area, mean2 = area;
    for (int i = 0; i < of; ++i) {
      area += load(t[i].area);
      mean1 += load(t[i].share) * s[i].lambda1, mean2 += load(t[i].share) * s[i].lambda2;
    }
    fibre +=
        area * (yarn_energy<general>(w, 0, mean1 - 1.0) + yarn_energy<general>(w, 1, mean2 - 1.0));
    for (int i = 0; i < of; ++i) {
      const Double4 delta1 = s[i].lambda1 - mean1, delta2 = s[i].lambda2 - mean2;
      const Double4 deviation2 = delta1 * delta1 + delta2 * delta2;
      const Double4 own = load(t[i].area);
      fibre +=
          own * (side_energy(warp, s[i].lambda1, delta1) + side_energy(weft, s[i].lambda2, delta2));
      shear += own * shear_energy<general>(w, s[i].gamma * s[i].gamma + lane.beta * deviation2);
    }
  });
  return {sum(fibre), sum(shear)};
}

PLYFORM_INLINE bool is_general(const KernelYarns& yarns) {
  return yarns.table || yarns.buckles;
}

PLYFORM_INLINE bool is_general(const KernelLaw& law) {
  return is_general(law.yarns[0]) || is_general(law.yarns[1]) || law.shear_terms == 0;
}

PLYFORM_INLINE KernelReport membrane_kernel(const KernelBlock& block, const KernelLaw& law,
                                            const double* x, double per_dt) {
  return is_general(law) ? block_forces<true>(block, law, x, per_dt)
                         : block_forces<false>(block, law, x, per_dt);
}

PLYFORM_INLINE KernelEnergy membrane_energy_kernel(const KernelBlock& block, const KernelLaw& law,
                                                   const double* x) {
  return is_general(law) ? block_energy<true>(block, law, x) : block_energy<false>(block, law, x);
}

} // namespace
} // namespace plyform
