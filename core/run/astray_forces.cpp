// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run/astray_forces.hpp"

#include "base/node_normals.hpp"
#include "core/model/motion.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <variant>

namespace plyform {
namespace {

/// mm^2, before forming.
double area_of(const PlyBody& ply) {
  const std::vector<double>& areas = ply.membrane.node_area;
  return std::accumulate(areas.begin(), areas.end(), 0.0);
}

/// L, N.
double drawing_load(const Scene& s) {
  double drawn = 0.0, any = 0.0;
  for (std::size_t t = 0; t < s.tools.size(); ++t) {
    const double force = s.tools[t].force.norm();
    any = std::max(any, force);
    if (s.data.tools[t].motion == Motion::driven) drawn = std::max(drawn, force);
  }
  for (const BoundaryState& b : s.boundaries)
    drawn = std::max(drawn, b.force.norm());
  for (std::size_t p = 0; p < s.plies.size(); ++p)
    if (const std::optional<double> pressure = pressure_on(s.data, p, s.time))
      drawn = std::max(drawn, std::abs(*pressure) * area_of(s.plies[p]));
  return drawn > 0.0 ? drawn : any;
}

} // namespace

std::vector<double> forces_astray(const Scene& s) {
  std::vector<double> astray(s.tools.size(), 0.0);
  for (std::size_t p = 0; p < s.plies.size(); ++p) {
    std::vector<Vec3> normals;
    for (std::size_t t = 0; t < s.tools.size(); ++t) {
      if (s.tools[t].contacts[p].sums.touching == 0) continue;
      if (std::holds_alternative<Plane>(s.tools[t].body.shape)) continue; // it has no edge
      if (normals.empty()) normals = mean_normals(s.plies[p].x, s.plies[p].membrane.triangles);
      for (const ToolPlyPoint& c : s.tools[t].contacts[p].points)
        astray[t] += c.memory.normal_force * normal_of(c).cross(normals[at(c.node)]).norm();
    }
  }
  return astray;
}

void follow_astray_forces(const Scene& s, std::vector<AstrayForce>& astray) {
  astray.resize(s.tools.size());
  const std::vector<double> now = forces_astray(s);
  const double load = drawing_load(s);
  for (std::size_t t = 0; t < now.size(); ++t)
    astray[t].push_back(load > 0.0 ? now[t] / load : 0.0);
}

double astray_share(const AstrayForce& astray) {
  if (astray.empty()) return 0.0;
  std::vector<double> later(astray.begin() + static_cast<std::ptrdiff_t>(astray.size() / 2),
                            astray.end());
  const auto middle = later.begin() + static_cast<std::ptrdiff_t>(later.size() / 2);
  std::nth_element(later.begin(), middle, later.end());
  return *middle;
}

} // namespace plyform
