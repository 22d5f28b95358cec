// SPDX-License-Identifier: GPL-3.0-or-later
// What a run must keep to go on later with the same bits: everything that changes from step to step
// and is not computed anew in every step.
#pragma once

#include "base/archive.hpp"
#include "core/model/energies.hpp"
#include "core/results/summary.hpp"
#include "core/run/astray_forces.hpp"
#include "core/run/densest_packing.hpp"
#include "core/run/dwell.hpp"
#include "core/solver/scene.hpp"

#include <string>

namespace plyform {

/// The last good state of a run: what is written if the run has to stop. Of contacts the deepest
/// penetrations only: all their points would take a fifth more memory.
struct Snapshot {
  std::vector<PlyState> plies;
  std::vector<ToolMotion> tool_motions;
  std::vector<ToolLoad> tool_loads;
  std::vector<BoundaryState> boundaries;
  ElementState elements;
  SceneProgress progress;
  Energies energy;
  double tool_penetration = 0.0, ply_penetration = 0.0; ///< mm, the deepest
};

template <class F>
void each_member(Snapshot& good, F&& f) {
  auto& [plies, tool_motions, tool_loads, boundaries, elements, progress, energy, tool_penetration,
         ply_penetration] = good;
  f("plies", plies);
  f("tool_motions", tool_motions);
  f("tool_loads", tool_loads);
  f("boundaries", boundaries);
  f("elements", elements);
  f("progress", progress);
  f("energy", energy);
  f("tool_penetration", tool_penetration);
  f("ply_penetration", ply_penetration);
}

/// Keeps the present state of the scene, with its energies.
void keep(const Scene& scene, const Energies& energy, Snapshot& snapshot);

/// Takes plies with all that their laws remember, tools, boundaries and progress back to it;
/// contacts stay as they were last.
void restore(Scene& scene, const Snapshot& snapshot);

/// Of a run between two steps, after move_plies.
struct RunState {
  Snapshot good;
  Energies energy; ///< last computed
  Dwell dwell;
  std::vector<KnownForce> known_forces; ///< core/run/pressed_stack.hpp
  std::vector<AstrayForce> astray;      ///< core/run/astray_forces.hpp
  std::vector<Overpacked> packing;      ///< core/run/densest_packing.hpp
  int outputs_written = -1;
  double elapsed = 0.0; ///< s of wall time
};

template <class F>
void each_member(RunState& run, F&& f) {
  auto& [good, energy, dwell, known_forces, astray, packing, outputs_written, elapsed] = run;
  f("good", good);
  f("energy", energy);
  f("dwell", dwell);
  f("known_forces", known_forces);
  f("astray", astray);
  f("packing", packing);
  f("outputs_written", outputs_written);
  f("elapsed", elapsed);
}

/// The bytes of scene and run.
std::string save_state(const Scene& scene, const RunState& run);

/// Loads what save_state saved into the scene of the same case, as make_scene made it. The bytes
/// are not trusted (core/run/checkpoint_checks.hpp): throws std::runtime_error if they do not
/// fit the scene, which is of no use then.
void load_state(const std::string& bytes, Scene& scene, RunState& run);

/// The first member of the scene that differs from the bytes of save_state, as "plies.0.velocity";
/// empty if none does.
std::string first_difference(const Scene& scene, const std::string& bytes);

/// Hash of what save_state keeps of the scene: the same if a run goes on from it with the same
/// bits.
std::uint64_t state_hash(const Scene& scene);

} // namespace plyform
