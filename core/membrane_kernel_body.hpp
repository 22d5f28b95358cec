// SPDX-License-Identifier: GPL-3.0-or-later
// (N), (Q) and (F) of core/membrane.hpp for four patches at a time. With
//   a = k_1.k_1,  b = k_2.k_2,  d = k_1.k_2,  J = sqrt(a b - d^2) = lambda_1 lambda_2 sin(omega)
//   gamma = omega0 - pi/2 + arctan(d / J),  tau = A0 n_c p gamma / J
// (Q) needs no unit vectors:
//   q_1 = (A0 d_1 N_1 / lambda_1 - tau d / a) k_1 + tau k_2, and so with 1 and 2 exchanged     (Q')
#include "contact/lanes.hpp"
#include "core/membrane_kernel.hpp"

namespace plyform {
namespace {

/// Four triangles and what they become.
struct LaneState {
  Vector4 k1, k2;
  Double4 a, b, d, lambda1, lambda2, j, gamma;
};

PLYFORM_INLINE LaneState lane_state(const LaneTriangles& t, const double* place, double angle) {
  const auto side = [&](int corner, int lane) {
    return load(place + 4 * t.node[corner][lane]) - load(place + 4 * t.node[0][lane]);
  };
  const Vector4 g1 = components(side(1, 0), side(1, 1), side(1, 2), side(1, 3));
  const Vector4 g2 = components(side(2, 0), side(2, 1), side(2, 2), side(2, 3));
  LaneState s;
  s.k1 = load(t.c11) * g1 + load(t.c12) * g2; // (11)
  s.k2 = load(t.c21) * g1 + load(t.c22) * g2;
  s.a = dot(s.k1, s.k1), s.b = dot(s.k2, s.k2), s.d = dot(s.k1, s.k2);
  constexpr double least_sine2 = 1e-18; // below, the shear angle has no meaning
  const Double4 ab = s.a * s.b;
  s.j = root(larger(ab - s.d * s.d, least_sine2 * ab));
  s.lambda1 = root(s.a), s.lambda2 = root(s.b);
  s.gamma = angle + arctan(s.d, s.j);
  return s;
}

/// As collapsed() of core/membrane.hpp; NaN counts.
PLYFORM_INLINE Long4 lane_collapsed(const LaneState& s) {
  constexpr double least_stretch = 0.1, least_sine_between = 0.02;
  const Long4 sound = (s.lambda1 > all(least_stretch)) & (s.lambda2 > all(least_stretch)) &
                      (s.j > least_sine_between * (s.lambda1 * s.lambda2));
  return ~sound;
}

PLYFORM_INLINE Double4 yarn_tension(const KernelLaw& law, int family, Double4 strain) {
  const KernelYarns& yarns = law.yarns[family];
  if (!yarns.table) return strain * (strain > 0.0 ? all(yarns.stiffness) : all(yarns.compression));
  alignas(32) double at[lanes], n[lanes];
  store(at, strain);
  law.tension(law.fabric, family, at, n);
  return load(n);
}

/// n_c p, N/mm, for four g^2.
PLYFORM_INLINE Double4 lane_secant(const KernelLaw& law, Double4 measure2) {
  if (law.shear_terms > 0) {
    Double4 p = all(law.shear[law.shear_terms - 1]);
    for (int i = law.shear_terms - 2; i >= 0; --i)
      p = p * measure2 + law.shear[i];
    return law.cells * p;
  }
  alignas(32) double at[lanes], p[lanes];
  store(at, measure2);
  law.secant(law.fabric, at, p);
  return law.cells * load(p);
}

/// Viscous tension of four patches, its work added up.
PLYFORM_INLINE Double4 viscous_tension(const KernelYarns& yarns, Double4 mean, Double4 elastic,
                                       Double4 area, double per_dt, double* last_lambda,
                                       double* last_tension, Double4& work) {
  const Double4 way = mean - load(last_lambda);
  const Double4 now = elastic > 0.0 ? yarns.viscosity * way * per_dt : all(0.0);
  work += (0.5 * yarns.density) * area * (now + load(last_tension)) * way; // trapezoidal rule
  store(last_lambda, mean);
  store(last_tension, now);
  return now;
}

/// (Q') and (F) of four triangles; n1, n2: N_1, N_2; secant: n_c p.
PLYFORM_INLINE void add_forces(const LaneTriangles& t, const LaneState& s, const KernelLaw& law,
                               Double4 n1, Double4 n2, Double4 secant, double* force) {
  const Double4 area = load(t.area);
  const Double4 aj = s.a * s.j, bj = s.b * s.j, ab = s.a * s.b;
  const Double4 inverse = 1.0 / (ab * s.j);
  const Double4 tau = area * secant * s.gamma * (inverse * ab);
  const Double4 per_a = inverse * bj, per_b = inverse * aj;
  const Double4 s1 = (law.yarns[0].density * area * n1 * s.lambda1 - tau * s.d) * per_a;
  const Double4 s2 = (law.yarns[1].density * area * n2 * s.lambda2 - tau * s.d) * per_b;
  const Vector4 q1 = s1 * s.k1 + tau * s.k2, q2 = s2 * s.k2 + tau * s.k1;
  const Rows f1 = rows(load(t.c11) * q1 + load(t.c21) * q2);
  const Rows f2 = rows(load(t.c12) * q1 + load(t.c22) * q2);
  for (int i = 0; i < lanes; ++i) {
    double* at0 = force + 4 * t.node[0][i];
    double* at1 = force + 4 * t.node[1][i];
    double* at2 = force + 4 * t.node[2][i];
    store(at1, load(at1) - f1.row[i]);
    store(at2, load(at2) - f2.row[i]);
    store(at0, load(at0) + (f1.row[i] + f2.row[i]));
  }
}

/// Stabilisation and guard of (N).
PLYFORM_INLINE Double4 guard_tension(const KernelYarns& yarns, Double4 lambda) {
  constexpr double guard_stretch = 0.5;
  return -yarns.guard * larger(all(0.0), guard_stretch - lambda);
}

PLYFORM_INLINE Long4 single_group(const LaneTriangles& t, LaneViscosity& v, const KernelLaw& law,
                                  const double* place, double per_dt, double* force,
                                  Double4& work) {
  const LaneState s = lane_state(t, place, law.angle);
  const Double4 area = load(t.area);
  Double4 n1 = yarn_tension(law, 0, s.lambda1 - 1.0), n2 = yarn_tension(law, 1, s.lambda2 - 1.0);
  n1 += viscous_tension(law.yarns[0], s.lambda1, n1, area, per_dt, v.lambda[0], v.tension[0], work);
  n2 += viscous_tension(law.yarns[1], s.lambda2, n2, area, per_dt, v.lambda[1], v.tension[1], work);
  n1 += guard_tension(law.yarns[0], s.lambda1);
  n2 += guard_tension(law.yarns[1], s.lambda2);
  add_forces(t, s, law, n1, n2, lane_secant(law, s.gamma * s.gamma), force);
  return lane_collapsed(s);
}

PLYFORM_INLINE Long4 pair_group(const LaneTriangles* t, LaneViscosity& v, const KernelLaw& law,
                                const double* place, double per_dt, double* force, Double4& work) {
  const LaneState s[2] = {lane_state(t[0], place, law.angle), lane_state(t[1], place, law.angle)};
  const Double4 share[2] = {load(t[0].share), load(t[1].share)};
  const Double4 area = load(t[0].area) + load(t[1].area);
  const Double4 mean1 = share[0] * s[0].lambda1 + share[1] * s[1].lambda1;
  const Double4 mean2 = share[0] * s[0].lambda2 + share[1] * s[1].lambda2;
  Double4 n1 = yarn_tension(law, 0, mean1 - 1.0), n2 = yarn_tension(law, 1, mean2 - 1.0);
  n1 += viscous_tension(law.yarns[0], mean1, n1, area, per_dt, v.lambda[0], v.tension[0], work);
  n2 += viscous_tension(law.yarns[1], mean2, n2, area, per_dt, v.lambda[1], v.tension[1], work);
  Double4 secant[2], delta1[2], delta2[2];
  Double4 shared1 = all(0.0), shared2 = all(0.0); // means of n_c p delta_a
  for (int i = 0; i < 2; ++i) {
    delta1[i] = s[i].lambda1 - mean1, delta2[i] = s[i].lambda2 - mean2;
    const Double4 deviation2 = delta1[i] * delta1[i] + delta2[i] * delta2[i];
    secant[i] = lane_secant(law, s[i].gamma * s[i].gamma + law.beta * deviation2);
    shared1 += share[i] * secant[i] * delta1[i];
    shared2 += share[i] * secant[i] * delta2[i];
  }
  for (int i = 0; i < 2; ++i) {
    const KernelYarns &warp = law.yarns[0], &weft = law.yarns[1];
    const Double4 t1 = warp.deviation * (secant[i] * delta1[i] - shared1); // t_a - mean t_a
    const Double4 t2 = weft.deviation * (secant[i] * delta2[i] - shared2);
    add_forces(t[i], s[i], law,
               n1 + t1 + warp.stabilisation * delta1[i] + guard_tension(warp, s[i].lambda1),
               n2 + t2 + weft.stabilisation * delta2[i] + guard_tension(weft, s[i].lambda2),
               secant[i], force);
  }
  return lane_collapsed(s[0]) | lane_collapsed(s[1]);
}

PLYFORM_INLINE KernelReport membrane_kernel(const KernelBlock& block, const KernelLaw& law,
                                            const double* x, double per_dt) {
  alignas(32) double place[4 * most_block_nodes];
  double* force = &block.force->x;
  for (int i = 0; i < block.node_count; ++i) {
    const double* at = x + 3 * static_cast<std::int64_t>(block.nodes[i]);
    store(place + 4 * i, Double4{at[0], at[1], at[2], 0.0});
    store(force + 4 * i, all(0.0));
  }
  Double4 work = all(0.0);
  Long4 collapsed{0, 0, 0, 0};
  const LaneTriangles* t = block.triangles;
  LaneViscosity* v = block.viscosity;
  for (int g = 0; g < block.pair_groups; ++g, t += 2, ++v)
    collapsed |= pair_group(t, *v, law, place, per_dt, force, work);
  for (int g = 0; g < block.single_groups; ++g, ++t, ++v)
    collapsed |= single_group(*t, *v, law, place, per_dt, force, work);
  return {sum(work), any(collapsed)};
}

} // namespace
} // namespace plyform
