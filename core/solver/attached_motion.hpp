// SPDX-License-Identifier: GPL-3.0-or-later
// Forces of springs and grippers: equations (T), (F) and (G) of core/model/attachment.hpp.
#pragma once

#include "core/solver/force_kinds.hpp"

namespace plyform {

/// Computes the pulls of springs (T), (F) on the plies, after tools have moved, and adds to their
/// work.
void pull_springs(BoundaryForces& of, Layup& layup, const std::vector<ToolState>& tools);

/// Moves the nodes of a gripper as one piece by (G): sets their reactions, and adds to the work of
/// the jaws on the plies. To be called after all other forces.
void move_gripper(Layup& layup, const Attachment& clamp, BoundaryState& state);

/// Adds the row sums of the stiffness of springs and of grippers' drives on the nodes of a ply.
void add_attachment_stiffness(const BoundaryForces& forces, const Layup& layup, std::size_t ply,
                              std::span<ContactRow> rows);

/// Adds to the forces f (N) what springs and drives exert, `factor` times their stiffness, when all
/// nodes are displaced by y (mm); both per ply and node.
void add_attachment_forces(const BoundaryForces& forces, const Layup& layup, double factor,
                           const std::vector<std::vector<Vec3>>& y,
                           std::vector<std::vector<Vec3>>& f);

} // namespace plyform
