// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/resting.hpp"

#include "core/model/motion.hpp"
#include "core/solver/displacements.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plyform {
namespace {

bool is_as_it_began(const PlyBody& ply) {
  return ply.x == ply.x0 && std::all_of(ply.velocity.begin(), ply.velocity.end(),
                                        [](const Vec3& v) { return v.isZero(0.0); });
}

template <class Points>
bool any_closed(const Points& points) {
  return std::any_of(points.begin(), points.end(),
                     [](const auto& c) { return latest_gap(c) < 0.0; });
}

/// Whether a tool that moves is near a ply, or one presses it.
bool tool_is_near(const Case& data, const std::vector<ToolState>& tools, std::size_t p) {
  for (std::size_t t = 0; t < tools.size(); ++t) {
    const ToolPlyContact& contact = tools[t].contacts[p];
    const bool moves = data.tools[t].motion != Motion::fixed;
    if (moves ? !contact.points.empty() : any_closed(contact.points)) return true;
  }
  return false;
}

/// mm, the longest that a tool may still go from where it is.
double way_left(const Layup& layup, const ToolState& state, const Tool& tool) {
  const double end = (1.0 + layup.data.solver.dwell) * layup.data.solver.duration;
  if (tool.motion == Motion::force)
    return state.body.max_approach_speed * std::max(end - layup.time, 0.0);
  if (tool.motion == Motion::fixed) return 0.0;
  const double now = motion_at(tool, layup.time, layup.data.solver.duration);
  double left = tool.programme.empty() ? std::abs(tool.stroke - now) : 0.0;
  for (const Stage& stage : tool.programme)
    left = std::max(left, std::abs(stage.value - now));
  return left;
}

bool is_far(const Layup& layup, const ToolState& tool, const Tool& model) {
  double gap = std::numeric_limits<double>::infinity(); // mm, at least, to any ply
  for (std::size_t p = 0; p < layup.plies.size(); ++p) {
    const ToolPlyContact& contact = tool.contacts[p];
    if (!contact.points.empty()) return false;
    const double path = path_length_ahead(tool, layup.dt) + layup.plies[p].path_length;
    for (const float free : contact.free)
      gap = std::min(gap, double{free} - path);
  }
  // plies move by half a skin until the next search, and by one more step
  return gap > way_left(layup, tool, model) + layup.skin;
}

} // namespace

void find_far_tools(const Layup& layup, std::vector<ToolState>& tools) {
  for (std::size_t t = 0; t < tools.size(); ++t)
    tools[t].far = is_far(layup, tools[t], layup.data.tools[t]);
}

void find_resting(Layup& layup, const std::vector<ToolState>& tools, const PlyContacts& contacts) {
  for (std::size_t p = 0; p < layup.plies.size(); ++p) {
    PlyBody& ply = layup.plies[p];
    ply.resting = ply.left_alone && is_as_it_began(ply) && !tool_is_near(layup.data, tools, p);
  }
  bool news = true; // what is woken may wake others
  while (news) {
    news = false;
    for (const PlyPair& pair : contacts.ply_pairs) {
      PlyBody &a = layup.plies[pair.a], &b = layup.plies[pair.b];
      if (!a.resting && !b.resting) continue;
      const bool both = a.resting && b.resting;
      const auto wakes = [&](const PlyContact& pass) {
        const auto& points = pass.contact.points;
        return both ? any_closed(points) : !points.empty();
      };
      const bool edges_wake = !both && !pair.edges.contact.groups.empty();
      if (!edges_wake && std::none_of(pair.passes.begin(), pair.passes.end(), wakes)) continue;
      a.resting = b.resting = false;
      news = true;
    }
  }
}

} // namespace plyform
