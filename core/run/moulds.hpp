// SPDX-License-Identifier: GPL-3.0-or-later
// Closed moulds: tools that close on each other with plies between. A mould is closed once its
// tools somewhere leave less room than 1.2 times the thickness of all plies.
#pragma once

#include "core/solver/scene.hpp"

#include <vector>

namespace plyform {

/// Two tools with plies between, the first of which presses towards the second.
struct Mould {
  std::size_t from = 0, to = 0;
};

struct Moulds {
  bool any = false;          ///< whether some close by the end of the run
  std::vector<Mould> pairs;  ///< of tools that may close on each other, once each
  std::vector<Mould> closed; ///< those that are closed now, both ways
};

/// surfaces: of the tools, mm, where they were at the start.
Moulds moulds_of(const Scene& scene, const std::vector<TriMesh>& surfaces);

} // namespace plyform
