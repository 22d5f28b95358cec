// SPDX-License-Identifier: GPL-3.0-or-later
// How deep tools are in a flat ply between its nodes, against closed forms. Thickness 0.6 mm.
#include "core/run/facet_penetration.hpp"
#include "support/scene_checks.hpp"

#include <gtest/gtest.h>

namespace plyform::facet_penetration_test {
namespace {

/// A pyramid whose tip is at `tip` and whose four sides fall by as much as they go out.
TriMesh pyramid(const Vec3& tip) {
  constexpr double reach = 40.0; // mm
  TriMesh s;
  s.x = {tip};
  for (const Vec2& corner : {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)})
    s.x.push_back(tip + reach * Vec3(corner.x(), corner.y(), -1.0));
  s.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}, {1, 3, 2}, {1, 4, 3}};
  return s;
}

/// One flat ply of 10 mm squares whose mid-surface is at z = 0.3, and one tool.
ToolCut cut_by(const ToolShape& shape, const Vec3& position) {
  Case data = stack_of({0.0}, rectangle(100.0, 60.0, 10.0));
  Tool tool;
  tool.name = "tool";
  tool.shape = shape;
  tool.position = position;
  data.tools = {tool};
  set_friction(data, 0.0);
  ThreadPool pool(2);
  const std::vector<ToolCut> cuts = cuts_between_nodes(make_scene(data), pool);
  EXPECT_EQ(cuts.size(), 1u);
  return cuts.at(0);
}

TEST(ToolDepth, FindsTheTipOfAMeshBetweenAnyNodes) {
  for (const Vec2& place : {Vec2(1.3, 2.9), Vec2(-33.7, 14.2), Vec2(24.9, -18.6), Vec2(7.5, 5.0)}) {
    // 0.5 mm through the mid-surface, but below all nodes: along the slant that is 0.5 / sqrt(2)
    const ToolCut cut =
        cut_by(make_mesh_shape(pyramid({place.x(), place.y(), 0.8}), nullptr), Vec3::Zero());
    EXPECT_NEAR(cut.depth, 0.3 + 0.5 / std::sqrt(2.0), 0.006 + 1e-9) << place.transpose();
    EXPECT_EQ(cut.tool, "tool");
    EXPECT_EQ(cut.ply, "ply1");
    EXPECT_EQ(cut.thickness, 0.6);
  }
}

TEST(ToolDepth, FindsTheTopOfABall) {
  for (const double radius : {2.0, 75.0})
    for (const Vec2& place : {Vec2(1.3, 2.9), Vec2(-33.7, 14.2)}) {
      const ToolCut cut = cut_by(Sphere{radius}, {place.x(), place.y(), 0.3 + 0.1 - radius});
      EXPECT_NEAR(cut.depth, 0.4, 0.006 + 1e-9) << radius;
    }
}

TEST(ToolDepth, OfWhatDoesNotTouchIsZero) {
  EXPECT_EQ(cut_by(Sphere{75.0}, {0.0, 0.0, -75.01}).depth, 0.0);
  EXPECT_EQ(deepest({}), 0.0);
}

TEST(ToolDepth, OfAPlaneIsTheSameEverywhere) {
  EXPECT_NEAR(cut_by(Plane{}, {0.0, 0.0, 0.1}).depth, 0.1, 1e-12);
}

} // namespace
} // namespace plyform::facet_penetration_test
