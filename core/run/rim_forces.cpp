// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run/rim_forces.hpp"

#include "base/node_normals.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plyform {
namespace {

constexpr double beside = 0.7;     // cosine of 45 degrees: the nearest of the tool is its rim
constexpr double tolerable = 0.02; // of a force
constexpr double uncovered = 0.6;  // of an area: half at a straight rim, three quarters at a corner

/// N, of the normal forces of a tool on a ply those at nodes of its rim.
double force_at_rim(const ToolBody& tool, const ToolPlyContact& contact, const PlyBody& ply) {
  std::vector<double> force(ply.x.size(), 0.0);
  for (const ToolPlyPoint& c : contact.points)
    force[at(c.node)] = c.memory.normal_force;
  const std::vector<Vec3> normals = mean_normals(ply.x, ply.membrane.triangles);
  std::vector<char> at_rim(ply.x.size(), 0);
  for (const Triangle& t : ply.membrane.triangles) {
    const auto touches = [&](std::int32_t n) { return force[at(n)] > 0.0; };
    if (std::none_of(t.begin(), t.end(), touches) || std::all_of(t.begin(), t.end(), touches))
      continue;
    const bool past = std::any_of(t.begin(), t.end(), [&](std::int32_t n) {
      if (touches(n)) return false;
      SurfaceHint hint;
      const SurfacePoint near = distance_to_tool(tool, ply.x[at(n)], hint);
      return std::abs(near.normal.dot(normals[at(n)])) < beside;
    });
    for (const std::int32_t n : t)
      if (past && touches(n)) at_rim[at(n)] = 1;
  }
  double sum = 0.0;
  for (std::size_t n = 0; n < force.size(); ++n)
    if (at_rim[n]) sum += force[n];
  return sum;
}

} // namespace

std::vector<double> rim_forces(const Scene& s) {
  std::vector<double> forces;
  for (const ToolState& t : s.tools) {
    double sum = 0.0;
    for (std::size_t p = 0; p < s.plies.size(); ++p)
      if (t.contacts[p].law.loading && t.contacts[p].sums.touching > 0)
        sum += force_at_rim(t.body, t.contacts[p], s.plies[p]);
    forces.push_back(sum);
  }
  return forces;
}

std::vector<std::string> doubts_of_rims(const Scene& s) {
  std::vector<std::string> found;
  const std::vector<double> rims = rim_forces(s);
  for (std::size_t t = 0; t < rims.size(); ++t) {
    const double force = s.tools[t].force.norm();
    if (!(uncovered * rims[t] > tolerable * force)) continue;
    found.push_back(fmt::format(
        "do not trust the force on {} to better than {:.2g} % of its {:.3g} N: {:.2g} % acts at "
        "nodes of its rim, each with its whole area, of which the rim covers a part; smaller "
        "elements there, or a tool as large as the plies",
        s.tools[t].name, 100.0 * uncovered * rims[t] / force, force, 100.0 * rims[t] / force));
  }
  return found;
}

} // namespace plyform
