// SPDX-License-Identifier: GPL-3.0-or-later
// The contact search (broad phase), which the step loop calls when motion has used up the skin.
#pragma once

#include "base/thread_pool.hpp"
#include "core/solver/scene.hpp"

namespace plyform {

/// Computes PlyCache::fold_bound anew.
void renew_fold_bounds(PlyBody& ply);

/// Lists every pair of nodes and tools, nodes and faces, and edges within contact distance + skin.
/// Until something has moved by half the skin no other pair can touch.
void search_contacts(Scene& scene, ThreadPool& pool);

} // namespace plyform
