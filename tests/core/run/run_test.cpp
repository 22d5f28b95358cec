// SPDX-License-Identifier: GPL-3.0-or-later
// Whole runs of small cases: same bits on any number of threads, early ends, forces through a
// stack.
#include "core/run/run.hpp"
#include "core/solver/scene.hpp"
#include "core/solver/step.hpp"
#include "support/scene_checks.hpp"
#include "support/thread_checks.hpp"

#include <cstring>
#include <gtest/gtest.h>

namespace plyform::run_test {
namespace {

bool all_finite(const Frame& f) {
  for (const PlyFrame& ply : f.plies)
    for (const Vec3& x : ply.x)
      if (!x.allFinite()) return false;
  return true;
}

TEST(Run, GivesTheSameBitsForAnyNumberOfThreads) {
  Case data = coarse_hemisphere({0.0, 0.25 * std::numbers::pi});
  data.blanks[0].element_size = 12.0; // several blocks of nodes and of triangles a ply
  data.tools[0].stroke = 30.0; // two plies of 20 mm cells do not come round the fillet much further
  data.solver.duration = 0.03; // s: soon done
  const RunResult one = run_case(data, 1, {});
  ASSERT_TRUE(ended(one.summary.status)) << one.summary.message;
  ASSERT_TRUE(all_finite(one.last));
  EXPECT_GT(one.last.energy.shear, 0.0);
  EXPECT_GT(one.last.energy.friction, 0.0);
  for (const int threads : {2, 4}) {
    const RunResult more = run_case(data, threads, {});
    EXPECT_EQ(more.summary.threads, threads);
    expect_same_bits(more, one);
  }
}

TEST(Run, GivesTheSameBitsWhileTheNumberOfThreadsChanges) {
  Case data = coarse_hemisphere({0.0, 0.25 * std::numbers::pi});
  data.blanks[0].element_size = 12.0; // several blocks of nodes and of triangles a ply
  data.solver.duration = 0.03;
  const auto nodes_after = [&](ThreadPool& pool, int changes) { // `changes`: numbers in turns
    Scene s = make_scene(data);
    start(s, pool);
    for (int step = 0; step < 300; ++step) {
      pool.work_with(1 + step % changes);
      EXPECT_FALSE(compute_forces(s, pool).has_value()) << step;
      move_plies(s, pool);
    }
    return std::vector<std::vector<Vec3>>{s.plies[0].x, s.plies[1].x};
  };
  ThreadPool one(1), four(4);
  const auto expected = nodes_after(one, 1), changing = nodes_after(four, 4);
  for (std::size_t p = 0; p < expected.size(); ++p) {
    EXPECT_TRUE(same_bits(expected[p], changing[p])) << p;
    EXPECT_FALSE(same_bits(expected[p], make_scene(data).plies[p].x)) << p; // they have moved
  }
}

TEST(Run, NeedsNoDrivenTool) {
  Case data = coarse_hemisphere({0.0});
  data.tools[0].motion = Motion::fixed;
  data.tools[0].stroke = 0.0;
  data.solver.duration = 0.01;
  const RunResult run = run_case(data, 1, {});
  EXPECT_TRUE(ended(run.summary.status)) << run.summary.message;
  EXPECT_NEAR(run.last.tools[2].force_N, data.tools[2].force, 1e-6 * data.tools[2].force);
}

TEST(Run, GivesAnglesAsTheyStandInTheCase) {
  std::vector<double> angles; // rad, as the reader makes them; 30 degrees come back a bit short
  for (const double degrees : {30.0, 45.0, 89.1, -12.3456789})
    angles.push_back(degrees * std::numbers::pi / 180.0);
  ASSERT_NE(angles[0] * 180.0 / std::numbers::pi, 30.0);
  Case data = coarse_hemisphere(angles);
  data.solver.duration = 1e-6;
  const RunResult run = run_case(data, 1, {});
  EXPECT_EQ(run.last.plies[0].angle_deg, 30.0);
  EXPECT_EQ(run.last.plies[1].angle_deg, 45.0);
  EXPECT_EQ(run.last.plies[2].angle_deg, 89.1);
  EXPECT_EQ(run.last.plies[3].angle_deg, -12.3456789);
}

TEST(Run, WritesEachStateOnceAndTheLastAtTheEnd) {
  Case data = coarse_hemisphere({0.0});
  data.solver.duration = 0.02;
  data.solver.outputs = 4;
  std::vector<double> times;
  RunHooks hooks;
  hooks.frame = [&](const Frame& f) { times.push_back(f.time); };
  const RunResult run = run_case(data, 1, hooks);
  ASSERT_TRUE(ended(run.summary.status)) << run.summary.message;
  ASSERT_EQ(times.size(), 5u); // the start and four
  for (std::size_t i = 1; i < times.size(); ++i)
    EXPECT_GT(times[i], times[i - 1]);
  EXPECT_GE(times.back(), data.solver.duration);
}

TEST(Run, EndsEarlyWhenInterrupted) {
  std::atomic<bool> interrupt{false};
  std::vector<Frame> frames;
  RunHooks hooks;
  hooks.interrupt = &interrupt;
  hooks.frame = [&](const Frame& f) {
    frames.push_back(f);
    if (frames.size() == 5) interrupt = true;
  };
  const RunResult run = run_case(coarse_hemisphere({0.0}), 2, hooks);
  EXPECT_EQ(run.summary.status, "interrupted");
  ASSERT_EQ(frames.size(), 6u); // and the state where it ended
  EXPECT_EQ(frames.back().step, frames[4].step + 1);
  EXPECT_EQ(frames.back().step, run.summary.steps);
  EXPECT_TRUE(same_bits(frames.back().plies[0].x, run.last.plies[0].x));
  EXPECT_LT(run.last.time, 0.1);
  EXPECT_NEAR(frames[4].stroke_mm, 4.0 / 20.0 * 75.0, 1.0); // even over the stroke
  EXPECT_TRUE(all_finite(run.last));
}

TEST(Run, StopsAtTheBalanceLimitWithTheLastGoodState) {
  Case data = coarse_hemisphere({0.0});
  data.solver.max_balance_error = 1e-9;
  std::vector<Frame> frames;
  RunHooks hooks;
  hooks.frame = [&](const Frame& f) { frames.push_back(f); };
  const RunResult run = run_case(data, 1, hooks);
  EXPECT_EQ(run.summary.status, "stopped");
  for (const char* part :
       {"stopped at step ", "time ", "energy balance error", "solver.max_balance_error"})
    EXPECT_NE(run.summary.message.find(part), std::string::npos) << run.summary.message;
  EXPECT_TRUE(all_finite(run.last));
  EXPECT_LT(run.last.time, data.solver.duration);
  ASSERT_FALSE(frames.empty());
  EXPECT_TRUE(same_bits(frames.back().plies[0].x, run.last.plies[0].x));
  EXPECT_EQ(frames.back().step, run.last.step);
  // the state kept is the last one before, at most 100 steps earlier
  const long stopped = std::stol(run.summary.message.substr(std::strlen("stopped at step ")));
  EXPECT_GT(stopped, run.last.step);
  EXPECT_LE(stopped - run.last.step, 100);
}

TEST(Run, StopsWhenTheStepIsTooLarge) {
  Case data = coarse_hemisphere({0.0});
  data.solver.step_factor = 2.0; // contact, which is bounded only, leaves some room
  const RunResult run = run_case(data, 1, {});
  EXPECT_EQ(run.summary.status, "stopped");
  for (const char* part : {"step ", "time "})
    EXPECT_NE(run.summary.message.find(part), std::string::npos) << run.summary.message;
  EXPECT_TRUE(all_finite(run.last));
}

TEST(Run, CarriesAPlatesForceThroughEveryPlyOfAStack) {
  Case data = stack_of({0.0, 0.25 * std::numbers::pi, 0.0}, rectangle(100.0, 100.0, 12.5));
  press_by_plate(data);
  Scene s = make_scene(data);
  ThreadPool pool(1);
  start(s, pool);
  for (;;) {
    const auto stop = compute_forces(s, pool);
    ASSERT_FALSE(stop) << stop->message;
    if (s.time >= data.solver.duration) break;
    move_plies(s, pool);
  }
  const double kinetic = current_energies(s, pool).kinetic;
  EXPECT_LT(kinetic, 1e-6); // N mm: a ply of 0.6 t at 0.1 mm/s
  EXPECT_NEAR(s.tools[0].force.z(), -30.0, 0.005 * 30.0);
  EXPECT_NEAR(s.tools[1].force.z(), 30.0, 1e-8 * 30.0); // solved for
  for (const int lower : {0, 1})
    EXPECT_NEAR(force_from_above(s, lower), -30.0, 0.005 * 30.0) << lower;
}

} // namespace
} // namespace plyform::run_test
