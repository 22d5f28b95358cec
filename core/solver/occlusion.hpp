// SPDX-License-Identifier: GPL-3.0-or-later
// Which nodes of a ply need not be compared with another: those that the ply in between covers, and
// in self-contact those where the ply is not folded.
#pragma once

#include "core/solver/contact_state.hpp"
#include "core/solver/layup.hpp"

#include <span>

namespace plyform {

/// Self-contact: faces within this many thicknesses of a node in the undeformed ply are its
/// neighbours and form no contact. The nose of a hairpin fold is pi / 2 thicknesses long, and shear
/// by 60 degrees, which brings nodes together to 0.37 of their distance, must not count as contact.
constexpr double neighbourhood = 3.0;

/// Whether the plies of a contact are adjacent in the stack.
bool neighbours(const PlyContact& pair);

/// Marks the slave's nodes that the master occludes from the plies beyond it: their gap to it is
/// less than half the contact distance and none of their faces is at its boundary edge, so that no
/// third ply fits in between.
void mark_occluded(const Layup& layup, PlyBody& slave, const PlyContact& pair,
                   const PlyBody& master);

/// Per node of the slave whether it cannot touch the master, as an adjacent ply occludes it or, in
/// self-contact, its ply is not folded there; empty: every node may. reach: mm, up to which
/// distance from the master it is asked.
std::span<const char> occluded_nodes(const Layup& layup, int slave_ply, int master_ply,
                                     double reach);

/// Whether two boxes are within `reach` (mm) of each other.
bool may_meet(Box3 a, const Box3& b, double reach);

} // namespace plyform
