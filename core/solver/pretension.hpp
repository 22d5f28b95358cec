// SPDX-License-Identifier: GPL-3.0-or-later
// The pre-tension of stitches comes up over the start of a run: there at once, it would throw a ply
// that it shears, and friction would hold it where it swings to. The strain at which a stitch
// becomes taut goes from 0 to its own, taut_at < 0, by smooth_step. At a fixed shape that changes
// what stitches store; the difference is work done from outside.
#pragma once

#include "base/thread_pool.hpp"
#include "core/solver/scene.hpp"

namespace plyform {

/// Gives stitches the pre-tension of a time, s.
void set_pretension(Scene& s, double time);

/// Adds what stitches store more by the pre-tension of this step than by that of the step before to
/// PlyCache::last_load_work: the mean of the places at its begin and at its end.
void add_pretension_work(Scene& s, ThreadPool& pool);

} // namespace plyform
