// SPDX-License-Identifier: GPL-3.0-or-later
// What a state must satisfy that was loaded from a file, whatever the file's checksum says: a step
// reads and writes arrays by its sizes, indices and counts.
#pragma once

#include "core/solver/checkpoint.hpp"

#include <vector>

namespace plyform {

/// Sizes of arrays of a ply that its scene was made with and that nothing else of it tells.
struct PlyArrays {
  std::size_t reaction, last_lambda, last_viscous, viscosity;
};

std::vector<PlyArrays> arrays_of(const Scene& scene);

/// Throws std::runtime_error ("does not fit its scene: ...") if a size, an index, a count or a
/// choice is not one that the scene can have, a number is not finite or of the wrong sign, or
/// times, steps and motions contradict each other. made: of the scene before it was loaded.
void check_loaded(const Scene& scene, const RunState& run, const std::vector<PlyArrays>& made);

} // namespace plyform
