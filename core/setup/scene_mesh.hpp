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
  double scout_work = 0.0;     ///< triangles times steps
  double scout_seconds = 0.0;  ///< wall time
  double triangles = 0.0;      ///< of all plies
  double smallest = 0.0, largest = 0.0; ///< mm, sides of the squares of two triangles
  std::string warning;                  ///< of an accuracy that is out of reach; else empty
};

/// Gives the plies of `prepared` that ask for it sizes and meshes; its identity tells the sizes, a
/// note what was done. known: the folder of a run that goes on, whose sizes hold, or nothing. What
/// is wrong with a file of sizes is added to its errors. Throws std::runtime_error if the scout is
/// stopped by a fault, saying where and when.
SceneMesh mesh_from_scene(PreparedCase& prepared, int threads, const ScoutHooks& hooks = {},
                          const std::filesystem::path& known = {});

} // namespace plyform
