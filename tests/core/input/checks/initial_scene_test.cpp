// SPDX-License-Identifier: GPL-3.0-or-later
// What the checks of the whole scene see: lines through tools, plies from above, slabs of surfaces.
#include "core/input/checks/initial_scene.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace plyform::initial_scene_test {
namespace {

Tool ball(double radius, const Vec3& position) {
  Tool tool;
  tool.shape = Sphere{radius};
  tool.position = position;
  return tool;
}

TEST(SceneProbe, FindsWhereALineRunsInATool) {
  const Tool tool = ball(5.0, {1.0, 0.0, 2.0});
  for (const double x : {1.0, 2.5, 5.9, 5.9999}) {
    const double half = std::sqrt(25.0 - (x - 1.0) * (x - 1.0));
    const auto parts = occupied(tool, {x, 0.0}, -20.0, 20.0);
    ASSERT_EQ(parts.size(), 1u) << x;
    EXPECT_NEAR(parts[0].first, 2.0 - half, 3e-8); // 2^-30 of a step, at most 22 mm
    EXPECT_NEAR(parts[0].second, 2.0 + half, 3e-8);
  }
  EXPECT_TRUE(occupied(tool, {6.1, 0.0}, -20.0, 20.0).empty());
  const auto cut = occupied(tool, {1.0, 0.0}, 0.0, 1.0); // wholly inside
  ASSERT_EQ(cut.size(), 1u);
  EXPECT_EQ(cut[0], std::pair(0.0, 1.0));
}

TEST(SceneProbe, FindsWhereALineRunsInARoundedEdge) {
  Tool punch;
  punch.shape = Box{Vec3(20.0, 20.0, 12.0), 4.0};
  punch.position = {0.0, 0.0, 3.0};
  for (const double x : {0.0, 5.9, 7.0, 9.0, 9.99}) { // rounded from 6 on
    const double into = std::max(0.0, x - 6.0), half = 2.0 + std::sqrt(16.0 - into * into);
    const auto parts = occupied(punch, {x, 1.0}, -20.0, 20.0);
    ASSERT_EQ(parts.size(), 1u) << x;
    EXPECT_NEAR(parts[0].first, 3.0 - half, 3e-8); // 2^-30 of a step, at most 22 mm
    EXPECT_NEAR(parts[0].second, 3.0 + half, 3e-8);
  }
  EXPECT_TRUE(occupied(punch, {9.0, 9.0}, -20.0, 20.0).empty()); // beyond the rounded upright edge
}

TEST(SceneProbe, KnowsTheMeshFromItsHoles) {
  // A square ring of eight triangles: outer side 6, hole side 2.
  BlankMesh mesh;
  for (const double r : {3.0, 1.0})
    for (const Vec2& corner : {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)})
      mesh.x.push_back(r * corner);
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    mesh.triangles.push_back({i, j, 4 + j});
    mesh.triangles.push_back({i, 4 + j, 4 + i});
  }
  const FlatPly ply = make_flat_ply(mesh, 0.0, 0.5);
  EXPECT_EQ(ply.border.size(), 8u);
  for (double x = -3.95; x < 4.0; x += 0.3)
    for (double y = -3.95; y < 4.0; y += 0.3) {
      const double r = std::max(std::abs(x), std::abs(y));
      EXPECT_EQ(covers(ply, {x, y}), r > 1.0 && r < 3.0) << x << " " << y;
    }
}

TEST(SceneProbe, VisitsEdgesThatPassAThinSlab) {
  // One tall triangle whose corners are far above and below the slab.
  const TriMesh surface{{Vec3(0, 0, -50), Vec3(1, 0, 60), Vec3(2, 0, 55)}, {{0, 1, 2}}};
  int points = 0;
  visit_slab(surface, 0.0, 0.1, [&](const Vec3& p) {
    EXPECT_GE(p.z(), -1e-12);
    EXPECT_LE(p.z(), 0.1 + 1e-12);
    ++points;
  });
  EXPECT_EQ(points, 6); // two edges pass: ends and middle of each
}

TEST(InitialScene, AToolMuchLargerThanThePliesHasFewTriangles) {
  Tool tool;
  tool.shape = Annulus{638.0, 76610.0, 20.0, 0.0};
  EXPECT_LT(tool_surface(tool, 16.0, 250.0).triangles.size(), 1'000'000u);
}

} // namespace
} // namespace plyform::initial_scene_test
