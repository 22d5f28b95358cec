// SPDX-License-Identifier: GPL-3.0-or-later
// How plies fold between contact searches: what contact between plies must know at every step.
#pragma once

#include "base/thread_pool.hpp"
#include "core/solver/scene.hpp"

namespace plyform {

/// Follows the folds of all plies through the last step: renews their bounds
/// (contact/search/fold_bound.hpp) when sides may have turned by as much as those allow for, finds
/// ridges (contact/search/sheet_ridges.hpp), and searches for what new ones are near. searched:
/// whether bounds and ridges were found in this step.
void follow_folds(Layup& layup, PlyContacts& contacts, ThreadPool& pool, bool searched);

} // namespace plyform
