// SPDX-License-Identifier: GPL-3.0-or-later
// Outlines to mesh and what every blank mesh must hold, worked out independently of the mesher.
#pragma once

#include "core/mesh/mesh_blank.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace plyform::blank_checks {

inline double turn(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

inline std::vector<Vec2> rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

inline std::vector<Vec2> circle(Vec2 centre, double radius, int points) {
  std::vector<Vec2> loop;
  for (int k = 0; k < points; ++k) {
    const double s = 2 * std::numbers::pi * k / points;
    loop.push_back(centre + radius * Vec2(std::cos(s), std::sin(s)));
  }
  return loop;
}

inline Outline square_340() {
  return {rectangle(-170, -170, 170, 170), {}};
}

/// L of 340 x 340 with a skew hole, given clockwise.
inline Outline pierced_l() {
  Outline outline{{{0, 0}, {340, 0}, {340, 150}, {150, 150}, {150, 340}, {0, 340}},
                  {{{40, 40}, {90, 50}, {80, 110}, {30, 90}}}};
  std::reverse(outline.boundary.begin(), outline.boundary.end());
  return outline;
}

/// Slanted pentagon with two holes, one round.
inline Outline pierced_pentagon() {
  return {{{0, 0}, {340, 0}, {300, 200}, {170, 340}, {20, 300}},
          {circle({170, 150}, 45, 24), rectangle(60, 200, 110, 260)}};
}

inline Outline disc() {
  return {circle({10, -5}, 170, 60), {}};
}

inline double area(const std::vector<Vec2>& loop) {
  double twice = 0;
  for (std::size_t k = 0; k < loop.size(); ++k)
    twice += turn(loop[k] - loop[0], loop[(k + 1) % loop.size()] - loop[0]);
  return std::abs(twice) / 2;
}

inline double area(const Outline& outline) {
  double sum = area(outline.boundary);
  for (const auto& hole : outline.holes)
    sum -= area(hole);
  return sum;
}

/// Measures of a mesh; lengths in mm, angles in rad.
struct Measures {
  double area = 0, smallest_double_area = 1e300, min_angle = 10, min_height = 1e300, mean_edge = 0;
  std::size_t most_triangles_on_edge = 0, unused_nodes = 0, bad_nodes = 0, rim_loops = 0;
};

inline std::size_t count_loops(const std::map<int, std::vector<int>>& next,
                               std::size_t& bad_nodes) {
  std::map<int, bool> seen;
  std::size_t loops = 0;
  for (const auto& [start, targets] : next) {
    bad_nodes += targets.size() != 1;
    if (seen[start]) continue;
    ++loops;
    for (int n = start; !seen[n]; n = next.at(n).front())
      seen[n] = true;
  }
  return loops;
}

inline Measures measure(const BlankMesh& mesh) {
  Measures m;
  std::map<std::pair<int, int>, std::size_t> edges;
  std::vector<int> uses(mesh.x.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    double longest = 0;
    const auto x = [&](std::size_t k) { return mesh.x.at(static_cast<std::size_t>(t[k % 3])); };
    const double twice = turn(x(1) - x(0), x(2) - x(0));
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 a = x(k + 1) - x(k), b = x(k + 2) - x(k);
      m.min_angle = std::min(m.min_angle, std::atan2(twice, a.dot(b)));
      longest = std::max(longest, a.norm());
      ++edges[std::minmax(t[k], t[(k + 1) % 3])];
      ++uses.at(static_cast<std::size_t>(t[k]));
    }
    m.area += twice / 2;
    m.smallest_double_area = std::min(m.smallest_double_area, twice);
    m.min_height = std::min(m.min_height, twice / longest);
  }
  m.unused_nodes = static_cast<std::size_t>(std::count(uses.begin(), uses.end(), 0));
  for (const auto& [edge, count] : edges) {
    m.most_triangles_on_edge = std::max(m.most_triangles_on_edge, count);
    m.mean_edge +=
        (mesh.x[edge.first] - mesh.x[edge.second]).norm() / static_cast<double>(edges.size());
  }
  std::map<int, std::vector<int>> rim;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      if (edges.at(std::minmax(t[k], t[(k + 1) % 3])) == 1) rim[t[k]].push_back(t[(k + 1) % 3]);
  m.rim_loops = count_loops(rim, m.bad_nodes);
  return m;
}

/// What must hold for every mesh of an outline.
inline void expect_sound(const BlankMesh& mesh, const Outline& outline, const std::string& what) {
  SCOPED_TRACE(what);
  const Measures m = measure(mesh);
  const double exact = area(outline);
  // Nodes on slanted sides are off by a rounding: 1e-16 of the coordinates each.
  EXPECT_LE(std::abs(m.area - exact), 1e-12 * exact);
  EXPECT_GT(m.smallest_double_area, 0);
  EXPECT_EQ(m.unused_nodes, 0u);
  EXPECT_LE(m.most_triangles_on_edge, 2u);
  EXPECT_EQ(m.bad_nodes, 0u) << "nodes where the rim branches";
  EXPECT_EQ(m.rim_loops, 1 + outline.holes.size());
  const auto is_node = [&](const Vec2& p) {
    return std::any_of(mesh.x.begin(), mesh.x.end(),
                       [&](const Vec2& x) { return (x - p).norm() <= 1e-12 * p.norm(); });
  };
  EXPECT_TRUE(std::all_of(outline.boundary.begin(), outline.boundary.end(), is_node));
  for (const auto& hole : outline.holes)
    EXPECT_TRUE(std::all_of(hole.begin(), hole.end(), is_node));
}

/// Message of the std::runtime_error that `call` throws; empty if it throws none.
template <class Call>
std::string message_of(Call&& call) {
  try {
    call();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return {};
}

} // namespace plyform::blank_checks
