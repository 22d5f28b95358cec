// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run/facet_penetration.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace plyform {
namespace {

constexpr double resolution = 0.01; // thicknesses; a cut of one thickness makes a result doubtful
constexpr int most_halvings = 8;    // of a quarter of a side: 0.01 mm where a side has 10 mm

/// Search for the deepest point of one ply in one tool.
class Search {
public:
  Search(const PlyBody& ply, const ToolBody& tool)
      : ply_(ply), tool_(tool), half_(0.5 * ply.membrane.fabric.least_thickness()) {}

  double deepest() {
    std::vector<const Triangle*> near;
    for (const Triangle& t : ply_.membrane.triangles)
      if (sample(t)) near.push_back(&t);
    for (const Triangle* t : near) {
      const Vec3 &a = corner(*t, 0), u = (corner(*t, 1) - a) / parts,
                 v = (corner(*t, 2) - a) / parts;
      for (int i = 0; i < parts; ++i)
        for (int j = 0; i + j < parts; ++j) {
          const Vec3 p = a + i * u + j * v;
          divide({p, p + u, p + v}, most_halvings);
          if (i + j + 1 < parts) divide({p + u, p + u + v, p + v}, most_halvings);
        }
    }
    return depth_;
  }

private:
  static constexpr int parts = 4; // into which a side is divided

  const Vec3& corner(const Triangle& t, std::size_t k) const { return ply_.x[at(t[k])]; }

  SurfacePoint evaluate(const Vec3& p) {
    const SurfacePoint found = distance_to_tool(tool_, p, hint_);
    depth_ = std::max(depth_, half_ - found.distance);
    return found;
  }

  /// Evaluates the 15 points of a triangle; false if it is too far away to touch the tool.
  bool sample(const Triangle& t) {
    const Vec3 &a = corner(t, 0), u = (corner(t, 1) - a) / parts, v = (corner(t, 2) - a) / parts;
    const Vec3 middle = a + (u + v) * parts / 3.0;
    double size = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
      size = std::max(size, (corner(t, k) - middle).norm());
    if (distance_to_tool(tool_, middle, hint_).distance > half_ + size) return false;
    for (int i = 0; i <= parts; ++i)
      for (int j = 0; i + j <= parts; ++j)
        evaluate(a + i * u + j * v);
    return true;
  }

  /// Evaluates a piece at its middle, and divides it if it may be deeper than depth_. For a convex
  /// tool the tangent plane at the middle bounds the depth of the piece, for a concave one the
  /// depth of its corners does, which have been evaluated when the piece was made.
  void divide(const std::array<Vec3, 3>& piece, int halvings) {
    const Vec3 middle = (piece[0] + piece[1] + piece[2]) / 3.0;
    const SurfacePoint found = evaluate(middle);
    double rise = 0.0;
    for (const Vec3& x : piece)
      rise = std::max(rise, -found.normal.dot(x - middle));
    if (halvings == 0 || half_ - found.distance + rise <= depth_ + resolution * ply_.thickness)
      return;
    std::array<Vec3, 3> side;
    for (std::size_t k = 0; k < 3; ++k) {
      side[k] = 0.5 * (piece[k] + piece[(k + 1) % 3]);
      evaluate(side[k]);
    }
    divide(side, halvings - 1);
    for (std::size_t k = 0; k < 3; ++k)
      divide({piece[k], side[k], side[(k + 2) % 3]}, halvings - 1);
  }

  const PlyBody& ply_;
  const ToolBody& tool_;
  double half_;
  double depth_ = 0.0;
  SurfaceHint hint_; // of the last point: successive points are mostly near each other
};

} // namespace

std::vector<ToolCut> cuts_between_nodes(const Scene& s, ThreadPool& pool) {
  std::vector<ToolCut> cuts(s.tools.size() * s.plies.size());
  pool.run(static_cast<int>(cuts.size()), [&](int i) {
    const ToolState& tool = s.tools[at(i) / s.plies.size()];
    const PlyBody& ply = s.plies[at(i) % s.plies.size()];
    cuts[at(i)] = {tool.name, ply.name, Search(ply, tool.body).deepest(),
                   ply.membrane.fabric.least_thickness()};
  });
  return cuts;
}

double deepest(const std::vector<ToolCut>& cuts) {
  double depth = 0.0;
  for (const ToolCut& cut : cuts)
    depth = std::max(depth, cut.depth);
  return depth;
}

} // namespace plyform
