// SPDX-License-Identifier: GPL-3.0-or-later
// What a run must keep to go on later with the same bits: everything that changes from step to step
// and is not computed anew in every step.
#pragma once

#include "core/base/archive.hpp"
#include "core/model/energies.hpp"
#include "core/results/summary.hpp"
#include "core/solver/astray_forces.hpp"
#include "core/solver/dwell.hpp"
#include "core/solver/scene.hpp"

#include <string>

namespace plyform {

/// The last good state of a run: what is written if the run has to stop.
struct Snapshot {
  std::vector<PlyKinematics> plies;
  std::vector<Vec3> tool_displacement, tool_force;
  std::vector<ForceFilter> tool_filter;
  std::vector<BoundaryState> boundaries;
  Energies energy;
  double tool_penetration = 0.0, ply_penetration = 0.0; ///< mm, the deepest
  double time = 0.0;                                    ///< s
  long step = 0;
};

/// Of a run between two steps, after move_plies.
struct RunState {
  Snapshot good;
  Energies energy; ///< last computed
  Dwell dwell;
  std::vector<KnownForce> known_forces; ///< core/solver/pressed_stack.hpp
  std::vector<AstrayForce> astray;      ///< core/solver/astray_forces.hpp
  int outputs_written = -1;
  double elapsed = 0.0; ///< s of wall time
};

/// The bytes of scene and run.
std::string save_state(Scene& scene, RunState& run);

/// Loads what save_state saved into the scene of the same case, as make_scene made it. The bytes
/// are not trusted (core/solver/checkpoint_checks.hpp): throws std::runtime_error if they do not
/// fit the scene, which is of no use then.
void load_state(const std::string& bytes, Scene& scene, RunState& run);

} // namespace plyform
