// SPDX-License-Identifier: GPL-3.0-or-later
// (F) and (I) of core/ply/bending.hpp for the stencils of four nodes at a time, or with eight lanes
// those of two successive groups of four that have as many slots. The constants of a stencil sum to
// zero, so only differences d_i = x_i - x_own from its centre node matter, and the centre node gets
// minus the sum of the forces on the others:
//   N = sum_k d_k x d_{k+1}            over the ring, from its last back to its first
//   F_i = sum_ab B_ab,i V_ab + sum_a A_a,i U_a + (d_{i-1} - d_{i+1}) x v
//   V_k = -A0 (m_k n + sum_f M_g p_k c/l^2),  U_a = -A0 sum_f M_g v_a (q x n),  v = A0 h_t / |N|
// with V and m in the order 11, 22, 12.
#include "core/ply/bending_simd_kernel.hpp"

#include "core/ply/viscous_lanes.hpp"

namespace plyform {
namespace {

/// The groups of four stencils that are computed together, one per quad of lanes; they have as many
/// slots. If there is only one (count), all quads repeat it.
struct SimdGroups {
  const SimdStencils* stencils[quads];
  const SimdNumbers* constants[quads];
  const std::uint16_t* slots[quads];
  const SimdNumbers* in_plane[quads];
  int ring, slot_count, count;
};

/// First and second derivatives and area vectors of the stencils.
struct SimdShape {
  Vectors sum;       ///< N
  Vectors second[3]; ///< s_11, s_22, s_12
  Vectors first[2];  ///< along the axes
};

/// Factors of the constants in the forces.
struct SimdFactors {
  Vectors second[3]; ///< V_11, V_22, V_12
  Vectors first[2];  ///< U_1, U_2
  Vectors turn;      ///< v, from the rotation of the normal
};

PLYFORM_INLINE Vectors none() {
  return {all(0.0), all(0.0), all(0.0)};
}

/// Places of nodes; nodes_of: group to four nodes.
template <class Nodes>
PLYFORM_INLINE Vectors places(const double* place, const Nodes& nodes_of) {
  Double4 at[lanes];
  for (int q = 0; q < quads; ++q) {
    const std::uint16_t* nodes = nodes_of(q);
    for (int i = 0; i < simd_width; ++i)
      at[simd_width * q + i] = load(of_node(place, nodes[i]));
  }
  return components(at);
}

template <bool in_plane>
constexpr int slot_numbers = in_plane ? 5 : 3;

PLYFORM_INLINE void add_to(Vectors& sum, Doubles factor, const Vectors& a) {
  sum.x += factor * a.x, sum.y += factor * a.y, sum.z += factor * a.z;
}

/// Constant k of slot i: B_11, B_22, B_12, A_1, A_2.
template <bool in_plane>
PLYFORM_INLINE Doubles constant(const SimdGroups& g, int i, int k) {
  return numbers([&](int q) { return g.constants[q][slot_numbers<in_plane> * i + k].of; });
}

/// Computes d_i of all slots, mm, and from them the derivatives.
template <bool in_plane>
PLYFORM_INLINE SimdShape find_shape(const SimdGroups& g, const double* place, Vectors* d) {
  const Vectors own = places(place, [&](int q) { return g.stencils[q]->own; });
  SimdShape s{none(), {none(), none(), none()}, {none(), none()}};
  for (int i = 0; i < g.slot_count; ++i) {
    const Vectors di = places(place, [&](int q) { return g.slots[q] + simd_width * i; }) - own;
    d[i] = di;
    for (int k = 0; k < 3; ++k)
      add_to(s.second[k], constant<in_plane>(g, i, k), di);
    for (int k = 0; k < 2 && in_plane; ++k)
      add_to(s.first[k], constant<in_plane>(g, i, 3 + k), di);
  }
  Vectors before = d[g.ring - 1];
  for (int i = 0; i < g.ring; ++i) {
    s.sum = s.sum + cross(before, d[i]);
    before = d[i];
  }
  return s;
}

/// Adds the moments (N) of tabulated laws to m_11, m_22, m_12 by the curvatures along the axes.
template <class Of>
PLYFORM_INLINE void add_tables(const BendingKernelLaw& law, const Doubles* kappa, Doubles* m) {
  const auto moment = [&](int family, Doubles at_kappa) {
    return by_quads(at_kappa,
                    [&](const double* at, double* out) { law.moment(law, family, at, out); });
  };
  for_families<Of>(law.families, [&](auto a) {
    if (!law.family[a].table) return;
    if constexpr (Of::weave) {
      m[a] += moment(a, kappa[a]);
    } else {
      const double* p = law.family[a].of_axes;
      const Doubles of = moment(a, p[0] * kappa[0] + p[1] * kappa[1] + p[2] * kappa[2]);
      for (int k = 0; k < 3; ++k)
        m[k] += p[k] * of;
    }
  });
}

/// Moves the viscous moments of core/ply/viscous_bending.hpp over a step, and adds them. group:
/// number of the first group in the block.
template <class Of>
PLYFORM_INLINE void add_viscous(const SimdGroups& g, int group, Doubles area,
                                const BendingKernelLaw& law, const Doubles* kappa, Doubles* m) {
  const KernelViscousBending& v = *law.viscous;
  ViscousStatesOfQuads s;
  s.begin.count = s.end.count = g.count;
  Double4 factors[quads];
  for (int q = 0; q < quads; ++q) {
    const int of = group + (q < g.count ? q : 0);
    s.begin.of[q] = v.begin + v.states * of, s.end.of[q] = v.end + v.states * of;
    factors[q] = v.factors ? load(v.factors[of].of) : Double4{1.0, 1.0, 1.0, 1.0};
  }
  const Doubles factor = joined(factors);
  Doubles lost = all(0.0);
  for (int f = 0; f < v.families; ++f) {
    const int a = v.family[f];
    const double* p = law.family[a].of_axes;
    const Doubles along =
        Of::weave ? kappa[a] : p[0] * kappa[0] + p[1] * kappa[1] + p[2] * kappa[2];
    const Doubles change = v.moves * (along - state_before(s, 1 + 2 * f));
    set_state(s, 1 + 2 * f, along);
    const Doubles moment =
        move_dashpot(s, 2 + 2 * f, factor * v.viscosity[f], v.spring, change, lost);
    for (int k = 0; k < 3 && !Of::weave; ++k)
      m[k] += p[k] * moment;
    if (Of::weave) m[a] += moment;
  }
  set_state(s, 0, state_before(s, 0) + area * lost);
}

/// First and second derivatives along a family.
struct AlongFamily {
  Vectors first, second;
};

template <class Of, class Family>
PLYFORM_INLINE AlongFamily along_family(const BendingKernelLaw& law, const SimdShape& s, Family a) {
  if constexpr (Of::weave) {
    return {s.first[a], s.second[a]};
  } else {
    const BendingKernelFamily& f = law.family[a];
    AlongFamily along{none(), none()};
    for (int k = 0; k < 2; ++k)
      add_to(along.first, all(f.along[k]), s.first[k]);
    for (int k = 0; k < 3; ++k)
      add_to(along.second, all(f.of_axes[k]), s.second[k]);
    return along;
  }
}

/// (I) of one family: adds to the factors, and to h.
template <class Of, class Family>
PLYFORM_INLINE void add_in_plane(const BendingKernelLaw& law, const SimdShape& s,
                                 const Vectors& normal, Doubles area, Doubles stiffness, Family a,
                                 SimdFactors& f, Vectors& h) {
  constexpr double least = 1e-12; // lower limit of l^2, below which a yarn has no direction
  const AlongFamily along = along_family<Of>(law, s, a);
  const Vectors c = cross(normal, along.first);
  const Doubles per_l2 = 1.0 / larger(all(least), dot(c, c));
  const Vectors across = per_l2 * c;
  const Doubles kappa = dot(along.second, across), moment = stiffness * kappa;
  const Vectors q = per_l2 * along.second - (kappa + kappa) * across;
  const Doubles factor = -(area * moment);
  if constexpr (Of::weave) {
    add_to(f.second[a], factor, across);
    f.first[a] = factor * cross(q, normal);
  } else {
    const BendingKernelFamily& of = law.family[a];
    for (int k = 0; k < 3; ++k)
      add_to(f.second[k], of.of_axes[k] * factor, across);
    for (int k = 0; k < 2; ++k)
      add_to(f.first[k], of.along[k] * factor, cross(q, normal));
  }
  add_to(h, moment, cross(along.first, q));
}

template <class Of, bool in_plane, bool tables>
PLYFORM_INLINE SimdFactors find_factors(const SimdGroups& g, int group, const SimdShape& s,
                                        const BendingKernelLaw& law) {
  const Doubles area = numbers([&](int q) { return g.stencils[q]->area; });
  const Doubles per_size = 1.0 / root(dot(s.sum, s.sum));
  const Vectors normal = per_size * s.sum;
  const Doubles kappa[3] = {dot(normal, s.second[0]), dot(normal, s.second[1]),
                            dot(normal, s.second[2])};
  Doubles m[3] = {law.stiffness[0] * kappa[0] + law.coupling * kappa[1],
                  law.stiffness[1] * kappa[1] + law.coupling * kappa[0], law.twist * kappa[2]};
  if constexpr (!Of::weave) {
    m[0] += law.oblique[0] * kappa[2], m[1] += law.oblique[1] * kappa[2];
    m[2] += law.oblique[0] * kappa[0] + law.oblique[1] * kappa[1];
  }
  if (tables) add_tables<Of>(law, kappa, m);
  if (tables && law.viscous) add_viscous<Of>(g, group, area, law, kappa, m);
  Vectors h = m[0] * s.second[0] + m[1] * s.second[1] + m[2] * s.second[2];
  SimdFactors f{{(-(area * m[0])) * normal, (-(area * m[1])) * normal, (-(area * m[2])) * normal},
                {none(), none()},
                none()};
  if (in_plane)
    for_families<Of>(law.families, [&](auto a) {
      add_in_plane<Of>(law, s, normal, area, numbers([&](int q) { return g.in_plane[q][a].of; }), a,
                       f, h);
    });
  f.turn = (area * per_size) * (h - dot(h, normal) * normal);
  return f;
}

/// Adds four forces to four nodes.
PLYFORM_INLINE void add_rows(const Rows& r, const std::uint16_t* at, double* force) {
  for (int i = 0; i < simd_width; ++i) {
    double* to = of_node(force, at[i]);
    store(to, load(to) + r.row[i]);
  }
}

/// Limit of slots of groups that are computed together.
constexpr int most_joined_slots = 64;

/// Adds the forces of the first group to its nodes, then those of the second: in the order of one
/// group after the other.
template <bool in_plane>
PLYFORM_INLINE void add_forces(const SimdGroups& g, const SimdFactors& f, const Vectors* d,
                               double* force) {
  Rows second[most_joined_slots];
  Vectors sum = none(), before = d[g.ring - 1];
  for (int i = 0; i < g.slot_count; ++i) {
    Vectors fi = constant<in_plane>(g, i, 0) * f.second[0];
    for (int k = 1; k < 3; ++k)
      add_to(fi, constant<in_plane>(g, i, k), f.second[k]);
    for (int k = 0; k < 2 && in_plane; ++k)
      add_to(fi, constant<in_plane>(g, i, 3 + k), f.first[k]);
    if (i < g.ring) {
      fi = fi + cross(before - d[i + 1 < g.ring ? i + 1 : 0], f.turn);
      before = d[i];
    }
    sum = sum + fi;
    add_rows(rows(fi, 0), g.slots[0] + simd_width * i, force);
    if (g.count == 2) second[i] = rows(fi, 1);
  }
  const Vectors own = none() - sum;
  add_rows(rows(own, 0), g.stencils[0]->own, force);
  if (g.count == 1) return;
  for (int i = 0; i < g.slot_count; ++i)
    add_rows(second[i], g.slots[1] + simd_width * i, force);
  add_rows(rows(own, 1), g.stencils[1]->own, force);
}

/// The group at `first`, and the next if the lanes have room for it and it has as many slots.
template <bool in_plane>
PLYFORM_INLINE SimdGroups groups_at(const BendingKernelBlock& block, int families, int first,
                                    const SimdNumbers* constants, const std::uint16_t* slots) {
  const SimdStencils *p = block.stencils + first, *next = p + 1;
  const bool joined = quads == 2 && first + 1 < block.groups && p->ring == next->ring &&
                      p->slots == next->slots && p->slots <= most_joined_slots;
  SimdGroups g;
  g.ring = p->ring, g.slot_count = p->slots, g.count = joined ? 2 : 1;
  for (int q = 0; q < quads; ++q) {
    const int group = q < g.count ? q : 0;
    g.stencils[q] = p + group;
    g.constants[q] = constants + group * slot_numbers<in_plane> * p->slots;
    g.slots[q] = slots + group * simd_width * p->slots;
    g.in_plane[q] = in_plane ? block.in_plane + families * (first + group) : nullptr;
  }
  return g;
}

/// Takes vectors at the images of a block, four numbers each, to the other side of their planes;
/// with_shift: places, mm, else directions.
PLYFORM_INLINE void mirror_images(const BendingKernelBlock& block, bool with_shift, double* of) {
  for (int i = 0; i < block.image_count; ++i) {
    const KernelMirror& mirror = block.mirrors[block.images[i].mirror];
    double* v = of + 4 * block.images[i].entry;
    double out[3];
    for (int k = 0; k < 3; ++k)
      out[k] = mirror.turn[3 * k] * v[0] + mirror.turn[3 * k + 1] * v[1] +
               mirror.turn[3 * k + 2] * v[2] + (with_shift ? mirror.shift[k] : 0.0);
    for (int k = 0; k < 3; ++k)
      v[k] = out[k];
  }
}

template <class Of, bool in_plane, bool tables>
PLYFORM_INLINE void block_forces(const BendingKernelBlock& block, const BendingKernelLaw& law,
                                 const double* x, double* place) {
  gather_places(block.nodes, block.node_count, x, place);
  mirror_images(block, true, place);
  double* force = &block.force->x;
  for (int i = 0; i < block.node_count; ++i)
    store(force + 4 * i, Double4{});
  Vectors d[most_stencil_slots];
  const SimdNumbers* constants = block.constants;
  const std::uint16_t* slots = block.slots;
  for (int group = 0; group < block.groups;) {
    const SimdGroups g = groups_at<in_plane>(block, law.families, group, constants, slots);
    const SimdShape s = find_shape<in_plane>(g, place, d);
    const SimdFactors f = find_factors<Of, in_plane, tables>(g, group, s, law);
    add_forces<in_plane>(g, f, d, force);
    group += g.count;
    constants += g.count * slot_numbers<in_plane> * g.slot_count;
    slots += g.count * simd_width * g.slot_count;
  }
  mirror_images(block, false, force);
}

PLYFORM_INLINE void bending_kernel(const BendingKernelBlock& block, const BendingKernelLaw& law,
                                   const double* x) {
  alignas(32) double place[4 * most_bending_nodes];
  if (!law.weave)
    law.in_plane ? block_forces<AnyFabric, true, true>(block, law, x, place)
                 : block_forces<AnyFabric, false, true>(block, law, x, place);
  else if (law.table || law.viscous)
    law.in_plane ? block_forces<Weave, true, true>(block, law, x, place)
                 : block_forces<Weave, false, true>(block, law, x, place);
  else
    law.in_plane ? block_forces<Weave, true, false>(block, law, x, place)
                 : block_forces<Weave, false, false>(block, law, x, place);
}

} // namespace

void PLYFORM_COPY_OF(bending_kernel)(const BendingKernelBlock& block, const BendingKernelLaw& law,
                                     const double* x) {
  bending_kernel(block, law, x);
}

} // namespace plyform
