// SPDX-License-Identifier: GPL-3.0-or-later
// Diagnosis of a run: computing time by kind of work and pair of bodies, and which effects its
// model could leave out or lacks.
#pragma once

#include "core/results/result_writer.hpp"
#include "core/solver/scene.hpp"

namespace plyform {

/// The report on a scene in its last state and its last frame.
WorkReport report_work(const Scene& scene, const Frame& last);

} // namespace plyform
