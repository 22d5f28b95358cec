// SPDX-License-Identifier: GPL-3.0-or-later
// Makes the contacts of a scene: their laws, distances and depth limits, from what plies are.
#pragma once

#include "core/model/case.hpp"
#include "core/solver/contact_state.hpp"
#include "core/solver/ply_body.hpp"

#include <vector>

namespace plyform {

/// Half a ply's loss of thickness over pressure, from the curve's first thickness on.
HalfCompaction half_of(const ThicknessCurve& curve);

/// The tool of that index in the case, with its contacts with all plies.
ToolState make_tool(const Case& data, std::size_t index, const std::vector<PlyBody>& plies);

/// The pairs of plies, adjacent ones first, which take longest to compute, and those of a ply with
/// itself last.
std::vector<PlyPair> make_pairs(const Case& data, const std::vector<PlyBody>& plies);

} // namespace plyform
