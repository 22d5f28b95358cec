// SPDX-License-Identifier: GPL-3.0-or-later
// How near tools come to each other on their way, beside what lies between them.
#pragma once

#include "core/input/checks/initial_scene.hpp"

#include <vector>

namespace plyform {

/// A tool with points of its surface (mm, in space, as at the start) and its way.
struct ToolOnItsWay {
  const Tool* tool = nullptr; ///< null: it cannot be drawn
  std::vector<Vec3> points;
  const std::vector<Vec3>* shifts = nullptr; ///< mm, at the times asked; null: not known
};

/// The least distance of two tools above or below the plies.
struct ToolSpacing {
  std::size_t a = 0, b = 0;
  double gap = 0.0;          ///< mm; below 0: one is in the other
  std::size_t time = 0;      ///< when: number of the shift
  Vec3 where = Vec3::Zero(); ///< mm, on one of the surfaces, then
  double stack = 0.0;        ///< mm, of the plies that cover this place as they lie
};

/// Of each pair of which one moves and the ways of both are known. Asked are some thousand points
/// of either surface: what is narrower than what lies between them may be nearer.
std::vector<ToolSpacing> tool_spacings(const std::vector<ToolOnItsWay>& tools,
                                       const std::vector<FlatPly>& plies);

} // namespace plyform
