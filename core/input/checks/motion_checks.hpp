// SPDX-License-Identifier: GPL-3.0-or-later
// Where tools stand before forming, and where they go: gaps, first contact, extents; and the scenes
// that cannot work because of them.
#pragma once

#include "core/input/checks/initial_scene.hpp"

#include <limits>

namespace plyform {

/// What one tool meets on its way, with all other things where they stand at the start.
struct ToolWay {
  double gap = std::numeric_limits<double>::infinity(); ///< mm, to the closest ply at the start
  std::size_t closest = 0;                              ///< that ply
  /// mm along the direction up to the first touch of a ply; infinite: it passes all of them. Of
  /// tools that move only.
  double travel = std::numeric_limits<double>::infinity();
  std::size_t first = 0; ///< that ply
  Box3 extents{};        ///< mm, of the surface in space; planes as far as `surface` has them
};

/// surface: of the tool, in space. Plies are asked at their nodes, some 500 of each at most, and
/// where points of the surface meet them.
ToolWay way_of(const Tool& tool, const TriMesh& surface, const std::vector<FlatPly>& plies);

} // namespace plyform
