// SPDX-License-Identifier: GPL-3.0-or-later
// What is said of a run that has ended: its summary, with the reasons to doubt it.
#pragma once

#include "core/run/checkpoint.hpp"
#include "core/run/run.hpp"

namespace plyform {

/// Fills the summary of a run whose scene is in its last good state. last: the last state of what
/// is modelled; result.last is what is shown of it.
void finish(const Scene& s, const RunState& state, const Frame& last, RunResult& result,
            ThreadPool& pool, double elapsed);

} // namespace plyform
