// SPDX-License-Identifier: GPL-3.0-or-later
// Sums and extremes of fields, against values that can be added up by hand.
#include "core/results/statistics.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace plyform::statistics_test {
namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

TEST(Statistics, ExtremesAreOfValuesOrOfMagnitudes) {
  const std::vector<double> values{1, -4, 3};
  EXPECT_EQ(largest(values), 3);
  EXPECT_EQ(smallest(values), -4);
  EXPECT_EQ(largest_magnitude(values), 4);
  EXPECT_EQ(largest({-2, -1}), -1) << "not 0";
  EXPECT_EQ(smallest({2, 1}), 1) << "not 0";
}

TEST(Statistics, AreWeightedByArea) {
  // 98 of 100 mm2 have 1, the rest 2 and -3
  const std::vector<double> values{2, 1, -3}, areas{1, 98, 1};
  EXPECT_EQ(percentile(values, areas, 0.5), 1);
  EXPECT_EQ(percentile(values, areas, 0.98), 1);
  EXPECT_EQ(percentile(values, areas, 0.99), 2);
  EXPECT_EQ(percentile(values, areas, 1.0), 3);
  EXPECT_DOUBLE_EQ(root_mean_square(values, areas), std::sqrt((4 + 98 + 9) / 100.0));
  EXPECT_EQ(area_share_above(values, 1, areas), 0.01) << "above, not at";
  EXPECT_EQ(area_share_above(values, 0.5, areas), 0.99);
}

TEST(Statistics, AnExactShareOfThePercentileStandsRoundingOff) {
  // 0.1 is no binary fraction: 198 of them add up to less than 0.99 times the sum of 200.
  std::vector<double> values, areas(200, 0.1);
  for (int i = 1; i <= 200; ++i)
    values.push_back(i);
  EXPECT_EQ(percentile(values, areas, 0.99), 198);
}

TEST(Statistics, OfValuesOneOfWhichIsNoNumberAreNone) {
  for (const std::vector<double>& values :
       {std::vector<double>{nan_value, 1, 2}, {1, nan_value, 2}, {1, 2, nan_value}}) {
    const std::vector<double> areas{1, 1, 1};
    EXPECT_TRUE(std::isnan(largest(values)));
    EXPECT_TRUE(std::isnan(smallest(values)));
    EXPECT_TRUE(std::isnan(largest_magnitude(values)));
    EXPECT_TRUE(std::isnan(percentile(values, areas, 0.1)));
    EXPECT_TRUE(std::isnan(root_mean_square(values, areas)));
    EXPECT_TRUE(std::isnan(area_share_above(values, 5, areas)));
  }
}

TEST(Statistics, OfNoValues) {
  EXPECT_TRUE(std::isnan(largest({})));
  EXPECT_TRUE(std::isnan(smallest({})));
  EXPECT_EQ(largest_magnitude({}), 0);
  EXPECT_EQ(percentile({}, {}, 0.99), 0);
  EXPECT_EQ(root_mean_square({}, {}), 0);
  EXPECT_EQ(area_share_above({}, 1, {}), 0);
}

} // namespace
} // namespace plyform::statistics_test
