// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/results/way_to_tool.hpp"

#include <cmath>
#include <limits>

namespace plyform {

double way_to_tool(const ToolBody& tool, const Vec3& x, const Vec3& d, double most) {
  constexpr int most_steps = 200; // of a line that grazes the surface
  const double near = 1e-3 * most;
  SurfaceHint hint;
  double gone = 0.0, free = distance_to_tool(tool, x, hint).distance;
  const bool inside = free < 0.0;
  for (int i = 0; i < most_steps && std::abs(gone) < most; ++i) {
    if (inside ? free >= 0.0 : free <= near) return gone;
    gone += inside ? std::min(free, -near) : free;
    free = distance_to_tool(tool, x + gone * d, hint).distance;
  }
  return std::abs(gone) < most ? gone : std::numeric_limits<double>::infinity();
}

} // namespace plyform
