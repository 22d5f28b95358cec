// SPDX-License-Identifier: GPL-3.0-or-later
// What `plyform check` says of a mould that closes on plies of which only some give way.
#pragma once

#include "base/thread_pool.hpp"
#include "core/setup/outlook_plies.hpp"

namespace plyform {

/// A line that starts with "    warning: ", where tools will close on plies that have a compaction
/// beside others that have none.
void describe_compaction(const Scene& s, ThreadPool& pool, Lines& lines);

} // namespace plyform
