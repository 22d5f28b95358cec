// SPDX-License-Identifier: GPL-3.0-or-later
// Rotation-free bending of a ply: curvatures at a node from the positions of the nodes around it.
// Active only if the fabric has a bending stiffness. Two kinds: out-of-plane bending of the sheet,
// and in-plane bending of the yarns.
//
//   r_1, r_2   mm     lengths along the material axes in the undeformed ply: those of warp and weft
//                     in a weave (MaterialAxes of core/model/fabric.hpp)
//   v_a        -      components of a family's direction in these axes
//   A_a,i      1/mm   first and
//   B_ab,i     1/mm^2 second derivatives at a node from the nodes i of a stencil: dx/dr_a = sum_i
//                     A_a,i x_i, of the nearest quadratic polynomial; d^2 x / dr_a dr_b = sum_i
//                     B_ab,i x_i, the mean over the node's cell (core/ply/curvature_flux.hpp).
//                     Constants, exact for any quadratic shape on any mesh; but on the free edge
//                     the moment across it is zero, and the curvature that goes with it
//   N          mm^2   sum of the area vectors (twice) of the triangles around the node; n = N/|N|
//   A0         mm^2   a third of the undeformed triangles around the node: its cell
//
// Out-of-plane bending, with s_ab = sum_i B_ab,i x_i and, of a family f along v,
// p = (v_1^2, v_2^2, 2 v_1 v_2):
//   kappa_ab   1/mm   n . s_ab;  kappa_f = p_1 kappa_11 + p_2 kappa_22 + p_3 kappa_12          (K)
//   (m_11, m_22, m_12) = sum_f M_f(kappa_f) p
//                        + (D_c kappa_22, D_c kappa_11, D_t kappa_12)               N          (M)
//   E = A0 [ sum_f W_f(kappa_f) + D_c kappa_11 kappa_22 + D_t/2 kappa_12^2 ]                   (E)
//   h = sum_ab m_ab s_ab,  h_t = h - (h . n) n
//   F_i = -A0 [ (sum_ab m_ab B_ab,i) n + dN/dx_i . h_t / |N| ]                                 (F)
//
// In-plane bending, for each family a of yarns by itself (geodesic curvature, per undeformed
// length):
//   d = sum_i A_i x_i,  c = n x d,  l = |c|           d: the yarn's stretched unit length; c lies
//                                                     across it in the sheet
//   A = v_1 A_1 + v_2 A_2,  B = sum_k p_k B_k,  s = sum_i B_i x_i          first and second
//                                                     derivatives along the yarn
//   kappa_g = s . c / l^2                             1/mm, in-plane curvature of the yarn     (T)
//   E = A0 D_g/2 kappa_g^2,  M_g = D_g kappa_g        D_g N mm, in_plane of the fabric         (G)
//   q = s / l^2 - 2 kappa_g c / l^2
//   F_i = -A0 M_g [ B_i c / l^2 + A_i (q x n) ]        and h of (F) has M_g (d x q) more       (I)
//
// (I) is the gradient of (G): d kappa_g = ds . c/l^2 + dc . q, since d(1/l^2) = -2 c . dc / l^4;
// and with dc = dn x d + n x dd it is dc . q = dn . (d x q) + dd . (q x n). The part of s along the
// yarn does not enter (T): a straight yarn that is stretched unevenly has no moment. As n and c are
// orthogonal, (K) and (T) measure independent parts of s.
//
// At a plane of symmetry stencils reach beyond the part that is modelled: their nodes there are
// mirror images of nodes of the part (core/ply/mirrored_sheet.hpp), and what acts on an image acts,
// mirrored, on its node. A node on the plane has its share of A0, a half or a quarter, so that all
// sums are those of the part.
//
// Purpose of (G): a membrane whose energy depends on strains only is a first-gradient continuum;
// where shear jumps its yarns have kinks without energy, and a compressed family zigzags at the
// size of the mesh. (G) is a second-gradient term, as in the pantographic sheets of dell'Isola and
// Steigmann and the woven continua of Madeo, Ferretti, Barbagallo and Boisse. It gives the jump a
// width: next to an edge that clamps the yarns' directions, with n_c Cs' the shear stiffness (N/mm)
// and s the distance,
//   n_c Cs' gamma - D_g gamma'' = const:  gamma(s) = gamma_inf (1 - exp(-s/l)),
//   l = sqrt(D_g / (n_c Cs'))                                                                  (L)
//
// M: moment per width against curvature, linear or by table. The families of a fabric bend
// independently of each other: D_c = 0. An isotropic plate has M = D kappa, D_c = nu D, D_t = 2 (1
// - nu) D, D = E t^3 / (12 (1 - nu^2)), and no in-plane bending. Curvatures are sampled at nodes,
// one sample of each per node, to match the one deflection that each node has. Sampled at
// triangles, a strip whose weft has no stiffness folds between the samples without resistance
// (twice the sag of theory); the same happens if nodes on the free edge take their curvature along
// it from nodes inside. The cells are those of the undeformed ply, since yarn strains are small.
// Sources: rotation-free bending by the nodes around goes back to Phaal and Calladine (1992) and
// Onate and Zarate (2000); plate constants: Timoshenko; geodesic curvature of yarns as a
// strain: Steigmann and dell'Isola (2015).
#pragma once

