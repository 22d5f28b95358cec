// SPDX-License-Identifier: GPL-3.0-or-later
// What `plyform check` says of boundaries.
#pragma once

#include "core/solver/scene.hpp"

#include <string>
#include <vector>

namespace plyform {

/// Lines: kind, nodes and motion of each boundary, with notes. The scene must have started.
std::vector<std::string> boundaries_ahead(const Scene& scene);

} // namespace plyform
