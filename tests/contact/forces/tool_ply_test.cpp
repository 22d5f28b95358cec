// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes against rigid tools: forces against finite differences, friction, pushed tools, search.
#include "contact/forces/tool_ply.hpp"
#include "support/contact_checks.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <numbers>

namespace plyform::tool_ply_test {
namespace {

constexpr double half_thickness = 0.3; // mm
constexpr double all_ways = std::numeric_limits<double>::infinity();

ToolPlyContact contact_of(const ContactLaw& law) {
  ToolPlyContact contact;
  contact.law = law;
  contact.half_thickness = half_thickness;
  return contact;
}

/// Forces on the nodes in contact.force; returns that on the tool.
Vec3 forces(ToolBody& tool, ToolPlyContact& contact, const OwnedSheet& nodes, double dt) {
  const SurfaceKinematics state = nodes.state();
  return tool_ply_forces(tool, {&contact, 1}, {&state, 1}, {&all_ways, 1}, dt);
}

/// Die hole of radius 20 with a fillet of 5 and a flat top.
ToolShape die() {
  return make_profile({{20.0, -30.0, 0.0}, {20.0, 0.0, 5.0}, {60.0, 0.0, 0.0}});
}

/// A node at random whose distance to the tool is between the given ones.
Vec3 near_tool(const ToolBody& tool, double low, double high, Random& random) {
  for (;;) {
    const Vec3 local = 40.0 * random_vector(random);
    const Vec3 x = tool.rotation * local + tool.position + tool.displacement;
    SurfaceHint hint;
    const double d = distance_to_tool(tool, x, hint).distance;
    if (d > low && d < high) return x;
  }
}

ToolBody placed(const ToolShape& shape, Random& random) {
  ToolBody tool;
  tool.shape = shape;
  tool.position = 10.0 * random_vector(random);
  tool.displacement = random_vector(random);
  tool.rotation =
      Eigen::AngleAxisd(signed_unit(random), random_vector(random).normalized()).toRotationMatrix();
  return tool;
}

TEST(ToolPlyContact, ForceIsMinusEnergyGradient) {
  Random random(1);
  double worst = 0.0;
  for (const ToolShape& shape : {ToolShape(Sphere{25.0}), ToolShape(Plane{}), die()})
    for (int trial = 0; trial < 5; ++trial) {
      ToolBody tool = placed(shape, random);
      std::vector<Vec3> x;
      for (int n = 0; n < 30; ++n) // some touch, some do not
        x.push_back(near_tool(tool, half_thickness - 0.2, half_thickness + 0.1, random));
      OwnedSheet nodes = points_only(x, 4.0);
      ToolPlyContact contact = contact_of({3.0, 0.0, 0.0, 0.25});
      find_tool_ply_points(contact, tool, nodes.state(), 0.5, all_ways);
      const Vec3 on_tool = forces(tool, contact, nodes, 0.0);
      EXPECT_GT(contact.sums.touching, 10);
      EXPECT_LT(contact.sums.touching, 30);
      Vec3 sum = on_tool;
      for (const Vec3& f : contact.force)
        sum += f;
      EXPECT_LE(sum.norm(), 1e-13 * largest_norm(contact.force)); // action is reaction
      const auto energy = [&] {
        ToolPlyContact copy = contact;
        forces(tool, copy, nodes, 0.0);
        return copy.sums.elastic;
      };
      const std::vector<Vec3> force = contact.force;
      // h = 1e-6 mm beside penetrations of 0.1 mm: cut-off and rounding below 1e-8
      const double error = gradient_error(nodes.x, force, 1e-6, energy);
      EXPECT_LE(error, 1e-6) << shape.index();
      worst = std::max(worst, error);
    }
  RecordProperty("worst", fmt::format("{:.2g}", worst));
}

/// One node of 2 mm^2 on a floor, k = 5 N/mm^3, mu = 0.25, pressed by 0.04 mm: N = 0.4 N.
struct OnFloor {
  ToolBody floor;
  OwnedSheet node = points_only({{0.0, 0.0, half_thickness}}, 2.0);
  ToolPlyContact contact = contact_of({5.0, 0.0, 0.25});
  OnFloor() {
    floor.shape = Plane{};
    find_tool_ply_points(contact, floor, node.state(), 0.5, all_ways);
    step({0, 0, -0.04});
  }
  Vec3 step(const Vec3& by) {
    node.move({by});
    const Vec3 on_tool = forces(floor, contact, node, 1e-6);
    EXPECT_EQ((on_tool + contact.force[0]).norm(), 0.0);
    return contact.force[0];
  }
};

TEST(ToolPlyContact, SticksBelowTheConeAndGivesItsWayBack) {
  OnFloor c;
  Vec3 f = c.step({0.005, 0.0, 0.0});
  EXPECT_NEAR(f.x(), -0.025, 1e-13);
  for (int i = 0; i < 1000; ++i) // no creep
    f = c.step(Vec3::Zero());
  EXPECT_NEAR(f.x(), -0.025, 1e-13);
  EXPECT_EQ(c.contact.sums.friction, 0.0);
  EXPECT_NEAR(c.step({-0.005, 0.0, 0.0}).x(), 0.0, 1e-13);
}

TEST(ToolPlyContact, SlidesAtExactlyTheCone) {
  OnFloor c;
  double heat = 0.0;
  for (int i = 0; i < 100; ++i) {
    const Vec3 f = c.step({0.0, 0.003, 0.0});
    if (i > 10) {
      EXPECT_NEAR(f.y(), -0.1, 1e-13);
      EXPECT_NEAR(c.contact.sums.friction - heat, 0.1 * 0.003, 1e-13);
    }
    heat = c.contact.sums.friction;
  }
  c.floor.motion = {0.0, 0.003, 0.0}; // the tool goes along: nothing slides
  const Vec3 f = c.step({0.0, 0.003, 0.0});
  EXPECT_NEAR(f.y(), -0.1, 1e-13);
  EXPECT_NEAR(c.contact.sums.friction, heat, 1e-13);
}

TEST(ToolPlyContact, KeepsItsMemoryAcrossASearch) {
  OnFloor c;
  c.step({0.005, 0.0, 0.0});
  const Vec3 before = c.contact.force[0];
  find_tool_ply_points(c.contact, c.floor, c.node.state(), 0.5, all_ways);
  EXPECT_NEAR((c.step(Vec3::Zero()) - before).norm(), 0.0, 1e-14);
  const double stored = c.contact.sums.elastic, spring = 0.5 * 5.0 * 0.005 * 0.005;
  EXPECT_NEAR(stored, 0.5 * 10.0 * 0.04 * 0.04 + spring, 1e-14);
  c.node.move({{0, 0, 5.0}});
  find_tool_ply_points(c.contact, c.floor, c.node.state(), 0.5,
                       all_ways); // out of reach: forgotten, paid
  EXPECT_TRUE(c.contact.points.empty());
  EXPECT_TRUE(c.contact.force.empty());
  EXPECT_NEAR(c.contact.sums.friction, spring, 1e-15);
}

TEST(ToolPlyContact, ListsEveryNodeWithinReach) {
  Random random(2);
  for (int trial = 0; trial < 5; ++trial) {
    ToolBody tool = placed(die(), random);
    std::vector<Vec3> x;
    for (int n = 0; n < 400; ++n)
      x.push_back(near_tool(tool, -2.0, 4.0, random));
    const OwnedSheet nodes = points_only(x, 1.0);
    ToolPlyContact contact = contact_of({1.0, 0.0, 0.0});
    find_tool_ply_points(contact, tool, nodes.state(), 0.5, all_ways);
    std::size_t next = 0;
    for (std::size_t n = 0; n < x.size(); ++n) {
      SurfaceHint hint;
      if (distance_to_tool(tool, x[n], hint).distance - half_thickness > 0.5) continue;
      ASSERT_LT(next, contact.points.size());
      EXPECT_EQ(contact.points[next++].node, static_cast<int>(n));
    }
    EXPECT_EQ(next, contact.points.size());
    EXPECT_GT(next, 50u);
    EXPECT_LT(next, 350u);
  }
}

TEST(ToolPlyContact, ListsNodesNearMeshesHoweverTheyMove) {
  Random random(5);
  ToolBody tool =
      placed(make_mesh_shape(tessellate(Annulus{8, 20, 6, 2}, 1.0, 0.0), nullptr), random);
  std::vector<Vec3> x;
  for (int n = 0; n < 300; ++n)
    x.push_back(near_tool(tool, 0.4, 3.0, random));
  OwnedSheet nodes = points_only(x, 1.0);
  ToolPlyContact contact = contact_of({1.0, 0.0, 0.0});
  double path_length = 0.0;
  int listed = 0;
  for (int search = 0; search < 40; ++search) {
    find_tool_ply_points(contact, tool, nodes.state(), 0.5, path_length);
    std::size_t next = 0;
    for (std::size_t n = 0; n < x.size(); ++n) {
      while (next < contact.points.size() && contact.points[next].node < static_cast<int>(n))
        ++next;
      SurfaceHint hint;
      if (distance_to_tool(tool, nodes.x[n], hint).distance - half_thickness > 0.5) continue;
      ASSERT_LT(next, contact.points.size());
      EXPECT_EQ(contact.points[next].node, static_cast<int>(n)) << search;
      ++listed;
    }
    std::vector<Vec3> motion;
    for (std::size_t n = 0; n < x.size(); ++n) // one in ten goes as far as the path length tells
      motion.push_back((n % 10 == 0 ? 0.15 : 0.015) * random_vector(random).normalized());
    nodes.move(motion);
    path_length += 0.15;
  }
  EXPECT_GT(listed, 1000);
}

/// A tool pushed down on nodes at different heights.
ToolBody force_controlled(const ToolShape& shape, const Vec3& position, double force) {
  ToolBody tool;
  tool.shape = shape;
  tool.position = position;
  tool.force_controlled = true;
  tool.direction = -Vec3::UnitZ();
  tool.force = force;
  tool.max_approach_speed = 1000.0;
  return tool;
}

TEST(ToolPlyContact, PushedToolFeelsItsForce) {
  Random random(3);
  const double dt = 1e-6;
  for (const bool ball : {false, true})
    for (const double mass : {0.0, 1e-6})
      for (int trial = 0; trial < 10; ++trial) {
        ToolBody tool = ball ? force_controlled(Sphere{2500.0}, {0, 0, 2500.0}, 30.0)
                             : force_controlled(Plane{}, Vec3::Zero(), 30.0);
        if (!ball) // material above
          tool.rotation = Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX()).toRotationMatrix();
        tool.mass = mass;
        OwnedSheet nodes = square_sheet(6, 1.0, -half_thickness);
        for (Vec3& x : nodes.x)
          x.z() += 2e-4 * signed_unit(random); // gaps of some tenths of a step's way
        ToolPlyContact contact =
            contact_of({50.0, 5e-5, ball ? 0.0 : 0.2, 0.02}); // it is pressed to 0.6 of that
        find_tool_ply_points(contact, tool, nodes.state(), 1.0, all_ways);
        int free_steps = 0;
        for (int step = 0; step < 50; ++step) {
          const double speed = tool.speed;
          const Vec3 on_tool = forces(tool, contact, nodes, dt);
          const double delta = tool.motion.dot(tool.direction);
          EXPECT_LE(std::abs(delta), 1000.0 * dt * (1.0 + 1e-12));
          const double left = tool.force - mass * (delta / dt - speed) / dt;
          if (delta > 1000.0 * dt * (1.0 - 1e-9)) { // on its way: nothing holds it yet
            ++free_steps;
            EXPECT_GE(left, -on_tool.dot(tool.direction) - 1e-8 * tool.force);
          } else {
            // 1e-9 of the force is where the iteration ends
            ASSERT_NEAR(-on_tool.dot(tool.direction), left, 1e-8 * tool.force) << step;
          }
          std::vector<Vec3> motion;
          for (std::size_t n = 0; n < nodes.x.size(); ++n)
            motion.push_back(1e-4 * random_vector(random));
          nodes.move(motion);
        }
        EXPECT_LT(free_steps, 45);
        EXPECT_GT(contact.sums.touching, 3);
      }
}

TEST(ToolPlyContact, PushedToolClosesAtItsSpeedLimit) {
  ToolBody tool = force_controlled(Sphere{25.0}, {0, 0, 60.0}, 30.0);
  OwnedSheet nodes = square_sheet(2, 1.0, 0.0);
  ToolPlyContact contact = contact_of({50.0, 0.0, 0.0});
  for (int step = 1; step <= 20; ++step) {
    find_tool_ply_points(contact, tool, nodes.state(), 1.0, all_ways);
    EXPECT_TRUE(forces(tool, contact, nodes, 1e-6).isZero(0.0));
    EXPECT_NEAR(tool.displacement.z(), -1e-3 * step, 1e-15);
    EXPECT_NEAR(tool.motion.z(), -1e-3, 1e-15);
  }
}

} // namespace
} // namespace plyform::tool_ply_test
