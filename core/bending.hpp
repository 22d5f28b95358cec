// SPDX-License-Identifier: GPL-3.0-or-later
// Bending of a ply without rotations as unknowns: curvatures of a triangle from the places of its
// own nodes and those of its neighbours. Off unless the fabric has it.
//
//   r_1, r_2   mm    lengths along warp and weft in the unformed ply
//   B_ab,n     1/mm^2 second derivatives of the quadratic polynomial through (or nearest to) the
//                    nodes n of the patch: d^2 x / dr_a dr_b = sum_n B_ab,n x_n; exact for any
//                    quadratic shape, whatever the mesh; constants
//   n          -     unit normal of the triangle now
//   kappa_ab   1/mm  n . sum_n B_ab,n x_n                                                      (K)
//   m_1 = M_1(kappa_11) + D_c kappa_22,  m_2 likewise,  m_12 = D_t kappa_12         N          (M)
//   E = A0 [ W_1(kappa_11) + W_2(kappa_22) + D_c kappa_11 kappa_22 + D_t/2 kappa_12^2 ]        (E)
//   h = sum_ab m_ab sum_n B_ab,n x_n,  h_t = h - (h . n) n
//   F_n = -A0 [ (sum_ab m_ab B_ab,n) n + dn/dx_n . h_t ]                                       (F)
//
// M: moment per width against curvature, linear or by table. A fabric's yarns bend by themselves:
// D_c = 0. An isotropic plate has M = D kappa, D_c = nu D, D_t = 2 (1 - nu) D, D = E t^3 / (12
// (1 - nu^2)). Rotation-free bending triangles go back to Phaal and Calladine (1992) and Onate and
// Zarate (2000); the polynomial is fitted here in the unformed ply, since the stretch of yarns is
// small.
#pragma once

#include "core/blank.hpp"
#include "core/fabric.hpp"

#include <span>
#include <vector>

namespace plyform {

/// Bending of one ply of n nodes and m triangles.
struct Bending {
  BendingLaw law;
  std::vector<Triangle> triangles;                ///< m
  std::vector<double> area;                       ///< m, A0
  std::vector<std::int32_t> begin;                ///< m + 1, into the arrays of patch nodes
  std::vector<std::int32_t> node;                 ///< those of the triangle first
  std::vector<std::array<double, 3>> b;           ///< B_11, B_22, B_12 of each patch node
  std::vector<Vec3> force;                        ///< (F), N, of each patch node
  std::vector<std::int32_t> gather_begin, gather; ///< n + 1, and into `force`, ascending
  double omega2 = 0.0; ///< 1/s^2, bound of the largest eigenvalue of M^-1 K, shape as unformed
};

/// Fits all patches. `triangles` in the order that forces are wanted in; `node_mass` in t; warp and
/// weft: directions in rad. Patches grow by further neighbours where six nodes do not fix a
/// quadratic (at the rim).
Bending make_bending(std::span<const Vec2> x, const std::vector<Triangle>& triangles,
                     const BendingLaw& law, double warp, double weft,
                     std::span<const double> node_mass);

/// Curvatures kappa_11, kappa_22, kappa_12 of one triangle.
std::array<double, 3> curvatures(const Bending& b, std::span<const Vec3> x, int triangle);

/// (F) for triangles [begin, end), into b.force.
void bending_forces(Bending& b, std::span<const Vec3> x, int begin, int end);

/// Force on a node, N, from all patches that it belongs to, in fixed order.
Vec3 bending_force(const Bending& b, int node);

/// (E) over all triangles, N mm.
double bending_energy(const Bending& b, std::span<const Vec3> x);

} // namespace plyform
