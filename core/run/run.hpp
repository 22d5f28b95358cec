// SPDX-License-Identifier: GPL-3.0-or-later
// A whole simulation: from a case to its last state, with output of states in between.
#pragma once

#include "core/mesh/mesh_blank.hpp"
#include "core/model/case.hpp"
#include "core/results/result_writer.hpp"

#include <atomic>
#include <functional>

namespace plyform {

struct Scene; // core/solver/scene.hpp

/// Progress of a run, for display.
struct Progress {
  double fraction = 0.0; ///< of the simulated time
  double stroke_mm = 0.0;
  long step = 0;
  double elapsed_s = 0.0, remaining_s = 0.0; ///< wall time; 0 remain while that is not known
  double kinetic_over_shear = 0.0;
  double balance_error = 0.0;
};

struct RunHooks {
  /// save(state) is called every `interval` seconds of wall time, and once when the run is
  /// interrupted: bytes from which the same case goes on with the same bits, on this machine and
  /// with this build.
  struct Checkpoint {
    std::function<void(const std::string& state)> save;
    double interval = 60.0; ///< s
  };
  /// reached(number, scene, state) at the first step at or after each number / count of the
  /// duration, 1 to count; state() gives the bytes of Checkpoint::save.
  struct Marks {
    int count = 0;
    std::function<void(int number, const Scene& scene, const std::function<std::string()>& state)>
        reached;
  };
  /// Of those who watch: between two steps, where asked() says so, drawn(frame) gets what is there.
  /// asked is called at each step. Tools of more than 100 000 facets have no surface there: copied
  /// for each picture it would take longer than all the rest.
  struct Watch {
    std::function<bool()> asked;
    std::function<void(const Frame&)> drawn;
  };
  std::function<void(const Frame&)> frame; ///< each output state, the first and last included
  /// The scene at each output but the last, if that is all that is wanted: no Frame is made there.
  std::function<void(const Scene&)> glance;
  std::function<void(const Progress&)> progress; ///< several times a second at most
  const std::atomic<bool>* interrupt = nullptr;  ///< set it to end the run early
  Checkpoint checkpoint;
  Marks marks;
  Watch watch;
  const Resume* resume = nullptr; ///< null: from the start
};

struct RunResult {
  Frame last;      ///< the last good state
  Summary summary; ///< status: done, doubtful, interrupted, stopped
};

/// Runs a case. Stops early, with the last good state, if a value is not finite, an element
/// collapses, a ply passes through another or a tool, or the energy balance error exceeds its
/// limit. threads >= 1. meshes: as of make_scene. Throws std::runtime_error as make_scene, and if
/// hooks.resume is not of this case.
RunResult run_case(const Case& data, int threads, const RunHooks& hooks,
                   const std::vector<BlankMesh>& meshes = {});

/// The same from a scene of make_scene, whose plies may have been given other initial positions
/// (PlyBody::x, and x0 where boundaries prescribe them) and velocities. The scene is left in the
/// last good state, but its contacts in that of the last step computed.
RunResult run_scene(Scene& scene, int threads, const RunHooks& hooks);

} // namespace plyform
