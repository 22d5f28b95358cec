// SPDX-License-Identifier: GPL-3.0-or-later
// The step that is taken: the stable one, or a shorter one where contacts close.
#pragma once

#include "core/base/thread_pool.hpp"
#include "core/solver/scene.hpp"

namespace plyform {

/// The stable step anew: core/solver/stable_time_step.hpp.
void renew_stable_step(Scene& scene, ThreadPool& pool);

/// Whether a contact is deeper than the stable step counts with.
bool contacts_deepened(const Scene& scene);

/// The next step: the stable one, or a shorter one in which no contact closes by more than half of
/// the room that it has left.
void set_step(Scene& scene);

} // namespace plyform
