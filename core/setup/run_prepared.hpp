// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a prepared case, and says in its summary what was prepared.
#pragma once

#include "core/run/run.hpp"
#include "core/setup/prepare_case.hpp"

namespace plyform {

/// run_case of the case and its meshes, or run_instant if it asks for that; the summary tells the
/// coarsening, and the notes as what was assumed. Throws as run_case.
RunResult run_prepared(const PreparedCase& prepared, int threads, const RunHooks& hooks);

/// The same of a scene that was made of it, by run_scene; plies alone do without it.
RunResult run_prepared(const PreparedCase& prepared, Scene& scene, int threads,
                       const RunHooks& hooks);

} // namespace plyform
