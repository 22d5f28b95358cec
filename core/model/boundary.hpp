// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes whose motion is prescribed: rigid grips, hinged frames, planes of symmetry; and their
// reaction forces. Springs and grippers, which prescribe none: core/model/attachment.hpp.
//
//   X   mm  position of a node before forming;  d  mm  displacement of grip or frame, 0 to stroke
//   grip:      x = X + d direction
//   frame:     X = P0 + s (P1 - P0) + t (P3 - P0), hinges P0 .. P3;  x = P0 + s u(d) + t v(d),
//              |u|, |v| the lengths of the bars, u + v = (D0 + d) e, e along P0 P2, D0 = |P2 - P0|
//   symmetry:  (x - X) . n = 0
//
// A node is prescribed along one to three orthogonal axes e. Its reaction force,
//   R . e = m (v_(i+1/2) - v_(i-1/2)) . e / (1/2 (dt_(i-1) + dt_i)) - F . e                    (R)
// with v_(i+1/2) = (x(t + dt_i) - x_i) / dt_i and F all other forces, enters the time step like a
// contact force, so that prescribed nodes are integrated as all others. The load of grip or frame
// is the force conjugate to d,
//   L = sum over its nodes of R . dx/dd                                                        (L)
#pragma once

#include "core/model/case.hpp"

#include <span>
#include <vector>

namespace plyform {

/// A node prescribed along `count` axes (orthogonal unit vectors), each by one boundary.
struct PrescribedNode {
  int ply = 0, node = 0, count = 0;
  std::array<Vec3, 3> axis = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  std::array<int, 3> boundary{}; ///< index into Case::boundaries
};

/// Whether a boundary prescribes where its nodes are.
inline bool prescribes(const Boundary& b) {
  return !b.is<TensionSpring>() && !b.is<Gripper>();
}

/// Whether which nodes boundaries hold depends on the mesh: not that of planes of symmetry, at
/// which blanks end.
bool hold_by_mesh(const std::vector<Boundary>& boundaries);

/// mm, of grips, frames and the drives of grippers; else 0.
double stroke_of(const Boundary& boundary);

/// N, of a gripper that is pulled by one; else 0.
double force_of(const Boundary& boundary);

/// Of stroke or force; empty if it is one stage, or the kind has none.
std::span<const Stage> programme_of(const Boundary& boundary);

/// Where a grip, spring or gripper holds its ply; else null.
const HeldPlace* place_of(const Boundary& boundary);

/// Whether a boundary has a node at `X` (mm) in the undeformed ply number `ply`.
bool holds(const Boundary& boundary, int ply, const Vec2& X);

/// Position (mm) of a prescribed node at displacement d (mm); of a node of a gripper that has gone
/// that far along its direction.
Vec3 prescribed_position(const Boundary& boundary, const Vec3& X, double d);

/// dx/dd (-) of a prescribed node at displacement d (mm).
Vec3 prescribed_slope(const Boundary& boundary, const Vec3& X, double d);

/// Longest stroke (mm) that the bars of a frame allow: D0 + stroke < sum of two bars.
double longest_stroke(const HingedFrame& frame);

/// The prescribed nodes of one ply with undeformed positions `x0` (mm), ascending. Axes that an
/// earlier boundary prescribes already are not prescribed again; grips and frames precede planes of
/// symmetry. Nodes of grippers are not among them: these move with their gripper.
std::vector<PrescribedNode> prescribed_nodes(const std::vector<Boundary>& boundaries, int ply,
                                             std::span<const Vec3> x0);

} // namespace plyform
