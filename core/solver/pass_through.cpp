// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/pass_through.hpp"

#include "base/format.hpp"
#include "core/solver/follow_thickness.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {

double step_displacement(const Layup& layup, int ply) {
  double step2 = 0.0;
  for (std::size_t b = 0; b < layup.node_blocks.size(); ++b)
    if (layup.node_blocks[b].ply == ply) step2 = std::max(step2, layup.node_sums[b].step2);
  return std::sqrt(step2);
}

namespace {

std::string when_and_who(const Layup& layup, std::size_t ply, int node) {
  return fmt::format("stopped at step {}, time {:.6g} s: ply {}, node {}", layup.step, layup.time,
                     layup.plies[ply].name, node);
}

std::optional<Stop> find_pass_through(const Layup& layup, const PlyContact& pair) {
  // A node cannot pass unless it moves by more than 2/3 of what the contact law keeps at least,
  // h/2.
  const double least = least_distance(layup, pair.contact);
  if (!(step_displacement(layup, pair) > 2.0 / 3.0 * least)) return std::nullopt;
  const PlyBody& slave = layup.plies[pair.slave];
  const PlyBody& master = layup.plies[pair.master];
  for (const PlyPlyPoint& c : pair.contact.points) {
    const Triangle& t = master.membrane.triangles[c.face];
    Vec3 u = at(slave.x, c.node), r = at(slave.motion, c.node);
    const std::array<double, 3> w = weights_of(c);
    for (std::size_t j = 0; j < 3; ++j) {
      u -= w[j] * at(master.x, t[j]);
      r -= w[j] * at(master.motion, t[j]);
    }
    if (!(r.dot(u) > u.squaredNorm())) continue; // (P)
    return Stop{fmt::format("{} went through ply {}, triangle {}, by a step of {:.3g} mm; "
                            "a slower stroke or a smaller solver.step_factor may help",
                            when_and_who(layup, static_cast<std::size_t>(pair.slave), c.node),
                            master.name, c.face, r.norm())};
  }
  return std::nullopt;
}

/// Whether the straight path from `from` by `displacement` meets the tool. Marches along the path
/// by the signed distance at each point (sphere tracing), so that a thin tool is not missed.
bool meets_tool(const ToolBody& tool, const Vec3& from, const Vec3& displacement) {
  constexpr int most = 1000;                                         // limit of the number of steps
  const double length = displacement.norm(), nearly = length / most; // mm
  SurfaceHint hint;
  double gone = 0.0;
  for (int i = 0; i < most && gone < length; ++i) {
    const double free = distance_to_tool(tool, from + gone / length * displacement, hint).distance;
    if (free <= 0.0) return true;
    gone += std::max(free, nearly);
  }
  return false;
}

/// Whether a node left, or is about to leave, the tool on the side opposite to that on which it
/// entered: the normal has reversed. Around an edge of a solid it rotates by less.
bool passed(const ToolBody& tool, const Vec3& x, const Vec3& displacement, SurfaceHint hint) {
  const SurfacePoint now = distance_to_tool(tool, x, hint);
  if (now.distance >= displacement.norm()) return false; // the tool is not on its path
  const SurfacePoint before = distance_to_tool(tool, x - displacement, hint);
  const double turn = before.normal.dot(now.normal);
  if (before.distance > 0.0 && now.distance > 0.0)
    return turn < 0.0 && meets_tool(tool, x - displacement, displacement);
  return turn < -0.5;
}

std::optional<Stop> find_pass_through(const Layup& layup, const ToolState& tool, std::size_t p) {
  const ToolPlyContact& contact = tool.contacts[p];
  const double thickness = 2.0 * contact.half_thickness;
  const double deepest =
      std::min(contact.law.packed() + deepest_valid * contact.law.max_depth, thickness);
  if (contact.sums.penetration > deepest)
    for (const ToolPlyPoint& c : contact.points)
      if (-c.gap > deepest * layup.plies[p].thickness_ratio[at(c.node)])
        return Stop{fmt::format("{} lies {:.3g} mm deep in tool {}, thickness {:.3g} mm, which is "
                                "all the room that contact has; give the stack more room between "
                                "the tools, a slower stroke, or a smaller solver.step_factor",
                                when_and_who(layup, p, c.node), -c.gap, tool.name, thickness)};
  const double displacement = plyform::step_displacement(layup, static_cast<int>(p), tool);
  if (!(std::max(contact.sums.penetration, displacement / std::min(layup.thinnest, 1.0)) >
        contact.half_thickness))
    return std::nullopt;
  for (const ToolPlyPoint& c : contact.points) {
    const Vec3 moved = at(layup.plies[p].motion, c.node) - tool.body.motion;
    if (passed(tool.body, at(layup.plies[p].x, c.node), moved, c.hint))
      return Stop{fmt::format("{} went through tool {} by a step of {:.3g} mm; a slower stroke or "
                              "a smaller solver.step_factor may help",
                              when_and_who(layup, p, c.node), tool.name, moved.norm())};
  }
  return std::nullopt;
}

} // namespace

double step_displacement(const Layup& layup, const PlyContact& pair) {
  return step_displacement(layup, pair.slave) + step_displacement(layup, pair.master);
}

double step_displacement(const Layup& layup, int ply, const ToolState& tool) {
  // a pushed tool moves after the search
  const double ahead = tool.body.force_controlled ? tool.body.max_approach_speed * layup.dt : 0.0;
  return step_displacement(layup, ply) + std::max(tool.body.motion.norm(), ahead);
}

std::optional<Stop> find_pass_through(const Layup& layup, const std::vector<ToolState>& tools,
                                      const PlyContacts& contacts) {
  std::optional<Stop> found;
  each_pass(contacts, [&](const PlyContact& pass) {
    if (!found) found = find_pass_through(layup, pass);
  });
  if (found) return found;
  for (const ToolState& tool : tools)
    for (std::size_t p = 0; p < layup.plies.size(); ++p)
      if (auto stop = find_pass_through(layup, tool, p)) return stop;
  return std::nullopt;
}

} // namespace plyform
