// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes that the scene asks for: blanks whose mesh_from is "scene" get the element sizes that a
// scout finds (core/setup/scout.hpp), others those of a run before.
#pragma once

#include "core/results/size_file.hpp"
#include "core/setup/prepare_case.hpp"
#include "core/setup/scout.hpp"

namespace plyform {

/// What was found, for the user.
struct SceneMesh {
  std::vector<PlySizes> sizes; ///< of the plies whose meshes they are; empty: no ply asks for any
  bool scouted = false;        ///< not read from a file
  bool kept = false;           ///< a scout's of before
  double scout_work = 0.0;     ///< triangles times steps
  double scout_seconds = 0.0;  ///< wall time
  double triangles = 0.0;      ///< of all plies
  double smallest = 0.0, largest = 0.0; ///< mm, sides of the squares of two triangles
  std::vector<std::string> warnings;    ///< of an accuracy out of reach, and of a scout's budget
  bool unknown = false;                 ///< sizes are asked for that only a scout would find
};

/// Where sizes may come from.
struct MeshRequest {
  std::filesystem::path known = {}; ///< the folder of a run that goes on, whose sizes hold
  bool kept = false;                ///< take those kept from before, and keep those found
  bool scouts = true;               ///< else plies for which that is needed are left as they are
  ScoutHooks scout = {};
};

/// A scout that did not go to its end, where and when.
struct ScoutStopped : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Gives the plies of `prepared` that ask for it sizes and meshes; its identity tells the sizes, a
/// note what was done. What is too large for a case of sensible size is added to its errors, and it
/// has no value then. Throws ScoutStopped, and std::runtime_error if a file of sizes cannot be
/// used.
SceneMesh mesh_from_scene(PreparedCase& prepared, int threads, const MeshRequest& request = {});

} // namespace plyform
