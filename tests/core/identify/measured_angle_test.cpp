// SPDX-License-Identifier: GPL-3.0-or-later
// Which angle a law is taken from.
#include "base/geometry.hpp"
#include "core/identify/measured_angle.hpp"
#include "support/fit_curves.hpp"

#include <gtest/gtest.h>

namespace plyform::measured_angle_test {
namespace {

const ShearTest bias = shear_test(BiasSpecimen{450.0, 150.0});

/// Rows at 0 to 50 degrees by the formula, of which the measured angle is `share`.
Curve curve_with(double share) {
  Curve curve{.file = "test.csv", .x_name = "d", .y_name = "F", .x = {}, .y = {}, .line = {}};
  for (int i = 0; i <= 50; ++i) {
    curve.x.push_back(extension_at(bias, i * degree));
    curve.y.push_back(i);
    curve.line.push_back(i + 2);
    curve.angle.push_back(share * i * degree);
  }
  return curve;
}

TEST(MeasuredAngle, CountsWhereItIsAnotherThanTheFormulas) {
  EXPECT_TRUE(angles_count({curve_with(0.8)}, bias));
  EXPECT_TRUE(angles_count({curve_with(1.0), curve_with(0.8)}, bias));
  EXPECT_FALSE(angles_count({curve_with(1.0)}, bias)); // written by the formula
  EXPECT_FALSE(angles_count({}, bias));
  Curve without = curve_with(0.8);
  without.angle.clear();
  EXPECT_FALSE(angles_count({without, curve_with(0.8)}, bias));
  Curve alone = curve_with(1.0);
  alone.x_name.clear();
  EXPECT_TRUE(angles_count({alone}, bias));
  EXPECT_TRUE(angles_count({alone}, std::nullopt));
}

TEST(MeasuredAngle, DiffersByMeansOfTenthsOfTheRows) {
  const AngleDifference d = angle_difference(curve_with(0.8), bias);
  EXPECT_NEAR(d.largest, 0.2 * 47.5 * degree, 0.01 * degree); // the last tenth: 45 to 50 degrees
  EXPECT_NEAR(d.at, 0.8 * 47.5 * degree, 0.01 * degree);
}

} // namespace
} // namespace plyform::measured_angle_test
