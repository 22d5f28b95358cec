// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that take no part in a forming change nothing of it: not a bit.
#include "core/model/fabric_estimates.hpp"
#include "core/run/run.hpp"
#include "support/scene_checks.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace plyform::far_bodies_test {
namespace {

/// A coarse hemisphere whose fabric leaves to estimates what it can.
Case forming(const std::vector<double>& angles) {
  Case data = coarse_hemisphere(angles);
  for (YarnFamily& family : data.fabrics[0].families)
    family.sources = {ValueSource::missing, ValueSource::missing, ValueSource::missing};
  data.solver.duration = 0.02;
  data.solver.outputs = 4;
  return data;
}

/// The same with a ply half a metre above, of elements half as long and yarns four times as stiff,
/// and tools further up, of which one moves fast and one swings with a mass of its own.
Case with_far_bodies(Case data) {
  Fabric stiff = data.fabrics[0];
  stiff.name = "stiff", stiff.families[0].tension.stiffness *= 4.0, stiff.thickness = 0.2;
  data.fabrics.push_back(stiff);
  data.blanks.push_back(rectangle(340.0, 340.0, 10.0));
  data.plies.push_back({"far", 1, 1, 0.3, 500.0});
  data.plies.push_back({"far, of the same fabric", 0, 0, 0.0, 700.0});
  Tool tool;
  tool.name = "far", tool.shape = Sphere{100.0}, tool.position = {0.0, 0.0, 1500.0};
  tool.motion = Motion::driven, tool.direction = Vec3::UnitZ(), tool.stroke = 400.0;
  data.tools.push_back(tool);
  tool.name = "far, pushed", tool.motion = Motion::force, tool.force = 10.0, tool.mass = 1e-3;
  tool.position.z() = 2500.0;
  data.tools.push_back(tool);
  set_friction(data, 0.2);
  return data;
}

void expect_no_change(const std::vector<double>& angles) {
  Case alone = forming(angles), beside = with_far_bodies(forming(angles));
  estimate_missing(alone), estimate_missing(beside);
  const RunResult one = run_case(alone, 1, {}), other = run_case(beside, 2, {});
  ASSERT_TRUE(ended(one.summary.status)) << one.summary.message;
  EXPECT_EQ(other.summary.status, one.summary.status) << other.summary.message;
  EXPECT_EQ(other.summary.steps, one.summary.steps);
  for (std::size_t p = 0; p < angles.size(); ++p) {
    double furthest = 0.0;
    for (std::size_t n = 0; n < one.last.plies[p].x.size(); ++n)
      furthest = std::max(furthest, (one.last.plies[p].x[n] - other.last.plies[p].x[n]).norm());
    fmt::print("{} plies: ply {} differs by {:g} mm\n", angles.size(), p, furthest);
    EXPECT_EQ(one.last.plies[p].x, other.last.plies[p].x);
  }
  for (std::size_t t = 0; t < alone.tools.size(); ++t)
    EXPECT_EQ(one.last.tools[t].force, other.last.tools[t].force);
  EXPECT_EQ(other.last.plies[angles.size()].x, other.last.plies[angles.size()].x0);
}

TEST(FarBodies, ChangeNothingOfOnePly) {
  expect_no_change({0.0});
}

TEST(FarBodies, ChangeNothingOfAStack) {
  expect_no_change({0.0, 0.25 * std::numbers::pi});
}

} // namespace
} // namespace plyform::far_bodies_test
