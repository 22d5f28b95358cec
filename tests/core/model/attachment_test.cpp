// SPDX-License-Identifier: GPL-3.0-or-later
// Where springs and grippers hang, and how a spring pulls. Whole scenes:
// scenes/attachment_test.cpp.
#include "core/mesh/mesh_blank.hpp"
#include "core/model/attachment.hpp"
#include "support/membrane_checks.hpp"

#include <gtest/gtest.h>
#include <limits>

namespace plyform::attachment_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TensionSpring spring_on(const Vec2& a, const Vec2& b, bool edge) {
  TensionSpring s;
  s.place = {edge, {a, b}};
  s.stiffness = 2.0;
  s.anchor = {-60.0, 0.0, 0.0};
  return s;
}

struct Sheet {
  BlankMesh mesh;
  std::vector<Vec3> x;
};

/// A sheet of 100 x 40 mm about the origin.
Sheet sheet(MeshKind kind, double size) {
  Sheet s{mesh_blank(rectangle(100.0, 40.0, size, kind), 0.0, 0.5 * std::numbers::pi), {}};
  for (const Vec2& p : s.mesh.x)
    s.x.emplace_back(p.x(), p.y(), 0.0);
  return s;
}

Attachment attached(const TensionSpring& spring, const Sheet& s) {
  const std::vector<SheetBefore> plies{{s.x, s.mesh.triangles}};
  return attach({{"spring", -1, spring}}, 0, plies);
}

TEST(Attachment, SharesAddUpAndMeetInTheMiddleOfTheEdge) {
  const TensionSpring b = spring_on({-50.0, -20.0}, {-50.0, 20.0}, true);
  for (const MeshKind kind : {MeshKind::alternating, MeshKind::free})
    for (const double size : {10.0, 4.0}) {
      const Attachment a = attached(b, sheet(kind, size));
      double sum = 0.0;
      for (const AttachedNode& node : a.nodes)
        sum += node.share;
      EXPECT_GT(a.nodes.size(), 4u);
      EXPECT_NEAR(sum, 1.0, 1e-12);
      EXPECT_NEAR((a.start - Vec3(-50.0, 0.0, 0.0)).norm(), 0.0, 1e-9); // whatever the mesh
      EXPECT_NEAR(a.length, 10.0, 1e-9);
    }
}

TEST(Attachment, SharesOfAnEdgeAreItsLengths) {
  // the ends of a row of nodes 10 mm apart have half of what the others have
  const Attachment a =
      attached(spring_on({-50.0, -20.0}, {-50.0, 20.0}, true), sheet(MeshKind::alternating, 10.0));
  ASSERT_EQ(a.nodes.size(), 5u);
  int ends = 0;
  for (const AttachedNode& node : a.nodes) {
    const bool end = node.share < 0.2;
    EXPECT_NEAR(node.share, end ? 0.125 : 0.25, 1e-12);
    ends += end;
  }
  EXPECT_EQ(ends, 2);
}

TEST(Attachment, SharesInABoxAreAreas) {
  const Attachment a =
      attached(spring_on({-1e3, -1e3}, {1e3, 1e3}, false), sheet(MeshKind::free, 6.0));
  EXPECT_NEAR(a.start.norm(), 0.0, 0.3); // mm: thirds of triangles, of a mesh that is not symmetric
  double least = 1.0, most = 0.0;
  for (const AttachedNode& node : a.nodes)
    least = std::min(least, node.share), most = std::max(most, node.share);
  EXPECT_GT(least, 0.0);
  EXPECT_GT(most, 3.0 * least); // corners have least
}

TEST(Attachment, OneNodeHasAllOfIt) {
  const Attachment a =
      attached(spring_on({-50.0, -21.0}, {-50.0, -19.0}, true), sheet(MeshKind::alternating, 10.0));
  ASSERT_EQ(a.nodes.size(), 1u);
  EXPECT_EQ(a.nodes[0].share, 1.0);
}

TEST(Attachment, SpringPullsBetweenSlackAndItsLimit) {
  TensionSpring b = spring_on({-50.0, -20.0}, {-50.0, 20.0}, true);
  const Sheet s = sheet(MeshKind::alternating, 10.0);
  b.preload = 6.0;
  b.max_force = 9.0;
  const Attachment a = attached(b, s);
  EXPECT_NEAR(a.natural_length, 7.0, 1e-12); // 10 mm long, 6 N at 2 N/mm
  EXPECT_NEAR(spring_tension(b, a, 10.0, 1.0), 6.0, 1e-12);
  EXPECT_NEAR(spring_tension(b, a, 10.0, 0.0), 0.0, 1e-12); // the preload has not come up
  EXPECT_NEAR(spring_tension(b, a, 11.0, 0.25), 2.0 + 1.5, 1e-12);
  EXPECT_NEAR(spring_tension(b, a, 11.0, 1.0), 8.0, 1e-12);
  EXPECT_EQ(spring_tension(b, a, 12.0, 1.0), 9.0);
  EXPECT_EQ(spring_tension(b, a, 6.0, 1.0), 0.0);
  EXPECT_TRUE(std::isnan(spring_tension(b, a, nan, 1.0)));
  b.preload = 0.0;
  b.natural_length = 12.0; // slack at first: nothing comes up
  const Attachment slack = attached(b, s);
  EXPECT_EQ(spring_tension(b, slack, 10.0, 0.5), 0.0);
  EXPECT_NEAR(spring_tension(b, slack, 13.0, 0.5), 2.0, 1e-12);
}

TEST(Attachment, GripperIsHeldByPlanesOfSymmetryAndItsGuide) {
  const Boundary plane{"plane", -1, SymmetryPlane{{0.0, -20.0}, Vec2::UnitY()}};
  Gripper gripper;
  gripper.place = {false, {Vec2(40.0, -20.0), Vec2(50.0, 0.0)}};
  gripper.direction = Vec3::UnitX();
  const Sheet s = sheet(MeshKind::alternating, 10.0);
  const std::vector<SheetBefore> plies{{s.x, s.mesh.triangles}};
  const auto held = [&](const Gripper& g) {
    return attach({plane, {"gripper", -1, g}}, 1, plies).held;
  };
  ASSERT_EQ(held(gripper).size(), 1u);
  EXPECT_NEAR(std::abs(held(gripper)[0].y()), 1.0, 1e-12);
  Gripper away = gripper;
  away.place.ends = {Vec2(40.0, 0.0), Vec2(50.0, 20.0)};
  EXPECT_TRUE(held(away).empty());
  for (Gripper g : {gripper, away}) {
    g.guided = true;
    ASSERT_EQ(held(g).size(), 2u);
    for (const Vec3& axis : held(g))
      EXPECT_NEAR(axis.x(), 0.0, 1e-12);
    EXPECT_NEAR(held(g)[0].dot(held(g)[1]), 0.0, 1e-12);
  }
}

} // namespace
} // namespace plyform::attachment_test
