// SPDX-License-Identifier: GPL-3.0-or-later
// Filtered forces of tools, and the dwell after the stroke.
#include "core/run/dwell.hpp"
#include "core/run/run.hpp"
#include "support/scene_checks.hpp"

#include <atomic>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace plyform::dwell_test {
namespace {

TEST(ForceFilter, FollowsASteadyRiseAndLeavesLittleOfAVibration) {
  constexpr double tau = 0.01, dt = 1e-5, omega = 100.0 / tau; // s, s, 1/s
  ForceFilter filter;
  double worst = 0.0, ripple = 0.0;
  for (int i = 1; i <= 20000; ++i) {
    const double t = i * dt, rise = 500.0 * t; // N
    filter.add(Vec3(rise, std::sin(omega * t), 7.0), dt, tau);
    if (t < 10.0 * tau) continue; // settled
    worst = std::max(worst, std::abs(filter.value().x() - rise));
    ripple = std::max(ripple, std::abs(filter.value().y()));
  }
  EXPECT_LT(worst, 500.0 * (dt + tau * 1e-3)); // by the steps; a single low-pass lags by 500 tau
  EXPECT_NEAR(ripple, 2.0 / (omega * tau), 0.1 * 2.0 / (omega * tau));
  EXPECT_NEAR(filter.value().z(), 7.0, 1e-6);
}

Case fast_press(double dwell) {
  Case data = coarse_hemisphere({0.0});
  data.tools[0].stroke = 30.0;
  data.solver.duration = 0.02; // s: the ply is still moving when the punch stands
  data.solver.outputs = 4;
  data.solver.dwell = dwell;
  return data;
}

TEST(Dwell, WaitsUntilForcesHaveSettled) {
  const RunResult none = run_case(fast_press(0.0), 1, {}), some = run_case(fast_press(5.0), 1, {});
  ASSERT_TRUE(ended(none.summary.status) && ended(some.summary.status));
  EXPECT_LT(none.last.time, 1.01 * 0.02);
  EXPECT_GT(some.last.time, 1.04 * 0.02); // one window at least
  EXPECT_LT(some.last.time, 5.9 * 0.02);  // it did not have to take all of it
  EXPECT_DOUBLE_EQ(some.last.stroke_mm, 30.0);
  const auto kinetic = [](const RunResult& run) {
    const Energies& e = run.last.energy;
    return e.kinetic / (e.fibre + e.shear + e.bending);
  };
  EXPECT_GT(kinetic(none), 0.02);
  EXPECT_LE(kinetic(some), 0.01);
  for (const std::string& line : some.summary.work.missing)
    EXPECT_EQ(line.find("not settled"), std::string::npos) << line;
}

TEST(Dwell, EndsWithoutToolsToo) {
  Case data = stack_of({0.0}, rectangle(40.0, 40.0, 10.0));
  data.gravity = {0.0, 0.0, -9810.0}; // it falls: never at rest
  set_friction(data, 0.0);
  data.solver.duration = 0.002;
  data.solver.dwell = 0.2;
  RunHooks hooks;
  std::atomic<bool> endless = false;
  hooks.interrupt = &endless;
  hooks.progress = [&](const Progress& now) { endless = endless || now.step > 100000; };
  const RunResult run = run_case(data, 1, hooks);
  ASSERT_TRUE(ended(run.summary.status)) << run.summary.message;
  EXPECT_NEAR(run.last.time, 0.0024, 1e-4);
}

TEST(Dwell, SaysThatForcesHaveNotSettled) {
  Case data = fast_press(0.01);
  data.solver.duration = 0.01;
  const RunResult run = run_case(data, 1, {});
  ASSERT_TRUE(ended(run.summary.status)) << run.summary.message;
  bool said = false;
  for (const std::string& line : run.summary.work.missing)
    said = said || line.find("forces had not settled") != std::string::npos;
  EXPECT_TRUE(said);
}

TEST(Dwell, ToolsFollowTheirProgrammes) {
  Case data = fast_press(0.0);
  data.tools[0].programme = {{0.5, 20.0}, {1.0, 15.0}}; // and back
  data.tools[2].programme = {{0.2, 300.0}, {0.5, 300.0}, {1.0, 600.0}};
  std::vector<double> stroke, holder;
  RunHooks hooks;
  hooks.frame = [&](const Frame& f) {
    stroke.push_back(f.tools[0].stroke_mm);
    holder.push_back(f.tools[2].force_N);
  };
  const RunResult run = run_case(data, 1, hooks);
  ASSERT_TRUE(ended(run.summary.status)) << run.summary.message;
  ASSERT_EQ(stroke.size(), 5u); // evenly over the time
  EXPECT_NEAR(stroke[2], 20.0, 0.01);
  EXPECT_NEAR(stroke[4], 15.0, 1e-9);
  EXPECT_NEAR(holder[4], 600.0, 6.0);
}

} // namespace
} // namespace plyform::dwell_test
