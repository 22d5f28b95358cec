// SPDX-License-Identifier: GPL-3.0-or-later
// How deep flat triangles cut into tools between their nodes: contact with tools is at nodes only.
//
//   L  mm  side of a triangle;  t  mm  thickness of the ply;  r  mm  radius of the tool's curve
//   R = r + t/2, on which the mid-surface would lie;  2a  rad  turn of the ply round that curve
// A chord of the circle, or from one straight flank to the other where the arc is shorter, passes
// nearer to the tool than the mid-surface should by
//   c = R - sqrt(R^2 - L^2/4)             while L <= 2 R sin a;  L^2/(8 R) for L << R         (1)
//   c = L/2 tan a - R (1/cos a - 1)       beyond: the arc's middle lies that far above it     (2)
// and a sharp edge is r = 0, so R = t/2. (2) is worst where the chord is symmetric to the edge, and
// is measured down from the edge; the nearest surface, a flank, is nearer by cos a. On a surface
// curved both ways the middle of a triangle can lie L/sqrt(3) from all its nodes (Jung's circle),
// so that 2 L/sqrt(3) takes the place of L. c > t/2: the mid-surface itself goes inside.
#pragma once

#include "core/solver/scene.hpp"

#include <string>
#include <vector>

namespace plyform {

/// Longest side of the ply's triangles now, mm.
double longest_side(const PlyState& ply);

/// (1), (2): c in mm. side, radius, thickness in mm; half_turn: a, rad, above 0 and below pi/2.
double cut_between_nodes(double side, double radius, double thickness, double half_turn);

/// The longest side (mm) whose cut is half a thickness.
double side_of_half_cut(double radius, double thickness, double half_turn);

/// How deep one ply is in one tool, as they stand now, by the measure of contact: half the
/// thickness minus the distance of the mid-surface.
struct ToolCut {
  std::string tool, ply;
  double depth = 0.0;     ///< mm, the largest, nodes included; 0 if they do not touch
  double thickness = 0.0; ///< mm, of the ply
};

/// Every tool, meshes included, with every ply. Each triangle is asked at the 15 points whose
/// weights are multiples of 1/4 and then, where its tangent plane to the tool lets it be deeper
/// than the deepest point so far, divided until that is known to a hundredth of a thickness. This
/// is exact for tools that are convex where the ply meets them, and where they are hollow; what can
/// be missed is a spike of a tool with hollows round it that is narrower than a quarter of a side.
std::vector<ToolCut> cuts_between_nodes(const Scene& scene);

/// The largest depth (mm) of them, 0 if there is none.
double deepest(const std::vector<ToolCut>& cuts);

} // namespace plyform
