// SPDX-License-Identifier: GPL-3.0-or-later
// Gaps and first contacts of tools with flat plies, against closed forms.
#include "core/mesh/mesh_blank.hpp"
#include "core/setup/first_contact.hpp"

#include <gtest/gtest.h>

namespace plyform::first_contact_test {
namespace {

constexpr double thickness = 0.6, height = 3.0; // mm, of the mid-surface

/// 200 x 120 mm about the origin, with a round hole or without.
FlatPly ply(double z = height, double hole = 0.0) {
  BlankSpec blank;
  blank.outline.boundary = {{-100.0, -60.0}, {100.0, -60.0}, {100.0, 60.0}, {-100.0, 60.0}};
  blank.element_size = 4.0;
  if (hole > 0.0) append_circle(blank.outline, Vec2::Zero(), hole);
  return make_flat_ply(mesh_blank(blank, 0.0, 90.0 * degree), z, thickness);
}

Tool driven(ToolShape shape, const Vec3& position, const Vec3& direction = -Vec3::UnitZ()) {
  Tool tool;
  tool.shape = std::move(shape);
  tool.position = position;
  tool.motion = Motion::driven;
  tool.direction = direction.normalized();
  tool.stroke = 100.0;
  return tool;
}

struct Found {
  PlyGap gap;
  std::optional<FirstContact> contact;
};

Found look(const Tool& tool, const std::vector<FlatPly>& plies) {
  std::vector<Vec3> points;
  if (!std::holds_alternative<Plane>(tool.shape)) points = tool_surface(tool, 5.0, 200.0).x;
  const ToolAhead ahead{tool, points};
  const PlyGap gap = nearest_ply(ahead, Vec3::Zero(), plies);
  return {gap, first_contact(ahead, tool.stroke, gap, plies)};
}

TEST(FirstContact, OfASphereAboveAPlyIsItsGap) {
  const Vec3 centre(13.37, -21.4, 60.0); // of no node and no box
  const Found found = look(driven(Sphere{25.0}, centre), {ply()});
  const double gap = centre.z() - 25.0 - height - 0.5 * thickness;
  EXPECT_NEAR(found.gap.gap, gap, 1e-9);
  EXPECT_LT((found.gap.where - Vec3(13.37, -21.4, height + 0.5 * thickness)).norm(), 1e-3);
  ASSERT_TRUE(found.contact);
  EXPECT_NEAR(found.contact->stroke, gap, 1e-9);
  EXPECT_LT((found.contact->where - found.gap.where).norm(), 1e-3);
}

TEST(FirstContact, OfASphereThatMovesAslantIsWhereItTouches) {
  const Vec3 centre(-70.0, 5.0, 60.0);
  const Found found = look(driven(Sphere{20.0}, centre, Vec3(0.6, 0.0, -0.8)), {ply()});
  const double gap = centre.z() - 20.0 - height - 0.5 * thickness;
  ASSERT_TRUE(found.contact);
  EXPECT_NEAR(found.contact->stroke, gap / 0.8, 1e-5);
  EXPECT_NEAR(found.contact->where.x(), centre.x() + gap / 0.8 * 0.6, 1e-2);
}

TEST(FirstContact, IsWithTheNearestPlyOfAStack) {
  const std::vector<FlatPly> stack = {ply(0.3), ply(0.9), ply(1.5)};
  const Found above = look(driven(Box{{40.0, 40.0, 10.0}}, {0.0, 0.0, 12.0}), stack);
  EXPECT_EQ(above.gap.ply, 2u);
  EXPECT_NEAR(above.gap.gap, 7.0 - 1.8, 1e-9);
  ASSERT_TRUE(above.contact);
  EXPECT_EQ(above.contact->ply, 2u);
  EXPECT_NEAR(above.contact->stroke, 7.0 - 1.8, 1e-9);
  const Found below = look(driven(Box{{40.0, 40.0, 10.0}}, {0.0, 0.0, -9.0}, Vec3::UnitZ()), stack);
  EXPECT_EQ(below.gap.ply, 0u);
  ASSERT_TRUE(below.contact);
  EXPECT_NEAR(below.contact->stroke, 4.0, 1e-9);
  EXPECT_NEAR(below.contact->where.z(), 0.0, 1e-12);
}

TEST(FirstContact, IsNoneWhereTheToolLeavesOrPassesOrStopsBefore) {
  const Box box{{40.0, 40.0, 10.0}};
  const double rests = height + 0.5 * thickness + 5.0;
  EXPECT_FALSE(look(driven(box, {0.0, 0.0, rests}, Vec3::UnitZ()), {ply()}).contact);
  EXPECT_FALSE(look(driven(box, {200.0, 0.0, 50.0}), {ply()}).contact);
  Tool tool = driven(box, {0.0, 0.0, rests + 20.0});
  tool.stroke = 19.9;
  EXPECT_FALSE(look(tool, {ply()}).contact);
  tool.stroke = 20.0;
  EXPECT_TRUE(look(tool, {ply()}).contact);
}

TEST(FirstContact, IsAtOnceOfAToolThatRestsOrLiesInThePly) {
  const Box box{{40.0, 40.0, 10.0}};
  const double rests = height + 0.5 * thickness + 5.0;
  for (const double deep : {0.0, 0.1}) {
    const Found found = look(driven(box, {0.0, 0.0, rests - deep}), {ply()});
    EXPECT_NEAR(found.gap.gap, -deep, 1e-9);
    ASSERT_TRUE(found.contact);
    EXPECT_EQ(found.contact->stroke, 0.0);
  }
}

TEST(FirstContact, OfASphereOverAHoleIsWithItsRim) {
  const double hole = 20.0, radius = 30.0, z = 50.0;
  const Found found = look(driven(Sphere{radius}, {0.0, 0.0, z}), {ply(height, hole)});
  EXPECT_NEAR(found.gap.gap, std::hypot(hole, z - height) - radius - 0.5 * thickness, 0.1);
  const double apart = radius + 0.5 * thickness;
  ASSERT_TRUE(found.contact);
  EXPECT_NEAR(found.contact->stroke, z - height - std::sqrt(apart * apart - hole * hole), 0.15);
}

TEST(FirstContact, FindsATipThatIsNarrowerThanItsBoxes) {
  // a spike of 0.2 mm, upside down
  TriMesh spike{{{31.1, 7.3, 10.0}, {31.3, 7.3, 10.0}, {31.2, 7.5, 10.0}, {31.2, 7.37, 5.0}},
                {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}};
  const Found found = look(driven(make_mesh_shape(spike, nullptr), Vec3::Zero()), {ply()});
  EXPECT_NEAR(found.gap.gap, 5.0 - height - 0.5 * thickness, 1e-5);
  ASSERT_TRUE(found.contact);
  EXPECT_NEAR(found.contact->stroke, 5.0 - height - 0.5 * thickness, 1e-4);
}

} // namespace
} // namespace plyform::first_contact_test
