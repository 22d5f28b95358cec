// SPDX-License-Identifier: GPL-3.0-or-later
// Zones along the tight radii of a tool: which places count, how far they reach, and that they stay
// with the tool when the blank is moved and turned.
#include "core/mesh/mesh_ply.hpp"
#include "core/mesh/size_field.hpp"
#include "core/mesh/tool_zone.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace plyform::tool_zone_test {
namespace {

Tool tool_of(ToolShape shape) {
  Tool tool;
  tool.shape = std::move(shape);
  return tool;
}

/// A die: a hole of radius 40 with a fillet of 10 in a plate of radius 120.
Tool die() {
  return tool_of(Annulus{40.0, 120.0, 30.0, 10.0});
}

std::pair<double, double> radii_of(const std::vector<ToolPlace>& places) {
  double least = 1e9, most = 0.0;
  for (const ToolPlace& place : places)
    least = std::min(least, place.at.norm()), most = std::max(most, place.at.norm());
  return {least, most};
}

/// Whether the places about p, seen from above, reach it.
bool reached(const std::vector<ToolPlace>& places, const Vec2& p) {
  return std::any_of(places.begin(), places.end(),
                     [&](const ToolPlace& place) { return (place.at - p).norm() < place.reach; });
}

TEST(ToolZone, HoldsTheFilletsOfADie) {
  const std::vector<ToolPlace> places = tight_places(die(), {{}, {}, 3.0});
  const auto [least, most] = radii_of(places);
  EXPECT_GE(least, 40.0 - 1e-9); // both rims have fillets, 40 to 50 and 110 to 120
  EXPECT_LE(most, 120.0 + 1e-9);
  for (const ToolPlace& place : places) {
    const double r = place.at.norm();
    EXPECT_TRUE(r < 51.0 || r > 109.0) << r; // what is between is flat
    EXPECT_NEAR(place.reach, 20.0, 1.0);     // twice the radius, found on triangles
  }
  for (int k = 0; k < 360; ++k)
    EXPECT_TRUE(reached(places, Eigen::Rotation2Dd(k * degree) * Vec2(60.0, 0.0))) << k;
  EXPECT_FALSE(reached(places, {80.0, 0.0}));
  EXPECT_FALSE(reached(places, {10.0, 0.0}));
}

TEST(ToolZone, KeepsToTheRadiusAndDistanceThatAreGiven) {
  EXPECT_TRUE(tight_places(die(), {5.0, {}, 3.0}).empty()); // nothing so tight
  const std::vector<ToolPlace> near = tight_places(die(), {10.0, 4.0, 3.0});
  ASSERT_FALSE(near.empty());
  for (const ToolPlace& place : near)
    EXPECT_EQ(place.reach, 4.0);
  EXPECT_TRUE(reached(near, {45.0, 0.0}));
  EXPECT_FALSE(reached(near, {60.0, 0.0}));
}

/// Of a tool that is far wider than the blank only the places that reach the blank are made, and
/// one of each piece of its surface; those are the same.
TEST(ToolZone, OfAWindowAreThoseThatReachIt) {
  const ToolZoneRule all{{}, 3.0, 3.0};
  ToolZoneRule rule = all;
  rule.window = Eigen::AlignedBox2d(Vec2(-60.0, -20.0), Vec2(10.0, 55.0));
  const std::vector<ToolPlace> there = tight_places(die(), rule);
  const auto count = [&](const std::vector<ToolPlace>& places) {
    return std::count_if(places.begin(), places.end(), [&](const ToolPlace& place) {
      return rule.window.exteriorDistance(place.at) < place.reach;
    });
  };
  EXPECT_EQ(count(there), count(tight_places(die(), all)));
  EXPECT_LT(there.size(), tight_places(die(), all).size());
  const Tool wide = tool_of(Annulus{14.0, 99999.99, 4.0, 2.0});
  EXPECT_LT(tight_places(wide, rule).size(), 50000U);
}

/// A box counts by its edges, rounded or sharp, not by its faces.
TEST(ToolZone, HoldsTheEdgesOfABoxAndNotItsFaces) {
  for (const double edge : {4.0, 0.0}) {
    const std::vector<ToolPlace> places =
        tight_places(tool_of(Box{{80, 60, 40}, edge}), {{}, {}, 2.0});
    ASSERT_FALSE(places.empty());
    for (int k = -10; k <= 10; ++k) {
      EXPECT_TRUE(reached(places, {3.5 * k, 29.0}));
      EXPECT_TRUE(reached(places, {39.0, 2.5 * k}));
    }
    EXPECT_FALSE(reached(places, {0.0, 0.0}));
    EXPECT_FALSE(reached(places, {20.0, 10.0}));
  }
}

TEST(ToolZone, CoversAllOfABallAndNothingOfAPlane) {
  const std::vector<ToolPlace> places = tight_places(tool_of(Sphere{30.0}), {{}, 3.0, 1.0});
  for (int k = -30; k <= 30; ++k)
    EXPECT_TRUE(reached(places, {0.9 * k, 0.1})) << k;
  EXPECT_FALSE(reached(places, {33.5, 0.0}));
  EXPECT_TRUE(tight_places(tool_of(Plane{}), {{}, {}, 1.0}).empty());
}

/// Mesh tools as the shapes that they were made from.
TEST(ToolZone, TakesMeshToolsAsTheSurfaceThatTheyStandFor) {
  const Tool mesh = tool_of(make_mesh_shape(tessellate(die().shape, 12.0, 0.0), nullptr));
  const std::vector<ToolPlace> places = tight_places(mesh, {{}, {}, 3.0});
  EXPECT_TRUE(reached(places, {60.0, 0.0}));
  EXPECT_TRUE(reached(places, {45.0, 0.0}));
  EXPECT_FALSE(reached(places, {80.0, 0.0}));
  EXPECT_FALSE(reached(places, {10.0, 0.0}));
}

/// Mean place of the smallest triangles, mm.
Vec2 middle_of_small(const BlankMesh& mesh) {
  Vec2 sum = Vec2::Zero();
  double count = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Vec2 &a = mesh.x[at(t[0])], &b = mesh.x[at(t[1])], &c = mesh.x[at(t[2])];
    const Vec2 u = b - a, v = c - a;
    if (u.x() * v.y() - u.y() * v.x() > 4.0) continue;
    sum += (a + b + c) / 3.0, count += 1.0;
  }
  return sum / count;
}

