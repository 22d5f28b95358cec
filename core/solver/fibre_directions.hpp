// SPDX-License-Identifier: GPL-3.0-or-later
// How the fibres of plies run at the time of a search, for friction by the angle between them.
#pragma once

#include "base/thread_pool.hpp"
#include "core/solver/layup.hpp"

namespace plyform {

/// Sets PlyCache::fibres, of the first family of each ply, if a law of the case asks for them: at a
/// node the mean of its triangles by their areas.
void note_fibres(Layup& layup, ThreadPool& pool);

} // namespace plyform
