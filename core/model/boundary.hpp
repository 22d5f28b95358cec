// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes whose motion is given: rigid grips, hinged frames, planes of symmetry; and the forces that
// hold them.
//
//   X   mm  place of a node before forming;  d  mm  displacement of grip or frame, 0 to stroke
//   grip:      x = X + d direction
//   frame:     X = P0 + s (P1 - P0) + t (P3 - P0), hinges P0 .. P3;  x = P0 + s u(d) + t v(d),
//              |u|, |v| the lengths of the bars, u + v = (D0 + d) e, e along P0 P2, D0 = |P2 - P0|
//   symmetry:  (x - X) . n = 0
//
// A node is held along one to three axes e at right angles to each other. The force that does it,
//   R . e = m (v_(i+1/2) - v_(i-1/2)) . e / (1/2 (dt_(i-1) + dt_i)) - F . e                    (R)
// with v_(i+1/2) = (x(t + dt_i) - x_i) / dt_i and F all other forces, stands beside contact forces
// in the step, which so needs no other rule. The load of grip or frame is the force conjugate to d,
//   L = sum over its nodes of R . dx/dd                                                        (L)
#pragma once

#include "core/model/case.hpp"

#include <span>
#include <vector>

namespace plyform {

/// A node that is held: `count` axes (unit vectors at right angles), each by a boundary.
struct PrescribedNode {
  int ply = 0, node = 0, count = 0;
  std::array<Vec3, 3> axis = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  std::array<int, 3> boundary{}; ///< index into Case::boundaries
};

/// Whether a boundary holds a node that lies at `X` (mm) in the unformed ply number `ply`.
bool holds(const Boundary& boundary, int ply, const Vec2& X);

/// Place (mm) of a held node when the displacement is d (mm).
Vec3 prescribed_position(const Boundary& boundary, const Vec3& X, double d);

/// dx/dd of a held node at displacement d.
Vec3 prescribed_slope(const Boundary& boundary, const Vec3& X, double d);

/// Longest stroke (mm) that the bars of a frame allow: D0 + stroke < sum of two bars.
double longest_stroke(const Boundary& frame);

/// The held nodes of one ply with nodes `x0` (mm), by number. Axes of a later boundary that an
/// earlier one holds already are left out; grips and frames go before planes of symmetry.
std::vector<PrescribedNode> prescribed_nodes(const std::vector<Boundary>& boundaries, int ply,
                                             std::span<const Vec3> x0);

} // namespace plyform
