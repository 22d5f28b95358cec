// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run/rim_forces.hpp"

#include "base/format.hpp"
#include "base/node_normals.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

constexpr double beside = 0.7;     // cosine of 45 degrees: the nearest of the tool is its rim
constexpr double tolerable = 0.02; // of a force
constexpr int samples = 12;        // along a side of a triangle: its covered share to some 0.02

/// Whether a tool lies over `x`, of a ply with the normal `n`, and not beside it.
bool covers(const ToolBody& tool, const Vec3& x, const Vec3& n) {
  SurfaceHint hint;
  return std::abs(distance_to_tool(tool, x, hint).normal.dot(n)) >= beside;
}

/// Share of a triangle that a tool lies over, by the centres of small triangles in it.
double covered_share(const ToolBody& tool, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = (b - a).cross(c - a).normalized();
  int inside = 0, all = 0;
  for (int i = 0; i < samples; ++i)
    for (int j = 0; i + j < samples; ++j)
      for (const double third : {1.0 / 3.0, 2.0 / 3.0}) { // of both that a cell has
        const double u = (i + third) / samples, v = (j + third) / samples;
        if (u + v >= 1.0) continue;
        ++all;
        if (covers(tool, a + u * (b - a) + v * (c - a), normal)) ++inside;
      }
  return static_cast<double>(inside) / all;
}

/// Forces (N) and areas (mm^2) of the nodes of a ply that a tool touches.
struct Touched {
  std::vector<double> force, area;

  Touched(const ToolPlyContact& contact, const PlyBody& ply)
      : force(ply.x.size(), 0.0), area(ply.x.size(), 0.0) {
    for (const ToolPlyPoint& c : contact.points)
      force[at(c.node)] = c.memory.normal_force;
    for (const Triangle& t : ply.membrane.triangles)
      for (const std::int32_t n : t)
        area[at(n)] += triangle_area(ply.x, t) / 3.0;
  }
};

/// N by which the nodes of a triangle push a tool more than what it covers of the triangle would.
double excess_of(const ToolBody& tool, const Touched& nodes, const PlyBody& ply,
                 const Triangle& t) {
  double pressure = 0.0;
  int touching = 0;
  for (const std::int32_t n : t)
    if (nodes.force[at(n)] > 0.0) ++touching, pressure += nodes.force[at(n)] / nodes.area[at(n)];
  if (touching == 0 || touching == 3) return 0.0;
  const Vec3 &a = ply.x[at(t[0])], &b = ply.x[at(t[1])], &c = ply.x[at(t[2])];
  const double covered = covered_share(tool, a, b, c);
  if (covered == 1.0) return 0.0; // nodes let go for another reason
  return pressure / touching * triangle_area(ply.x, t) * (touching / 3.0 - covered);
}

double excess_at_rim(const ToolBody& tool, const ToolPlyContact& contact, const PlyBody& ply) {
  const Touched nodes(contact, ply);
  double sum = 0.0;
  for (const Triangle& t : ply.membrane.triangles)
    sum += excess_of(tool, nodes, ply, t);
  return sum;
}

/// N, by how much plies that give way through their thickness push a tool more than what it covers
/// of their triangles would, at their pressures.
double excess_on(const Scene& s, const ToolState& tool) {
  double sum = 0.0;
  for (std::size_t p = 0; p < s.plies.size(); ++p)
    if (tool.contacts[p].law.loading && tool.contacts[p].sums.touching > 0)
      sum += excess_at_rim(tool.body, tool.contacts[p], s.plies[p]);
  return sum;
}

} // namespace

std::vector<std::string> doubts_of_rims(const Scene& s) {
  std::vector<std::string> found;
  for (const ToolState& tool : s.tools) {
    const double force = tool.force.norm(), excess = excess_on(s, tool);
    if (!(std::abs(excess) > tolerable * force)) continue;
    found.push_back(fmt::format("do not trust the {:.3g} N on {}: nodes at its rim push with the "
                                "whole of their areas, some {:.2g} N {} than what the rim covers "
                                "of them; smaller elements there, or a tool as large as the plies",
                                force, tool.name, std::abs(excess),
                                excess > 0.0 ? "more" : "less"));
  }
  return found;
}

} // namespace plyform
