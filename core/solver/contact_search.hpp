// SPDX-License-Identifier: GPL-3.0-or-later
// Who may touch whom: the contact search that the step loop calls when motion has used up the skin.
#pragma once

#include "core/base/thread_pool.hpp"
#include "core/solver/scene.hpp"

namespace plyform {

/// Brings ways and paths of plies and tools up to date, once a step. Returns whether the pairs of
/// the last search still do: nothing has moved by half the skin. False too if a position is not
/// finite.
bool track_displacements(Scene& scene);

/// mm, ToolState::path with what a pushed tool may still go in this step.
double path_length_ahead(const Scene& scene, const ToolState& tool);

/// The largest of those ways, mm; NaN if a position is not finite.
double largest_displacement(const Scene& scene);

/// Renews what has been used up of PlyState::spread.
void update_fold_bounds(Scene& scene, ThreadPool& pool);

/// Lists every pair within contact distance + skin. Until something has moved by half the skin no
/// other pair can touch.
void search_contacts(Scene& scene, ThreadPool& pool);

} // namespace plyform