TEST(ToolZone, StaysWithTheToolWhenTheBlankIsMoved) {
  Case data;
  data.fabrics.emplace_back();
  BlankSpec blank;
  blank.outline.boundary = {{-60, -60}, {60, -60}, {60, 60}, {-60, 60}};
  blank.mesh = MeshKind::alternating, blank.element_size = 8.0;
  MeshZone zone;
  zone.kind = ZoneKind::tool, zone.element_size = 1.5;
  Tool ball = tool_of(Sphere{6.0});
  ball.position = {30.0, 12.0, 50.0};
  zone.places = tight_places(ball, {{}, 2.0, 1.5});
  blank.zones = {zone};
  data.blanks = {blank};
  data.plies = {{"ply", 0, 0, 0.0, 0.0}};
  for (const double turn : {0.0, 0.7}) {
    data.plies[0].rotation = turn;
    data.plies[0].seed = {10.0 * turn, -5.0};
    EXPECT_LE((middle_of_small(mesh_ply(data, data.plies[0])) - Vec2(30, 12)).norm(), 1.0) << turn;
    EXPECT_TRUE(lies_on(seen_from_blank(zone, data.plies[0]), blank.outline));
  }
  data.plies[0].seed = {200.0, 0.0};
  EXPECT_FALSE(lies_on(seen_from_blank(zone, data.plies[0]), blank.outline));
}

} // namespace
} // namespace plyform::tool_zone_test
