// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/tool_depth.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

double depth_of(const PlyBody& ply, const Triangle& t, const ToolAndContacts& tool, int& hint) {
  constexpr int parts = 4; // of a side
  const auto corner = [&](std::size_t k) -> const Vec3& {
    return ply.x[static_cast<std::size_t>(t[k])];
  };
  const Vec3 a = corner(0), u = (corner(1) - a) / parts, v = (corner(2) - a) / parts;
  const double half = 0.5 * ply.thickness;
  const Vec3 middle = a + (u + v) * parts / 3.0;
  double size = 0.0;
  for (std::size_t k = 0; k < 3; ++k)
    size = std::max(size, (corner(k) - middle).norm());
  if (distance_to_tool(tool.body, middle, hint).distance > half + size) return 0.0;
  double depth = 0.0;
  for (int i = 0; i <= parts; ++i)
    for (int j = 0; i + j <= parts; ++j) {
      const double d = distance_to_tool(tool.body, a + i * u + j * v, hint).distance;
      depth = std::max(depth, half - d);
    }
  return depth;
}

} // namespace

double longest_side(const PlyBody& ply) {
  double longest = 0.0;
  for (const SheetEdge& e : ply.edges)
    longest = std::max(
        longest,
        (ply.x[static_cast<std::size_t>(e.a)] - ply.x[static_cast<std::size_t>(e.b)]).norm());
  return longest;
}

double cut_between_nodes(double side, double radius, double thickness, double half_turn) {
  const double R = radius + 0.5 * thickness, half = 0.5 * side;
  if (half <= R * std::sin(half_turn)) return R - std::sqrt(R * R - half * half); // (1)
  return half * std::tan(half_turn) - R * (1.0 / std::cos(half_turn) - 1.0);      // (2)
}

double side_of_half_cut(double radius, double thickness, double half_turn) {
  const double R = radius + 0.5 * thickness, cut = 0.5 * thickness;
  if (cut <= R * (1.0 - std::cos(half_turn))) return 2.0 * std::sqrt(cut * (2.0 * R - cut)); // (1)
  return 2.0 * (cut + R * (1.0 / std::cos(half_turn) - 1.0)) / std::tan(half_turn);          // (2)
}

double depth_between_nodes(const Scene& s) {
  double depth = 0.0;
  for (const ToolAndContacts& tool : s.tools)
    for (const PlyBody& ply : s.plies) {
      int hint = -1; // neighbours in number are mostly neighbours in space
      for (const Triangle& t : ply.membrane.triangles)
        depth = std::max(depth, depth_of(ply, t, tool, hint));
    }
  return depth;
}

} // namespace plyform
