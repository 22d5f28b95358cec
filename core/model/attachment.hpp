// SPDX-License-Identifier: GPL-3.0-or-later
// Springs and grippers: what pulls at some nodes of a ply without prescribing where they are.
//
//   w_j   -     share of node j, sum 1: of the length of the edge on which it lies (half the gaps
//   to
//               its neighbours), or of the area in the box
//   c     mm    sum of w_j x_j, where a spring hangs;  a  mm  its anchor;  l = |a - c|
//   l0, ln  mm  length of a spring at the start, and without a load;  k  N/mm  its stiffness
//   r     -     share of the preload that has come up (core/model/motion.hpp)
//
// Spring, with T0 = max(0, k (l0 - ln)), its tension at the start:
//   T   = k (l - ln) - (1 - r) T0, from 0 to Tmax                                            (T)
//   F_j = w_j T (a - c) / l,  on node j                                                      (F)
// As ln >= 0, T <= k l, and no eigenvalue of its stiffness is above that of k alone.
//
// Gripper: its nodes move as one piece, without turning, x_j = X_j + g:
//   (m + sum of m_j) g'' = sum of F_j + P e                                                  (G)
// with F_j all other forces on node j of mass m_j, m its own mass, e its direction, and P its
// force, or k (d - g . e) of a drive that has moved by d. Where planes of symmetry hold nodes of
// it, or it is guided along e, (G) holds along the directions that are left.
#pragma once

#include "core/model/case.hpp"

#include <span>
#include <vector>

namespace plyform {

struct AttachedNode {
  int ply = 0, node = 0;
  double share = 0.0; ///< w_j
};

/// The nodes of a spring or gripper.
struct Attachment {
  int boundary = 0;                ///< index into Case::boundaries
  std::vector<AttachedNode> nodes; ///< ascending by ply and node
  Vec3 start = Vec3::Zero();       ///< mm, c before forming
  double length = 0.0;             ///< mm, l0 of a spring
  double natural_length = 0.0;     ///< mm, ln; not positive if the preload asks for that
  std::vector<Vec3> held;          ///< orthogonal unit vectors along which a gripper cannot move
};

/// A ply before forming, mm.
struct SheetBefore {
  std::span<const Vec3> x0;
  std::span<const Triangle> triangles;
};

/// The nodes and lengths of boundary number `index`, a spring or gripper; without nodes if it holds
/// none of any ply.
Attachment attach(const std::vector<Boundary>& boundaries, std::size_t index,
                  const std::vector<SheetBefore>& plies);

/// (T), N, of a spring that is `length` mm long; `risen`: r.
double spring_tension(const TensionSpring& spring, const Attachment& attached, double length,
                      double risen);

} // namespace plyform
