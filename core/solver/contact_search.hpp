// SPDX-License-Identifier: GPL-3.0-or-later
// The contact search (broad phase), which the step loop calls when motion has used up the skin.
#pragma once

#include "base/thread_pool.hpp"
#include "core/solver/scene.hpp"

namespace plyform {

/// Updates displacements since the last search and path lengths of plies and tools; to be called
/// once per step. Returns whether the pairs of the last search are still valid: nothing has moved
/// by more than half the skin. False also if a position is not finite.
bool track_displacements(Scene& scene);

/// ToolState::path_length (mm) plus what a pushed tool may still move in this step.
double path_length_ahead(const Scene& scene, const ToolState& tool);

/// Largest displacement (mm) of any ply or tool since the last search; NaN if a position is not
/// finite.
double largest_displacement(const Scene& scene);

/// Computes PlyCache::fold_bound anew.
void renew_fold_bounds(PlyBody& ply);

/// Lists every pair of nodes and tools, nodes and faces, and edges within contact distance + skin.
/// Until something has moved by half the skin no other pair can touch.
void search_contacts(Scene& scene, ThreadPool& pool);

} // namespace plyform
