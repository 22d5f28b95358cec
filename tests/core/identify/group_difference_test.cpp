// SPDX-License-Identifier: GPL-3.0-or-later
// Student's test of two kinds of specimens by hand, and how often it errs.
#include "core/identify/group_difference.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <stdexcept>

namespace plyform::group_difference_test {
namespace {

TEST(GroupDifference, IsStudentsTestOfLogarithms) {
  // ln: means 0.2 and 0.5, squares 0.02 and 0.02, four degrees of freedom:
  // t = 0.3 / sqrt(0.04 / 4 * 2 / 3) = 3.674, two-sided chance 0.0213.
  const auto e = [](double x) { return std::exp(x); };
  const GroupDifference d = difference_of({e(0.1), e(0.2), e(0.3)}, {e(0.4), e(0.5), e(0.6)});
  EXPECT_NEAR(d.ratio, std::exp(0.3), 1e-12);
  EXPECT_NEAR(d.chance, 0.0213, 1e-4);
  const double half = 2.7764451 * 0.0816497; // t(97.5 %, 4) times the standard error
  EXPECT_NEAR(d.least, std::exp(0.3 - half), 1e-5);
  EXPECT_NEAR(d.most, std::exp(0.3 + half), 1e-5);
  EXPECT_TRUE(d.between_specimens);
  EXPECT_FALSE(d.differs());
}

TEST(GroupDifference, TakesTheLimitsOfSingleSpecimens) {
  EXPECT_TRUE(difference_of({1.0}, {1.2}, {0.05, 0.05}).differs());
  const GroupDifference close = difference_of({1.0}, {1.06}, {0.05, 0.05});
  EXPECT_FALSE(close.differs());
  EXPECT_FALSE(close.between_specimens);
  EXPECT_FALSE(difference_of({1.0}, {1.08}, {0.01, 0.01}).differs()); // as specimens do
  EXPECT_FALSE(difference_of({1.0}, {0.92}, {0.01, 0.01}).differs());
  EXPECT_TRUE(difference_of({1.0}, {1.15}, {0.01, 0.01}).differs());
  EXPECT_NEAR(difference_of({1.0}, {1.15}, OwnLimits{}).most, 1.15 * std::exp(0.1), 1e-3);
  EXPECT_FALSE(difference_of({1.0}, {1.01}, {1e-4, 1e-4}).differs()); // sure, but it is nothing
  EXPECT_FALSE(difference_of({1.0}, {1.0}, OwnLimits{}).differs());
  EXPECT_THROW(difference_of({}, {1.0}), std::invalid_argument);
  EXPECT_THROW(difference_of({0.0}, {1.0}), std::invalid_argument);
}

/// How often laws of two groups of three, which differ by `by`, are told to differ.
double told(double by, double scatter) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  constexpr int trials = 1000;
  int found = 0;
  for (int i = 0; i < trials; ++i) {
    const auto group = [&](double level) {
      std::vector<std::vector<double>> laws;
      for (int n = 0; n < 3; ++n) {
        const double start = scatter * normal(random), end = scatter * normal(random);
        laws.emplace_back();
        for (int p = 0; p <= 20; ++p) // specimens differ in level and in shape
          laws.back().push_back(level * (1.0 + start + (end - start) * p / 20.0));
      }
      return laws;
    };
    std::vector<double> places;
    for (int p = 0; p <= 20; ++p)
      places.push_back(p);
    found += difference_of(places, group(1.0), group(1.0 + by)).differs();
  }
  return static_cast<double>(found) / trials;
}

TEST(GroupDifference, IsFoundWhereItIsAndHardlyWhereNot) {
  EXPECT_LT(told(0.0, 0.05), 0.05); // 21 places that go together
  EXPECT_GT(told(0.4, 0.05), 0.9);
}

} // namespace
} // namespace plyform::group_difference_test
