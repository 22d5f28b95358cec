// SPDX-License-Identifier: GPL-3.0-or-later
// A whole simulation: from a case to its last state, with outputs on the way.
#pragma once

#include "core/mesh/mesh_blank.hpp"
#include "core/model/case.hpp"
#include "core/results/result_writer.hpp"

#include <atomic>
#include <functional>

namespace plyform {

struct Scene; // core/solver/scene.hpp

/// Where a run stands, for a progress line.
struct Progress {
  double fraction = 0.0; ///< of the simulated time
  double stroke_mm = 0.0;
  long step = 0;
  double elapsed_s = 0.0, remaining_s = 0.0; ///< wall time
  double kinetic_over_shear = 0.0;
  double balance_error = 0.0;
};

struct RunHooks {
  std::function<void(const Frame&)> frame;       ///< each output state, the first and last included
  std::function<void(const Progress&)> progress; ///< several times a second at most
  const std::atomic<bool>* interrupt = nullptr;  ///< set it to end the run early
};

struct RunResult {
  Frame last;      ///< the last good state
  Summary summary; ///< status: done, doubtful, interrupted, stopped
};

/// Forms the plies. Stops early, with the last good state, when a value is not finite, an element
/// collapses, a ply goes through another or the energy balance error passes its limit. meshes: as
/// of make_scene.
RunResult run_case(const Case& data, int threads, const RunHooks& hooks,
                   const std::vector<BlankMesh>& meshes = {});

/// The same from a scene of make_scene, whose plies may have been given another start: positions
/// (PlyState::x, and x0 where boundaries hold them) and velocities. The scene is left in the last
/// good state, with its contacts as of the last step computed.
RunResult run_scene(Scene& scene, int threads, const RunHooks& hooks);

} // namespace plyform
