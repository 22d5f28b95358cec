// SPDX-License-Identifier: GPL-3.0-or-later
// The search for pairs of edges, and when it is due: with every contact search, and when an edge
// has become a ridge since (contact/search/sheet_ridges.hpp).
#pragma once

#include "core/base/thread_pool.hpp"
#include "core/solver/scene.hpp"

namespace plyform {

/// Lists every pair of ridges of two plies within contact distance + skin.
void search_edges(const Scene& scene, PlyEdgeContact& pair);

/// Follows patches and ridges of all plies through the last step, and searches for what new ridges
/// are near. searched: whether ridges were found in this step.
void follow_edges(Scene& scene, ThreadPool& pool, bool searched);

} // namespace plyform
