// SPDX-License-Identifier: GPL-3.0-or-later
// Internal to contact/: how far a tool pushed by a force moves in a step, (B) of
// contact/forces/tool_ply.hpp.
#pragma once

#include "contact/forces/tool_ply.hpp"

#include <span>

namespace plyform {

/// Solves (B) for delta (mm) within the limits of the approach speed and of the remaining depth of
/// the contacts, whose gaps and normals have been measured. dt: s, above 0.
double equilibrium_motion(const ToolBody& tool, std::span<const ToolPlyContact> contacts,
                          std::span<const SurfaceKinematics> plies, double dt);

} // namespace plyform
