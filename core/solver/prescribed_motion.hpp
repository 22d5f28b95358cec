// SPDX-License-Identifier: GPL-3.0-or-later
// The forces that hold nodes where boundaries want them.
#pragma once

#include "core/solver/scene.hpp"

namespace plyform {

/// (R) and (L) of core/model/boundary.hpp for all boundaries, after all other forces are known.
void prescribe_nodes(Scene& scene);

} // namespace plyform
