// SPDX-License-Identifier: GPL-3.0-or-later
// The smooth step of tools and boundaries.
#include "core/model/motion.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace plyform {
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

} // namespace
} // namespace plyform
