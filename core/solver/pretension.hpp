// SPDX-License-Identifier: GPL-3.0-or-later
// The pre-tension of stitches comes up over the start of a run: there at once, it would throw a ply
// that it shears, and friction would hold it where it swings to. The strain at which a stitch
// becomes taut goes from 0 to its own, taut_at < 0, by smooth_step. At a fixed shape that changes
// what stitches store; the difference is work done from outside, PlyState::law_work, of each step
// the mean of the places at its begin and at its end.
#pragma once

#include "base/thread_pool.hpp"
#include "core/solver/layup.hpp"

namespace plyform {

/// Gives stitches the pre-tension of the present time, and counts its work since
/// SceneProgress::tightened_until. Asked again at the same time it adds nothing.
void raise_pretension(Layup& layup, const std::vector<Block>& group_blocks, ThreadPool& pool);

} // namespace plyform