#include "core/mesh/mesh_blank.hpp"
#include "core/model/fabric.hpp"
#include "core/ply/mirrored_sheet.hpp"

#include <span>
#include <vector>

namespace plyform {

/// Bending of one ply of n nodes, with one stencil (patch of nodes) per node.
struct Bending {
  BendingLaw law;
  std::vector<double> area;        ///< n, A0: a third of the triangles around
  std::vector<std::int32_t> begin; ///< n + 1, into the arrays of stencil nodes
  /// Per stencil: its centre node, then the others; those from n on are `images`.
  std::vector<std::int32_t> node;
  std::vector<std::array<double, 3>> b; ///< B_11, B_22, B_12 of each stencil node
  std::vector<std::array<double, 2>> a; ///< A_1, A_2 likewise; empty without in-plane bending
  /// D_g (N mm) of the families at the first node, at the second ... where (T) is defined, else 0;
  /// empty without in-plane bending.
  std::vector<double> in_plane;
  std::vector<std::int32_t> fan_begin; ///< n + 1, into fan
  std::vector<Triangle> fan; ///< triangles around each node; corners: indices within the stencil
  double omega2 = 0.0; ///< 1/s^2, bound of the largest eigenvalue of M^-1 K in the undeformed shape
  std::vector<ImageNode> images; ///< nodes beyond planes of symmetry
  std::vector<Mirror> mirrors;   ///< of `images`; empty without planes

  /// The node of the ply that a stencil node is, or is an image of.
  std::size_t of_ply(std::int32_t stencil_node) const {
    const auto n = static_cast<std::size_t>(stencil_node);
    return n < area.size() ? n : static_cast<std::size_t>(images[n - area.size()].node);
  }
};

/// Normal and derivatives of the position along the axes at one node.
struct StencilShape {
  Vec3 normal{};
  double size = 0.0;                                                    ///< |N|
  std::array<Vec3, 3> second{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}; ///< s_11, s_22, s_12
  std::array<Vec3, 2> first{Vec3::Zero(), Vec3::Zero()};                ///< along the axes
  std::array<double, 3> kappa{};                                        ///< 1/mm
};

/// Sets normal, size and curvatures (K) of a shape with its second derivatives (1/mm); sum: N,
/// mm^2.
void set_normal(StencilShape& s, const Vec3& sum);

/// In-plane curvature of one family of yarns at one node.
struct YarnCurvature {
  Vec3 across;         ///< c / l^2
  Vec3 slope;          ///< q, 1/mm
  double kappa = 0.0;  ///< 1/mm
  double moment = 0.0; ///< M_g, N
};

/// (T) of a family of yarns whose D_g is `stiffness` (N mm).
YarnCurvature yarn_curvature(const StencilShape& s, const FamilyBending& family, double stiffness);

/// (E) + (G) at one node per area A0, N; in_plane: D_g of the families there, N mm, or none.
double bending_energy(const BendingLaw& law, std::span<const double> in_plane,
                      const StencilShape& s);

/// Fits all stencils (core/ply/bending_fit.hpp) and bounds omega2. x: undeformed positions, mm;
/// node_mass: t, one per node; axis1, axis2: material axes, rad from x; planes: of symmetry.
Bending make_bending(std::span<const Vec2> x, const std::vector<Triangle>& triangles,
                     const BendingLaw& law, double axis1, double axis2,
                     std::span<const double> node_mass,
                     const std::vector<SymmetryPlane>& planes = {});

/// Bound of the largest eigenvalue of M^-1 K, 1/s^2, of (E) + (G) in the undeformed shape, by
/// Lanczos' iteration. node_mass: t, one per node.
double bending_omega2(const Bending& b, std::span<const double> node_mass);

/// Of each stencil the sum of the eigenvalues, 1/s^2, of its own stiffness with the whole masses
/// (t) of its nodes: what it would give without the stencils around, no bound. Coupling does not
/// count.
std::vector<double> stencil_omega2(const Bending& b, std::span<const double> node_mass);

} // namespace plyform
