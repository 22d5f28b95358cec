// SPDX-License-Identifier: GPL-3.0-or-later
// The time step that is taken: the stable one, or a shorter one while contacts close.
#pragma once

#include "base/thread_pool.hpp"
#include "core/solver/scene.hpp"

namespace plyform {

/// Updates SceneProgress::stable_dt (core/solver/stable_time_step.hpp) and the contacts'
/// renew_depth.
void renew_stable_step(Scene& scene, ThreadPool& pool);

/// The same with the rows (core/solver/contact_rows.hpp) of those pairs of plies computed anew that
/// have deepened: enough between updates that motion or time ask for.
void renew_deepened_step(Scene& scene, ThreadPool& pool);

/// Whether a contact is deeper than the depth that the stable time step was computed for.
bool contacts_deepened(const Scene& scene);

/// Sets SceneProgress::next_dt: the stable time step, or a shorter one in which, at its present
/// speed, no contact uses more than its share of its remaining depth (ContactTotals::step_ratio).
void set_step(Scene& scene);

} // namespace plyform
