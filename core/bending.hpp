// SPDX-License-Identifier: GPL-3.0-or-later
// Bending of a ply without rotations as unknowns: curvatures at a node from the places of the nodes
// around it. Off unless the fabric has it.
//
//   r_1, r_2   mm     lengths along warp and weft in the unformed ply
//   B_ab,i     1/mm^2 second derivatives of the quadratic polynomial through (or nearest to) the
//                     nodes i of a patch: d^2 x / dr_a dr_b = sum_i B_ab,i x_i; constants. Exact
//                     for any quadratic shape, whatever the mesh, but for the rim, where only the
//                     curvature along it counts (the moment across a free edge is zero)
//   N          mm^2   sum of the area vectors (twice) of the triangles around the node; n = N/|N|
//   kappa_ab   1/mm   n . sum_i B_ab,i x_i                                                     (K)
//   m_1 = M_1(kappa_11) + D_c kappa_22,  m_2 likewise,  m_12 = D_t kappa_12         N          (M)
//   E = A0 [ W_1(kappa_11) + W_2(kappa_22) + D_c kappa_11 kappa_22 + D_t/2 kappa_12^2 ]        (E)
//   h = sum_ab m_ab sum_i B_ab,i x_i,  h_t = h - (h . n) n
//   F_i = -A0 [ (sum_ab m_ab B_ab,i) n + dN/dx_i . h_t / |N| ]                                 (F)
//
// M: moment per width against curvature, linear or by table. A fabric's yarns bend by themselves:
// D_c = 0. An isotropic plate has M = D kappa, D_c = nu D, D_t = 2 (1 - nu) D, D = E t^3 / (12
// (1 - nu^2)). Why at nodes: one sample of each curvature a node is what one deflection a node can
// answer; sampled at triangles, a strip whose weft is limp folds between them without resistance
// (twice the sag of theory); so it does where the rim takes its curvature from the inside. The
// polynomial is fitted in the unformed ply, since the stretch of yarns is small. Sources:
// rotation-free bending by fits over neighbours goes back to Phaal and Calladine (1992) and Onate
// and Zarate (2000); plate constants: Timoshenko.
#pragma once

#include "core/blank.hpp"
#include "core/fabric.hpp"

#include <span>
#include <vector>

namespace plyform {

/// Bending of one ply of n nodes: a patch a node.
struct Bending {
  BendingLaw law;
  std::vector<double> area;                       ///< n, A0: a third of the triangles around
  std::vector<std::int32_t> begin;                ///< n + 1, into the arrays of patch nodes
  std::vector<std::int32_t> node;                 ///< the patch's own first, then those around it
  std::vector<std::array<double, 3>> b;           ///< B_11, B_22, B_12 of each patch node
  std::vector<Vec3> force;                        ///< (F), N, of each patch node
  std::vector<std::int32_t> fan_begin;            ///< n + 1, into fan
  std::vector<Triangle> fan;                      ///< triangles around, as places within the patch
  std::vector<std::int32_t> gather_begin, gather; ///< n + 1, and into `force`, ascending
  double omega2 = 0.0; ///< 1/s^2, bound of the largest eigenvalue of M^-1 K, shape as unformed
};

/// Fits all patches. `node_mass` in t; warp and weft: directions in rad. Patches grow by further
/// neighbours where those around the node do not fix a quadratic.
Bending make_bending(std::span<const Vec2> x, const std::vector<Triangle>& triangles,
                     const BendingLaw& law, double warp, double weft,
                     std::span<const double> node_mass);

/// Curvatures kappa_11, kappa_22, kappa_12 at one node.
std::array<double, 3> curvatures(const Bending& b, std::span<const Vec3> x, int node);

/// (F) of the patches of nodes [begin, end), into b.force.
void bending_forces(Bending& b, std::span<const Vec3> x, int begin, int end);

/// Force on a node, N, from all patches that it belongs to, in fixed order.
Vec3 bending_force(const Bending& b, int node);

/// (E) over all nodes, N mm.
double bending_energy(const Bending& b, std::span<const Vec3> x);

} // namespace plyform
