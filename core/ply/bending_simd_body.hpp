// SPDX-License-Identifier: GPL-3.0-or-later
// (F) and (I) of core/ply/bending.hpp for the stencils of four nodes at a time. The constants of a
// stencil sum to zero, so only differences d_i = x_i - x_own from its centre node matter, and the
// centre node gets minus the sum of the forces on the others:
//   N = sum_k d_k x d_{k+1}            over the ring, from its last back to its first
//   F_i = sum_ab B_ab,i V_ab + sum_a A_a,i U_a + (d_{i-1} - d_{i+1}) x v
//   V_aa = -A0 (m_aa n + M_g c/l^2),  V_12 = -A0 m_12 n,  U_a = -A0 M_g (q x n),  v = A0 h_t / |N|
#include "core/ply/bending_simd_kernel.hpp"
#include "core/ply/simd_kernel_body.hpp"

namespace plyform {
namespace {

/// First and second derivatives and area vectors of four stencils.
struct SimdShape {
  Vector4 sum;       ///< N
  Vector4 second[3]; ///< s_11, s_22, s_12
  Vector4 first[2];  ///< d of warp and weft
};

/// Factors of the constants in the forces.
struct SimdFactors {
  Vector4 second[3]; ///< V_11, V_22, V_12
  Vector4 first[2];  ///< U_1, U_2
  Vector4 turn;      ///< v, from the rotation of the normal
};

PLYFORM_INLINE Vector4 none() {
  return {all(0.0), all(0.0), all(0.0)};
}

PLYFORM_INLINE Vector4 places(const double* place, const std::uint16_t* at) {
  return components(load(of_node(place, at[0])), load(of_node(place, at[1])),
                    load(of_node(place, at[2])), load(of_node(place, at[3])));
}

template <bool in_plane>
constexpr int slot_numbers = in_plane ? 5 : 3;

PLYFORM_INLINE void add_to(Vector4& sum, Double4 factor, const Vector4& a) {
  sum.x += factor * a.x, sum.y += factor * a.y, sum.z += factor * a.z;
}

/// Computes d_i of all slots, mm, and from them the derivatives.
template <bool in_plane>
PLYFORM_INLINE SimdShape find_shape(const SimdStencils& p, const std::uint16_t* slots,
                                    const SimdNumbers* constants, const double* place, Vector4* d) {
  const Vector4 own = places(place, p.own);
  SimdShape s{none(), {none(), none(), none()}, {none(), none()}};
  for (int i = 0; i < p.slots; ++i, constants += slot_numbers<in_plane>) {
    const Vector4 di = places(place, slots + simd_width * i) - own;
    d[i] = di;
    for (int k = 0; k < 3; ++k)
      add_to(s.second[k], load(constants[k].of), di);
    for (int k = 0; k < 2 && in_plane; ++k)
      add_to(s.first[k], load(constants[3 + k].of), di);
  }
  Vector4 before = d[p.ring - 1];
  for (int i = 0; i < p.ring; ++i) {
    s.sum = s.sum + cross(before, d[i]);
    before = d[i];
  }
  return s;
}

/// M_1 or M_2, N, of four curvatures (1/mm).
template <bool tables>
PLYFORM_INLINE Double4 yarn_moment(const BendingKernelLaw& law, int family, Double4 kappa) {
  if (!tables) return law.stiffness[family] * kappa;
  alignas(32) double at[simd_width], m[simd_width];
  store(at, kappa);
  law.moment(law, family, at, m);
  return load(m);
}

/// (I) of one family: adds to the factors, and to h.
PLYFORM_INLINE void add_in_plane(const SimdShape& s, const Vector4& normal, Double4 area,
                                 Double4 stiffness, int family, SimdFactors& f, Vector4& h) {
  constexpr double least = 1e-12; // lower limit of l^2, below which a yarn has no direction
  const Vector4 &along = s.first[family], &second = s.second[family];
  const Vector4 c = cross(normal, along);
  const Double4 per_l2 = 1.0 / larger(all(least), dot(c, c));
  const Vector4 across = per_l2 * c;
  const Double4 kappa = dot(second, across), moment = stiffness * kappa;
  const Vector4 q = per_l2 * second - (kappa + kappa) * across;
  const Double4 factor = -(area * moment);
  add_to(f.second[family], factor, across);
  f.first[family] = factor * cross(q, normal);
  add_to(h, moment, cross(along, q));
}

template <bool in_plane, bool tables>
PLYFORM_INLINE SimdFactors find_factors(const SimdStencils& p, const SimdShape& s,
                                        const BendingKernelLaw& law) {
  const Double4 area = load(p.area), per_size = 1.0 / root(dot(s.sum, s.sum));
  const Vector4 normal = per_size * s.sum;
  const Double4 kappa1 = dot(normal, s.second[0]), kappa2 = dot(normal, s.second[1]);
  const Double4 m1 = yarn_moment<tables>(law, 0, kappa1) + law.coupling * kappa2;
  const Double4 m2 = yarn_moment<tables>(law, 1, kappa2) + law.coupling * kappa1;
  const Double4 m12 = law.twist * dot(normal, s.second[2]);
  Vector4 h = m1 * s.second[0] + m2 * s.second[1] + m12 * s.second[2];
  SimdFactors f{{(-(area * m1)) * normal, (-(area * m2)) * normal, (-(area * m12)) * normal},
                {none(), none()},
                none()};
  for (int k = 0; k < 2 && in_plane; ++k)
    add_in_plane(s, normal, area, load(p.in_plane[k]), k, f, h);
  f.turn = (area * per_size) * (h - dot(h, normal) * normal);
  return f;
}

/// Adds four forces to four nodes.
PLYFORM_INLINE void add_rows(const Vector4& f, const std::uint16_t* at, double* force) {
  const Rows r = rows(f);
  for (int i = 0; i < simd_width; ++i) {
    double* to = of_node(force, at[i]);
    store(to, load(to) + r.row[i]);
  }
}

template <bool in_plane>
PLYFORM_INLINE void add_forces(const SimdStencils& p, const SimdFactors& f,
                               const std::uint16_t* slots, const SimdNumbers* constants,
                               const Vector4* d, double* force) {
  Vector4 sum = none(), before = d[p.ring - 1];
  for (int i = 0; i < p.slots; ++i, constants += slot_numbers<in_plane>) {
    Vector4 fi = load(constants[0].of) * f.second[0];
    for (int k = 1; k < 3; ++k)
      add_to(fi, load(constants[k].of), f.second[k]);
    for (int k = 0; k < 2 && in_plane; ++k)
      add_to(fi, load(constants[3 + k].of), f.first[k]);
    if (i < p.ring) {
      fi = fi + cross(before - d[i + 1 < p.ring ? i + 1 : 0], f.turn);
      before = d[i];
    }
    sum = sum + fi;
    add_rows(fi, slots + simd_width * i, force);
  }
  add_rows(none() - sum, p.own, force);
}

template <bool in_plane, bool tables>
PLYFORM_INLINE void block_forces(const BendingKernelBlock& block, const BendingKernelLaw& law,
                                 const double* x, double* place) {
  gather_places(block.nodes, block.node_count, x, place);
  double* force = &block.force->x;
  for (int i = 0; i < block.node_count; ++i)
    store(force + 4 * i, all(0.0));
  Vector4 d[most_stencil_slots];
  const SimdNumbers* constants = block.constants;
  const std::uint16_t* slots = block.slots;
  for (int group = 0; group < block.groups; ++group) {
    const SimdStencils& p = block.stencils[group];
    const SimdShape s = find_shape<in_plane>(p, slots, constants, place, d);
    const SimdFactors f = find_factors<in_plane, tables>(p, s, law);
    add_forces<in_plane>(p, f, slots, constants, d, force);
    constants += slot_numbers<in_plane> * p.slots;
    slots += simd_width * p.slots;
  }
}

PLYFORM_INLINE void bending_kernel(const BendingKernelBlock& block, const BendingKernelLaw& law,
                                   const double* x) {
  alignas(32) double place[4 * most_bending_nodes];
  if (law.table)
    law.in_plane ? block_forces<true, true>(block, law, x, place)
                 : block_forces<false, true>(block, law, x, place);
  else
    law.in_plane ? block_forces<true, false>(block, law, x, place)
                 : block_forces<false, false>(block, law, x, place);
}

} // namespace
} // namespace plyform
