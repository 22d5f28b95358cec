// SPDX-License-Identifier: GPL-3.0-or-later
// core/ply/bending.hpp, whose symbols these are, one stencil after the other: what the kernels of
// core/ply/bending_simd.hpp are compared with.
#pragma once

#include "core/ply/bending.hpp"

#include <array>
#include <span>
#include <vector>

namespace plyform {

/// D_g of the families at a node, N mm; none without in-plane bending.
inline std::span<const double> in_plane_at(const Bending& b, std::size_t node) {
  const std::size_t families = b.law.families.size();
  return b.in_plane.empty() ? std::span<const double>()
                            : std::span(b.in_plane).subspan(node * families, families);
}

/// First derivative along a family.
inline Vec3 first_along(const FamilyBending& family, const StencilShape& s) {
  return family.along.x() * s.first[0] + family.along.y() * s.first[1];
}

/// (M)
inline std::array<double, 3> moments(const BendingLaw& law, const std::array<double, 3>& kappa) {
  std::array<double, 3> m{law.coupling * kappa[1], law.coupling * kappa[0], law.twist * kappa[2]};
  for (const FamilyBending& family : law.families) {
    const Vec3 p = family.of_axes();
    const double along = p[0] * kappa[0] + p[1] * kappa[1] + p[2] * kappa[2]; // kappa_f of (K)
    const Vec3 of = family.law.at(along).value * p;
    for (std::size_t k = 0; k < 3; ++k)
      m[k] += of[static_cast<Eigen::Index>(k)];
  }
  return m;
}

/// Adds (I) of one family to the forces on the nodes of a stencil, except for the term of the
/// rotation of the normal: its contribution to h, N/mm, is returned.
inline Vec3 add_in_plane(const Bending& b, const StencilShape& s, std::size_t stencil,
                         std::size_t family, std::vector<Vec3>& force) {
  const FamilyBending& of = b.law.families[family];
  const YarnCurvature t = yarn_curvature(s, of, in_plane_at(b, stencil)[family]);
  const Vec3 turned = t.slope.cross(s.normal), p = of.of_axes();
  for (auto i = static_cast<std::size_t>(b.begin[stencil]);
       i < static_cast<std::size_t>(b.begin[stencil + 1]); ++i) {
    const double second = p[0] * b.b[i][0] + p[1] * b.b[i][1] + p[2] * b.b[i][2];
    const double first = of.along.x() * b.a[i][0] + of.along.y() * b.a[i][1];
    force[b.node[i]] -= b.area[stencil] * t.moment * (second * t.across + first * turned);
  }
  return t.moment * first_along(of, s).cross(t.slope);
}

/// Adds the first term of (F) with these moments to the forces on the nodes of a stencil.
inline void add_along_normal(const Bending& b, std::size_t stencil, const StencilShape& s,
                             const std::array<double, 3>& m, std::vector<Vec3>& force) {
  for (auto i = static_cast<std::size_t>(b.begin[stencil]);
       i < static_cast<std::size_t>(b.begin[stencil + 1]); ++i)
    force[b.node[i]] -=
        b.area[stencil] * (m[0] * b.b[i][0] + m[1] * b.b[i][1] + m[2] * b.b[i][2]) * s.normal;
}

/// Adds the last term of (F), - dN/dx_i . `along`, to the forces on the nodes of a stencil; `along`
/// is A0 h_t / |N|.
inline void add_normal_rotation(const Bending& b, std::span<const Vec3> x, std::size_t stencil,
                                const Vec3& along, std::vector<Vec3>& force) {
  for (auto i = static_cast<std::size_t>(b.fan_begin[stencil]);
       i < static_cast<std::size_t>(b.fan_begin[stencil + 1]); ++i) {
    std::array<std::size_t, 3> n;
    for (std::size_t k = 0; k < 3; ++k)
      n[k] = static_cast<std::size_t>(b.node[b.begin[stencil] + b.fan[i][k]]);
    const Vec3 turn1 = (x[n[2]] - x[n[0]]).cross(along), turn2 = along.cross(x[n[1]] - x[n[0]]);
    force[n[0]] += turn1 + turn2;
    force[n[1]] -= turn1;
    force[n[2]] -= turn2;
  }
}

/// Normal and derivatives at one node. x: mm, one per node.
inline StencilShape stencil_shape(const Bending& b, std::span<const Vec3> x, std::size_t stencil) {
  const auto first = static_cast<std::size_t>(b.begin[stencil]);
  const auto at = [&](std::size_t place) -> const Vec3& { return x[b.node[first + place]]; };
  StencilShape s;
  Vec3 sum = Vec3::Zero(); // N
  for (auto i = static_cast<std::size_t>(b.fan_begin[stencil]);
       i < static_cast<std::size_t>(b.fan_begin[stencil + 1]); ++i) {
    const auto& [p, q, r] = b.fan[i];
    const Vec3& x0 = at(static_cast<std::size_t>(p));
    sum += (at(static_cast<std::size_t>(q)) - x0).cross(at(static_cast<std::size_t>(r)) - x0);
  }
  for (std::size_t i = first; i < static_cast<std::size_t>(b.begin[stencil + 1]); ++i) {
    // differences, so that rounding is relative to the stencil's size
    const Vec3 from = at(i - first) - at(0);
    for (std::size_t k = 0; k < 3; ++k)
      s.second[k] += b.b[i][k] * from;
    for (std::size_t k = 0; k < 2 && !b.in_plane.empty(); ++k)
      s.first[k] += b.a[i][k] * from;
  }
  set_normal(s, sum);
  return s;
}

/// Curvatures (K) kappa_11, kappa_22, kappa_12 (1/mm) at one node. x: mm, one per node.
inline std::array<double, 3> curvatures(const Bending& b, std::span<const Vec3> x, int node) {
  return stencil_shape(b, x, static_cast<std::size_t>(node)).kappa;
}

/// (T), 1/mm, of a family at one node of yarns that bend in their plane. x: mm, one per node.
inline double in_plane_curvature(const Bending& b, std::span<const Vec3> x, int node, int family) {
  const auto n = static_cast<std::size_t>(node);
  const auto yarns = static_cast<std::size_t>(family);
  return yarn_curvature(stencil_shape(b, x, n), b.law.families[yarns], in_plane_at(b, n)[yarns])
      .kappa;
}

/// (F) + (I) on each node, N. x: mm.
inline std::vector<Vec3> reference_bending_forces(const Bending& b, std::span<const Vec3> x) {
  std::vector<Vec3> force(x.size(), Vec3::Zero());
  for (std::size_t n = 0; n < x.size(); ++n) {
    const StencilShape s = stencil_shape(b, x, n);
    const std::array<double, 3> m = moments(b.law, s.kappa);
    add_along_normal(b, n, s, m, force);
    Vec3 h = m[0] * s.second[0] + m[1] * s.second[1] + m[2] * s.second[2];
    for (std::size_t k = 0; k < b.law.families.size() && !b.in_plane.empty(); ++k)
      h += add_in_plane(b, s, n, k, force);
    add_normal_rotation(b, x, n, (b.area[n] / s.size) * (h - h.dot(s.normal) * s.normal), force);
  }
  return force;
}

/// Adds (F) of one stencil with these moments m_11, m_22, m_12 (N) to the forces on all nodes (N).
inline void add_moment_forces(const Bending& b, std::span<const Vec3> x, std::size_t node,
                              const StencilShape& s, const std::array<double, 3>& m,
                              std::vector<Vec3>& force) {
  add_along_normal(b, node, s, m, force);
  const Vec3 h = m[0] * s.second[0] + m[1] * s.second[1] + m[2] * s.second[2];
  add_normal_rotation(b, x, node, (b.area[node] / s.size) * (h - h.dot(s.normal) * s.normal),
                      force);
}

/// (E) + (G) summed over all nodes, N mm. x: mm.
inline double bending_energy(const Bending& b, std::span<const Vec3> x) {
  double sum = 0.0;
  for (std::size_t n = 0; n < b.area.size(); ++n)
    sum += b.area[n] * bending_energy(b.law, in_plane_at(b, n), stencil_shape(b, x, n));
  return sum;
}

} // namespace plyform
