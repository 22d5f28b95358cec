// SPDX-License-Identifier: GPL-3.0-or-later
// The search for pairs of edges, and when it is due: with every contact search, and when an edge
// has become a ridge since (contact/search/sheet_ridges.hpp).
#pragma once

#include "core/base/thread_pool.hpp"
#include "core/solver/scene.hpp"

namespace plyform {

/// Lists every pair of ridges of two plies within contact distance + skin. moved: mm, what their
/// nodes together have moved by since the last contact search.
void search_edges(Scene& scene, PlyEdgeContact& pair, double moved);

/// Follows patches and ridges of all plies through the last step, and searches the edges of those
/// that have new ridges. searched: whether ridges were found in this step.
void follow_edges(Scene& scene, ThreadPool& pool, bool searched);

} // namespace plyform
