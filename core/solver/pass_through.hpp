// SPDX-License-Identifier: GPL-3.0-or-later
// What moves so fast, or lies so deep, that contact forces cannot keep it apart.
//
// Forces act on what overlaps at the end of a step. A node that goes further than that in one step
// can come out on the other side; it has then no force and looks sound.
//
//   r    mm  motion of a node in this step relative to the point it is closest to now
//   u    mm  from that point to the node now;  n = u / |u|
//   it was on the other side before the step if (u - r) . n < 0, i.e. r . n > |u|            (P)
#pragma once

#include "core/solver/step.hpp"

namespace plyform {

/// Longest way (mm) that a node of the slave and one of the master went together in this step.
double step_displacement(const Scene& scene, const PlyContact& pair);

/// Longest way (mm) of a node of a ply in this step; the same of a ply and a tool.
double step_displacement(const Scene& scene, int ply);
double step_displacement(const Scene& scene, int ply, const ToolState& tool);

/// A node that went through another ply or a tool within the last step, or lies deeper than half a
/// thickness below a tool's surface. After contact search and forces.
std::optional<Stop> find_pass_through(const Scene& scene);

} // namespace plyform
