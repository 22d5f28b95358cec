// SPDX-License-Identifier: GPL-3.0-or-later
// Detection of nodes that have passed through a ply or tool, or have penetrated beyond recovery.
//
// Contact forces act on the overlap at the end of a step. A node that moves by more than the
// contact distance in one step can come out on the other side, where it has no contact force.
//
//   r    mm  motion of a node in this step relative to the point it is closest to now
//   u    mm  from that point to the node now;  n = u / |u|
//   it was on the other side before the step if (u - r) . n < 0, i.e. r . n > |u|            (P)
#pragma once

#include "core/solver/force_kinds.hpp"

namespace plyform {

/// Upper bound of the relative displacement (mm) of a node of the slave and one of the master in
/// this step: the sum of the largest displacements of both.
double step_displacement(const Layup& layup, const PlyContact& pair);

/// Largest displacement (mm) of any node of a ply in this step; the second one relative to a tool.
double step_displacement(const Layup& layup, int ply);
double step_displacement(const Layup& layup, int ply, const ToolState& tool);

/// A node that passed through another ply or a tool within the last step, by (P) or the reversal of
/// the tool's normal, or lies deeper in a tool than its contact law is valid. To be called after
/// contact search and forces.
std::optional<Stop> find_pass_through(const Layup& layup, const std::vector<ToolState>& tools,
                                      const PlyContacts& contacts);

} // namespace plyform
