// SPDX-License-Identifier: GPL-3.0-or-later
// Bending of a ply without rotations as unknowns: curvatures at a node from the places of the nodes
// around it. Off unless the fabric has it. Two kinds: out of the sheet, and of yarns in the sheet.
//
//   r_1, r_2   mm     lengths along warp and weft in the unformed ply
//   A_a,i      1/mm   first and
//   B_ab,i     1/mm^2 second derivatives of the quadratic polynomial through (or nearest to) the
//                     nodes i of a stencil: dx/dr_a = sum_i A_a,i x_i, d^2 x / dr_a dr_b =
//                     sum_i B_ab,i x_i; constants. Exact for any quadratic shape, whatever the
//                     mesh, but for the rim, where only what is along it counts (the moment across
//                     a free edge is zero)
//   N          mm^2   sum of the area vectors (twice) of the triangles around the node; n = N/|N|
//   A0         mm^2   a third of the unformed triangles around the node
//
// Out of the sheet, s_ab = sum_i B_ab,i x_i:
//   kappa_ab   1/mm   n . s_ab                                                                 (K)
//   m_1 = M_1(kappa_11) + D_c kappa_22,  m_2 likewise,  m_12 = D_t kappa_12         N          (M)
//   E = A0 [ W_1(kappa_11) + W_2(kappa_22) + D_c kappa_11 kappa_22 + D_t/2 kappa_12^2 ]        (E)
//   h = sum_ab m_ab s_ab,  h_t = h - (h . n) n
//   F_i = -A0 [ (sum_ab m_ab B_ab,i) n + dN/dx_i . h_t / |N| ]                                 (F)
//
// In the sheet, for each family a of yarns by itself (geodesic curvature, per unformed length):
//   d = sum_i A_a,i x_i,  c = n x d,  l = |c|         d: the yarn's stretched unit length; c lies
//                                                     across it in the sheet
//   kappa_g = s_aa . c / l^2                          1/mm, how the yarn turns in the sheet    (T)
//   E = A0 D_g/2 kappa_g^2,  M_g = D_g kappa_g        D_g N mm, in_plane of the fabric         (G)
//   q = s_aa / l^2 - 2 kappa_g c / l^2
//   F_i = -A0 M_g [ B_aa,i c / l^2 + A_a,i (q x n) ]   and h of (F) has M_g (d x q) more       (I)
//
// (I) is the gradient of (G): d kappa_g = ds . c/l^2 + dc . q, since d(1/l^2) = -2 c . dc / l^4;
// and with dc = dn x d + n x dd it is dc . q = dn . (d x q) + dd . (q x n). The part of s along the
// yarn does not enter (T): a straight yarn that is stretched unevenly has no moment. n and c are at
// right angles: what (K) has, (T) has not.
//
// What (G) means: membranes that know only strains are of first gradient; where shear jumps, yarns
// have kinks that cost nothing, and a pressed family zigzags at the size of the mesh. (G) is a term
// of second gradient, as in the pantographic sheets of dell'Isola and Steigmann and the woven
// continua of Madeo, Ferretti, Barbagallo and Boisse. It gives the jump a width: next to an edge
// that holds the yarns' directions, with n_c Cs' the shear stiffness (N/mm) and s the distance,
//   n_c Cs' gamma - D_g gamma'' = const:  gamma(s) = gamma_inf (1 - exp(-s/l)),
//   l = sqrt(D_g / (n_c Cs'))                                                                  (L)
//
// M: moment per width against curvature, linear or by table. A fabric's yarns bend by themselves:
// D_c = 0. An isotropic plate has M = D kappa, D_c = nu D, D_t = 2 (1 - nu) D, D = E t^3 / (12
// (1 - nu^2)), and no yarns to bend in its plane. Why at nodes: one sample of each curvature a node
// is what one deflection a node can answer; sampled at triangles, a strip whose weft is limp folds
// between them without resistance (twice the sag of theory); so it does where the rim takes its
// curvature from the inside. The polynomial is fitted in the unformed ply, since the stretch of
// yarns is small. Sources: rotation-free bending by fits over neighbours goes back to Phaal and
// Calladine (1992) and Onate and Zarate (2000); plate constants: Timoshenko; geodesic curvature of
// yarns as a strain: Steigmann and dell'Isola (2015).
#pragma once

#include "core/mesh/mesh_blank.hpp"
#include "core/model/fabric.hpp"

#include <span>
#include <vector>

namespace plyform {

/// Bending of one ply of n nodes: a stencil a node.
struct Bending {
  BendingLaw law;
  std::vector<double> area;                    ///< n, A0: a third of the triangles around
  std::vector<std::int32_t> begin;             ///< n + 1, into the arrays of stencil nodes
  std::vector<std::int32_t> node;              ///< the stencil's own first, then those around it
  std::vector<std::array<double, 3>> b;        ///< B_11, B_22, B_12 of each stencil node
  std::vector<std::array<double, 2>> a;        ///< A_1, A_2 likewise, if yarns bend in the sheet
  std::vector<std::array<double, 2>> in_plane; ///< n, D_g of warp and weft where (T) is known, else
                                               ///< 0; empty if yarns do not bend in the sheet
  std::vector<std::int32_t> fan_begin;         ///< n + 1, into fan
  std::vector<Triangle> fan;                   ///< triangles around, as places within the stencil
  double omega2 = 0.0; ///< 1/s^2, bound of the largest eigenvalue of M^-1 K, shape as unformed
};

/// Fits all stencils (core/ply/bending_fit.hpp). `node_mass` in t; warp and weft: directions in
/// rad.
Bending make_bending(std::span<const Vec2> x, const std::vector<Triangle>& triangles,
                     const BendingLaw& law, double warp, double weft,
                     std::span<const double> node_mass);

/// Curvatures kappa_11, kappa_22, kappa_12 at one node.
std::array<double, 3> curvatures(const Bending& b, std::span<const Vec3> x, int node);

/// (T) of the warp (family 0) or weft (1) at one node; asks for D_g of either.
double in_plane_curvature(const Bending& b, std::span<const Vec3> x, int node, int family);

/// (F) + (I) on each node, N, one stencil after the other: the oracle of core/ply/bending_simd.hpp.
std::vector<Vec3> reference_bending_forces(const Bending& b, std::span<const Vec3> x);

/// (E) + (G) over all nodes, N mm.
double bending_energy(const Bending& b, std::span<const Vec3> x);

} // namespace plyform
