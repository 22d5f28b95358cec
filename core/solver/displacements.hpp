// SPDX-License-Identifier: GPL-3.0-or-later
// How far bodies have gone since the last contact search, and since the start.
#pragma once

#include "core/solver/contact_state.hpp"
#include "core/solver/layup.hpp"

namespace plyform {

/// Updates displacements since the last search and path lengths of plies and tools; to be called
/// once per step. Returns whether the pairs of the last search are still valid: nothing has moved
/// by more than half the skin. False also if a position is not finite.
bool track_displacements(Layup& layup, std::vector<ToolState>& tools);

/// ToolState::path_length (mm) plus what a pushed tool may still move in this step.
double path_length_ahead(const ToolState& tool, double dt);

/// Largest displacement (mm) of any ply or tool since the last search; NaN if a position is not
/// finite.
double largest_displacement(const Layup& layup, const std::vector<ToolState>& tools);

} // namespace plyform
