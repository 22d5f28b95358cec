// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/time_left.hpp"

#include <gtest/gtest.h>

namespace plyform {
namespace time_left_test {
namespace {

TEST(TimeLeft, OfWorkThatSlowsDownIsRightWithinHalfAndFalls) {
  // half of the work in 50 s, the other half at a quarter of the speed, in 200 s
  constexpr double whole = 250.0;
  TimeLeft left;
  EXPECT_FALSE(left.left(0.0));
  double before = 0.0;
  for (int second = 1; second < 250; ++second) {
    left.show(second, second <= 50 ? second / 100.0 : 0.5 + (second - 50) / 400.0);
    const double told = left.left(second).value_or(-1.0), right = whole - second;
    if (second == 1) {
      EXPECT_EQ(told, -1.0); // too little is done
    }
    if (second == 50) {
      EXPECT_NEAR(told, 50.0, 1.0);
    }
    if (second > 110) {
      EXPECT_LE(told, 1.5 * right) << second;
      EXPECT_GE(told, right / 1.5) << second;
      EXPECT_LE(told, before) << second;
    }
    before = told;
  }
}

TEST(TimeLeft, RisesWhereNothingIsHeardForLong) {
  TimeLeft left;
  for (int second = 1; second <= 10; ++second)
    left.show(second, 0.05 * second);
  EXPECT_NEAR(left.left(10.0).value(), 10.0, 1e-9);
  EXPECT_GT(left.left(100.0).value(), 100.0);
}

} // namespace
} // namespace time_left_test
} // namespace plyform
