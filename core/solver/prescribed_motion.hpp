// SPDX-License-Identifier: GPL-3.0-or-later
// Reaction forces of nodes with prescribed motion.
#pragma once

#include "core/solver/scene.hpp"

namespace plyform {

/// Computes (R) and (L) of core/model/boundary.hpp for all boundaries. To be called after all other
/// forces.
void prescribe_nodes(Scene& scene);

} // namespace plyform
