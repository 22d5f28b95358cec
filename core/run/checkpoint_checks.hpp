// SPDX-License-Identifier: GPL-3.0-or-later
// What a state must satisfy that was loaded from a file, whatever the file's checksum says: a step
// reads and writes arrays by its sizes, indices and counts.
#pragma once

#include "core/run/checkpoint.hpp"

#include <vector>

namespace plyform {

/// Sizes of the arrays of a PlyState as its scene was made, in the order of their list.
using ArraySizes = std::vector<std::size_t>;

std::vector<ArraySizes> sizes_of(const Scene& scene); ///< one per ply

/// Throws std::runtime_error ("does not fit its scene: ...") if a size, an index, a count or a
/// choice is not one that the scene can have, a number is not finite or of the wrong sign, or
/// times, steps and motions contradict each other. made: of the scene before it was loaded.
void check_loaded(const Scene& scene, const RunState& run, const std::vector<ArraySizes>& made);

} // namespace plyform
