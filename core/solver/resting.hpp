// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that have no part in the motion until the next contact search: what is chosen for all
// (time step, masses added, when to search) is not chosen by them.
//
//   resting  a ply that nothing may move (core/model/reach_ahead.hpp), still where and as it began,
//            with nothing near it but what rests too; it is not integrated
//   far      a tool that no ply can meet before the next search: its gap to all of them is wider
//            than the rest of its way
#pragma once

#include "core/solver/force_kinds.hpp"

namespace plyform {

/// Sets PlyState::resting, after a search.
void find_resting(Layup& layup, const std::vector<ToolState>& tools, const PlyContacts& contacts);

/// Sets ToolState::far, after a search.
void find_far_tools(const Layup& layup, std::vector<ToolState>& tools);

} // namespace plyform
