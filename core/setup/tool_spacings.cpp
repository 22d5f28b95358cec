// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/setup/tool_spacings.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

constexpr std::size_t most_asked = 5000;

bool moves(const ToolOnItsWay& tool) {
  return std::any_of(tool.shifts->begin(), tool.shifts->end(),
                     [&](const Vec3& shift) { return shift != tool.shifts->front(); });
}

/// Numbers of shifts at which the way of two tools to each other begins, turns or ends: between
/// them the distance of each point to a plane changes one way only.
std::vector<std::size_t> turns(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  constexpr double bend = 1e-9; // mm
  std::vector<std::size_t> times = {0};
  const auto step = [&](std::size_t k) { return Vec3((a[k] - a[k - 1]) - (b[k] - b[k - 1])); };
  for (std::size_t k = 1; k + 1 < a.size(); ++k) {
    const Vec3 before = step(k), after = step(k + 1);
    const bool on = before.dot(after) > (1.0 - 1e-6) * before.norm() * after.norm();
    if (!on && std::max(before.norm(), after.norm()) > bend) times.push_back(k);
  }
  if (a.size() > 1) times.push_back(a.size() - 1);
  return times;
}

/// Takes the nearest point of a to b at this time into `least`.
void look(const ToolOnItsWay& a, const ToolOnItsWay& b, std::size_t time,
          const Eigen::AlignedBox2d& area, ToolSpacing& least) {
  const std::size_t stride = std::max<std::size_t>(1, a.points.size() / most_asked);
  const Vec3 &by = (*a.shifts)[time], &other = (*b.shifts)[time];
  SurfaceHint hint;
  LastDistance last;
  for (std::size_t i = 0; i < a.points.size(); i += stride) {
    const Vec3 x = a.points[i] + by;
    if (!area.contains(x.head<2>())) continue;
    if (last.at_least(x) >= least.gap) continue;
    const double gap = tool_distance(*b.tool, other, x, hint);
    last = {x, gap};
    if (gap >= least.gap) continue;
    least.gap = gap;
    least.time = time;
    least.where = x;
  }
}

} // namespace

std::vector<ToolSpacing> tool_spacings(const std::vector<ToolOnItsWay>& tools,
                                       const std::vector<FlatPly>& plies) {
  std::vector<ToolSpacing> spacings;
  Eigen::AlignedBox2d area;
  for (const FlatPly& ply : plies)
    area.extend(ply.bounds);
  const auto known = [](const ToolOnItsWay& t) { return t.tool && t.shifts && !t.shifts->empty(); };
  for (std::size_t a = 0; a < tools.size(); ++a)
    for (std::size_t b = a + 1; b < tools.size(); ++b) {
      if (!known(tools[a]) || !known(tools[b]) || (!moves(tools[a]) && !moves(tools[b]))) continue;
      ToolSpacing least{a, b, std::numeric_limits<double>::infinity(), 0, Vec3::Zero(), 0.0};
      for (const std::size_t time : turns(*tools[a].shifts, *tools[b].shifts)) {
        look(tools[a], tools[b], time, area, least);
        look(tools[b], tools[a], time, area, least);
      }
      if (!std::isfinite(least.gap)) continue;
      for (const FlatPly& ply : plies)
        if (covers(ply, least.where.head<2>())) least.stack += 2.0 * ply.half;
      spacings.push_back(least);
    }
  return spacings;
}

} // namespace plyform
