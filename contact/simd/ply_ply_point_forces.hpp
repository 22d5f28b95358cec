// SPDX-License-Identifier: GPL-3.0-or-later
// (S), (P) and (M) of contact/forces/ply_ply.hpp for points whose feet are known, one per lane.
// Only ply_ply_kernel.cpp may include this file, as base/simd.hpp.
//
// With B = b - a, C = c - a, N = B x C of the face, n = N / |N|, v_1 = u_b - u_a, v_2 = u_c - u_a,
// and the edges opposite to the corners E_1 = -C, E_2 = B, (W) and (C) of
// contact/forces/face_rotation.hpp are
//   turn = [ (n.v_2) B - (n.v_1) C - 1/2 (B.v_2 - C.v_1) n ] / |N|                          (W')
//   F_j  = [ (E_j.K) n - 1/2 (K.n) E_j ] / |N|   from a couple K, j = 1, 2;  F_0 = -F_1 - F_2 (C')
#pragma once

#include "contact/simd/ply_ply_closest.hpp"

namespace plyform {
namespace {

/// The state of points that the computation of their forces changes.
struct SimdPoints {
  Doubles area, gap, last_gap;
  Doubles thickness;   ///< r of contact/forces/contact_law.hpp
  Doubles compacted;   ///< mm, the greatest depth so far, if the law asks for it
  Doubles by_angle;    ///< f_a of contact/forces/friction_law.hpp, if the law asks for it
  Doubles vacuum_area; ///< mm^2, b A of (V)
  Doubles celsius;     ///< degC, of the film between the plies there; NaN: not asked for
  SimdHistory memory;
  double* kept[lanes]; ///< of SlidingPlace, if the law asks for it
};

/// Weights of corners b and c at the closest points.
struct SimdWeights {
  Doubles b, c;
};

struct SimdForces {
  Vectors on_node, couple1, couple2; ///< of (C') on corners b and c
};

/// Share of a vacuum that contact does not bear, by (V).
PLYFORM_INLINE Doubles open_share(const PlyPlyKernelContact& k, Doubles gap) {
  return smaller(larger(k.per_vacuum_gap * gap, all(0.0)), all(1.0));
}

/// What of a vacuum pulls on points, by (V), over q.
PLYFORM_INLINE Doubles pull_of(const PlyPlyKernelContact& k, Doubles gap) {
  return open_share(k, gap) * larger(smaller(2.0 - k.per_vacuum_gap * gap, all(1.0)), all(0.0));
}

/// A vacuum at points.
struct SimdVacuum {
  Doubles pull;  ///< N, by (V)
  Doubles borne; ///< N/mm^2, what contact bears of it
  Longs rubs;    ///< whether there is friction
};

/// closed: mm, since the step before, of points whose gap then is `known`.
PLYFORM_INLINE SimdVacuum vacuum_of(const PlyPlyKernelContact& k, const SimdPoints& p,
                                    Doubles closed, Longs known, Longs touch, SimdTotals& sums) {
  const Doubles on = touch ? p.vacuum_area : all(0.0), open = open_share(k, p.gap);
  const Doubles pull = on * k.vacuum * pull_of(k, p.gap);
  const Doubles before = known ? on * k.vacuum_before * pull_of(k, p.last_gap) : pull;
  add(sums.vacuum, 0.5 * (pull + before) * closed);
  return {pull, on / p.area * k.vacuum * (1.0 - open), k.stuck ? touch : touch & (open < 1.0)};
}

/// Normal force and friction of points whose feet are known; `touch`: those that touch; fold:
/// as of fold_ahead.
PLYFORM_INLINE SimdForces forces_of(const PlyPlyKernelContact& k, const SimdFaces& x,
                                    const SimdFaces& u, const SimdWeights& w, Doubles distance,
                                    Doubles fold, Longs touch, SimdPoints& p, SimdTotals& sums) {
  const Doubles zero = all(0.0);
  const Vectors arm = x.p - w.b * x.b - w.c * x.c;
  const Vectors motion = u.p - w.b * u.b - w.c * u.c;
  const Doubles per_thickness = k.slave_ratio ? 1.0 / p.thickness : all(1.0);
  const Doubles depth = -p.gap * per_thickness;
  const Vectors normal = (1.0 / distance) * arm;
  const Doubles area = touch ? p.area : zero;
  const Longs known = p.last_gap < 1e300;
  const Doubles opened = per_thickness * (known ? smaller(p.last_gap, zero) : zero);
  const Doubles dp = per_thickness * (known ? p.last_gap - p.gap : -dot(normal, motion));
  const SimdElastic elastic = elastic_of(k, area, depth, touch, p.compacted, sums);
  const Doubles pressure = normal_pressure(k, area, elastic.pressure, depth, opened, dp,
                                           per_thickness, touch, p.memory, sums);
  SimdForces f{p.memory.normal_force * normal, {zero, zero, zero}, {zero, zero, zero}};
  SimdVacuum vacuum{zero, zero, touch};
  if (k.per_vacuum_gap > 0.0) {
    const Doubles closed = known ? p.last_gap - p.gap : -dot(normal, motion);
    vacuum = vacuum_of(k, p, closed, known, touch, sums);
    f.on_node = f.on_node - vacuum.pull * normal;
  }
  Doubles stored2 = zero;
  if (k.friction > 0.0) {
    const Vectors across = cross(x.b, x.c);
    const Doubles per_size = 1.0 / root(square(across));
    const Vectors n = per_size * across;
    const Doubles v1 = dot(n, u.b), v2 = dot(n, u.c);
    const Doubles spin = 0.5 * (dot(x.b, u.c) - dot(x.c, u.b));
    const Vectors turn = per_size * (v2 * x.b - v1 * x.c - spin * n); // (W')
    const Vectors slip = motion - cross(turn, arm);                   // (P)
    const Vectors& s = p.memory.s;
    SimdSliding by{p.by_angle, per_thickness, p.celsius, {}};
    for (int i = 0; i < lanes && k.keeps; ++i)
      by.kept[i] = p.kept[i];
    const Vectors tangential =
        friction_of(k, area, pressure + vacuum.borne, normal, s + cross(turn, s), slip, by,
                    vacuum.rubs, p.memory, sums);
    f.on_node = f.on_node + tangential;
    const Vectors couple = cross(tangential, arm); // -r x T of (M)
    const Doubles half = 0.5 * dot(couple, n);
    f.couple1 = per_size * (half * x.c - dot(x.c, couple) * n); // (C'), E_1 = -C
    f.couple2 = per_size * (dot(x.b, couple) * n - half * x.b);
    stored2 = square(p.memory.s);
  }
  add(sums.elastic, 0.5 * area * (elastic.energy2 + k.tangential * stored2));
  Doubles closing = dp;
  if (any(fold > 0.0)) {
    const Doubles along = root(square(motion - dot(normal, motion) * normal));
    closing = fold > 0.0 ? larger(dp, zero) + per_thickness * fold * along : dp;
  }
  keep_smaller(sums.step_ratio, step_ratio_of(k, depth, closing));
  keep_larger(sums.penetration, touch ? depth : zero);
  return f;
}

} // namespace
} // namespace plyform
