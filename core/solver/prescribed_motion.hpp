// SPDX-License-Identifier: GPL-3.0-or-later
// Reaction forces of nodes with prescribed motion, and of those in grippers.
#pragma once

#include "core/solver/force_kinds.hpp"

namespace plyform {

/// Computes (R) and (L) of core/model/boundary.hpp, and (G) of core/model/attachment.hpp. To be
/// called after all other forces.
void prescribe_nodes(BoundaryForces& of, Layup& layup);

} // namespace plyform
