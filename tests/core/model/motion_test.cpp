// SPDX-License-Identifier: GPL-3.0-or-later
// The smooth step of tools and boundaries.
#include "core/model/motion.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace plyform::motion_test {
namespace {

TEST(Motion, SmoothStepStartsAndEndsAtRest) {
  const auto path = [](double t) { return smooth_step(7.0, t, 2.0); };
  EXPECT_EQ(path(0.0), 0.0);
  EXPECT_EQ(path(2.0), 7.0);
  EXPECT_EQ(path(-1.0), 0.0);
  EXPECT_EQ(path(3.0), 7.0);
  EXPECT_DOUBLE_EQ(path(1.0), 3.5);
  const double h = 1e-3; // third order at both ends; the next order is a thousandth of it
  EXPECT_NEAR(path(h), 7.0 * 64.0 / 3.0 * std::pow(h / 2.0, 3), 2e-11);
  EXPECT_NEAR(7.0 - path(2.0 - h), 7.0 * 64.0 / 3.0 * std::pow(h / 2.0, 3), 2e-11);
  // between the ramps the speed is peak_speed_ratio of the mean, and nowhere more; no jump of
  // acceleration
  const auto speed = [&](double t) { return (path(t + h) - path(t - h)) / (2.0 * h); };
  const auto pull = [&](double t) { return (path(t + h) - 2.0 * path(t) + path(t - h)) / (h * h); };
  double last = 0.0;
  for (double t = h; t < 2.0 - h; t += h) {
    EXPECT_LE(speed(t), peak_speed_ratio * 3.5 * (1.0 + 1e-9)) << t;
    // slope of the acceleration: at most 6 peak_speed_ratio 7 / r^2 / T^3
    EXPECT_NEAR(pull(t), last, 1.05 * h * 6.0 * peak_speed_ratio * 7.0 / (0.0625 * 8.0)) << t;
    last = pull(t);
  }
  for (const double t : {0.51, 1.0, 1.49})
    EXPECT_NEAR(speed(t), peak_speed_ratio * 3.5, 1e-9) << t;
}

TEST(Motion, StagesFollowEachOtherFromRestToRest) {
  Tool tool;
  tool.motion = Motion::driven;
  tool.programme = {{0.25, 40.0}, {0.5, 40.0}, {0.75, 30.0}};
  const auto at = [&](double t) { return motion_at(tool, t, 2.0); };
  EXPECT_EQ(at(0.0), 0.0);
  EXPECT_DOUBLE_EQ(at(0.25), 20.0); // half of the first stage
  for (const double t : {0.5, 0.7, 1.0})
    EXPECT_DOUBLE_EQ(at(t), 40.0) << t;
  EXPECT_DOUBLE_EQ(at(1.25), 35.0);
  for (const double t : {1.5, 1.9, 2.0, 3.0})
    EXPECT_DOUBLE_EQ(at(t), 30.0) << t;
  const double h = 1e-6;
  for (const double t : {0.5, 1.0, 1.5}) // at rest
    EXPECT_NEAR(at(t + h), at(t - h), 1e-9) << t;
  Case data;
  data.tools = {tool};
  EXPECT_DOUBLE_EQ(longest_strokes(data).at_full_speed, 160.0); // 40 mm in a quarter of the time
}

TEST(Motion, WithoutAProgrammeAStrokeTakesTheDurationAndAForceRisesAtOnce) {
  Tool punch, holder, die;
  punch.motion = Motion::driven;
  punch.stroke = 75.0;
  holder.motion = Motion::force;
  holder.force = 300.0;
  for (const double t : {0.0, 0.01, 0.05, 0.09, 0.1, 0.2}) {
    EXPECT_EQ(motion_at(punch, t, 0.1), smooth_step(75.0, t, 0.1));
    EXPECT_EQ(motion_at(holder, t, 0.1), smooth_step(300.0, t, 0.05 * 0.1));
    EXPECT_EQ(motion_at(die, t, 0.1), 0.0);
  }
}

} // namespace
} // namespace plyform::motion_test
