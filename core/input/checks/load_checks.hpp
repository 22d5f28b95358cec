// SPDX-License-Identifier: GPL-3.0-or-later
// Loads between two plies: whether these enclose anything.
#pragma once

#include "core/input/checks/initial_scene.hpp"
#include "core/input/checks/source_location.hpp"

namespace plyform {

/// Reports loads between two plies whose borders do not lie over each other, or that lie far apart.
/// A border may be off by what its mesh needs, an eighth of a side (the sagitta of a chord on a
/// radius of one element), and by the mean thickness of the two; the open strip between them may be
/// a tenth as high as the smaller ply is wide, as in a frame with a spacer.
void check_loads(const Case& scene, const CaseParts& parts, std::span<const FlatPly> plies,
                 Diagnostics& diagnostics);

} // namespace plyform
