// SPDX-License-Identifier: GPL-3.0-or-later
// A strip drawn over the edge of a block, against the capstan equation T2 = T1 exp(mu theta). Where
// elements are longer than the edge is round, contact at nodes cannot tell the force, and the run
// says so.
#include "core/run/run.hpp"
#include "support/scene_checks.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace plyform::edge_friction_test {
namespace {

constexpr double mu = 0.2, turn = 62.5; // degrees, at the end

/// Elements of 2.5 mm over an edge of this radius (mm); 2 N hold the strip behind.
Case over_an_edge(double radius) {
  Case data = stack_of({0.0}, rectangle(200.0, 10.0, 2.5));
  Tool block;
  block.name = "block";
  block.shape = Box{{100.0, 40.0, 60.0}, radius};
  block.position = {-50.0, 0.0, -30.0};
  data.tools = {block};
  set_friction(data, mu);
  Gripper held;
  held.place = {true, {Vec2(-100.0, -5.0), Vec2(-100.0, 5.0)}};
  held.direction = -Vec3::UnitX(), held.force = 2.0, held.guided = true;
  Grip pull;
  pull.place = {true, {Vec2(100.0, -5.0), Vec2(100.0, 5.0)}};
  pull.direction = Vec3(-0.5, 0.0, -1.0).normalized(), pull.stroke = 110.0;
  data.boundaries = {{"hold", -1, held}, {"pull", -1, pull}};
  data.solver.duration = 0.2;
  data.solver.fibre_softening = 1000.0;
  data.solver.mass_damping = 100.0;
  data.solver.outputs = 10;
  return data;
}

TEST(EdgeFriction, IsRightWhereNodesShareTheArcAndElseNotTrusted) {
  const double right = std::exp(mu * turn * degree);
  for (const double radius : {0.0, 0.5, 1.5, 5.0, 8.0}) {
    const RunResult run = run_case(over_an_edge(radius), 1, {});
    const double ratio = run.last.boundaries[1].force.norm() / run.last.boundaries[0].force.norm();
    const std::string& message = run.summary.message;
    fmt::print("radius {:g}: T2/T1 {:.3f}, right {:.3f}; {}: {}\n", radius, ratio, right,
               run.summary.status, message);
    ASSERT_TRUE(ended(run.summary.status)) << message;
    const bool told = message.find("do not trust forces and draw-in over the edges of block") !=
                      std::string::npos;
    if (radius < 2.5) {
      EXPECT_TRUE(told && run.summary.status == "doubtful") << radius;
    } else {
      EXPECT_FALSE(told) << radius;
      EXPECT_NEAR(ratio, right, 0.02 * right);
    }
  }
}

} // namespace
} // namespace plyform::edge_friction_test
