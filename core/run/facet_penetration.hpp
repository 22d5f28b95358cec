// SPDX-License-Identifier: GPL-3.0-or-later
// Penetration of tools by flat triangles between their nodes, as contact with tools acts at nodes
// only.
//
//   L  mm  side of a triangle;  t  mm  thickness of the ply;  r  mm  radius of the tool's curve
//   R = r + t/2, on which the mid-surface would lie;  2a  rad  wrap angle of the ply round it
// A chord of the circle, or from one straight flank to the other if the arc is shorter, passes
// closer to the tool than the mid-surface should by
//   c = R - sqrt(R^2 - L^2/4)             while L <= 2 R sin a;  L^2/(8 R) for L << R         (1)
//   c = L/2 tan a - R (1/cos a - 1)       beyond: the arc's middle lies that far above it     (2)
// and a sharp edge is r = 0, so R = t/2. (2) is for the worst case, a chord symmetric to the edge,
// and measured from the edge; the distance to the closest surface, a flank, is cos a times that. On
// a doubly curved surface the middle of a triangle can lie L/sqrt(3) from all its nodes (Jung's
// circle), so that 2 L/sqrt(3) replaces L. With c > t/2 the mid-surface itself penetrates the tool.
#pragma once

#include "base/thread_pool.hpp"
#include "core/solver/scene.hpp"

#include <string>
#include <vector>

namespace plyform {

/// Depth of one ply in one tool at their present positions: half the thickness minus the distance
/// of the mid-surface, as in contact; of a fabric with compaction, which gives way to its densest
/// packing, half of what is left then.
struct ToolCut {
  std::string tool, ply;
  double depth = 0.0;     ///< mm, the largest, nodes included; 0 if they do not touch
  double thickness = 0.0; ///< mm, of the ply
};

/// Depths of every ply in every tool, mesh tools included. Each triangle is evaluated at the 15
/// points whose weights are multiples of 1/4; then, where the tangent plane of the tool allows it
/// to be deeper than the deepest point so far, it is divided until that is decided to a hundredth
/// of a thickness. This is exact where the tool is convex, and where it is concave; it can miss a
/// spike with hollows around it that is narrower than a quarter of a side.
std::vector<ToolCut> cuts_between_nodes(const Scene& scene, ThreadPool& pool);

/// The largest depth (mm) of all cuts, 0 if there is none.
double deepest(const std::vector<ToolCut>& cuts);

} // namespace plyform
