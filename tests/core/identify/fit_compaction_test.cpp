// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/fit_compaction.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace plyform::fit_compaction_test {
namespace {

constexpr double fibres = 0.25; // mm

/// Of fibre volumes and N/mm^2.
Curve volumes(const std::vector<double>& v, const std::vector<double>& p) {
  Curve curve;
  curve.file = "c.csv", curve.x_name = "volume", curve.y_name = "pressure";
  curve.x = v, curve.y = p;
  curve.x_is = Quantity::strain;
  for (std::size_t i = 0; i < v.size(); ++i)
    curve.line.push_back(static_cast<int>(i) + 2);
  return curve;
}

/// V at 30 pressures, from 0.001 to 1 N/mm^2, by bisection of `p` between `low` and `high`.
template <class Law>
Curve measured(const Law& p, double low, double high, double noise = 0.0, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<double> scatter(0.0, noise > 0.0 ? noise : 1.0);
  std::vector<double> v, pressures;
  for (int i = 0; i < 30; ++i) {
    pressures.push_back(std::pow(10.0, -3.0 + 3.0 * i / 29.0));
    double a = low, b = high;
    for (int k = 0; k < 80; ++k)
      (p(0.5 * (a + b)) < pressures.back() ? a : b) = 0.5 * (a + b);
    v.push_back(0.5 * (a + b) * (noise > 0.0 ? 1.0 + scatter(random) : 1.0));
  }
  return volumes(v, pressures);
}

double gutowski(double v) { // A 280 Pa, V0 0.30, Va 0.70
  return 280e-6 * (v / 0.30 - 1.0) / std::pow(1.0 / v - 1.0 / 0.70, 4.0);
}

double toll_manson(double v) {
  return 60.0 * (std::pow(v, 9.0) - std::pow(0.45, 9.0));
}

TEST(IdentifyCompaction, FindsGutowskisNumbers) {
  Diagnostics diagnostics;
  const auto fit = identify_compaction({measured(gutowski, 0.30, 0.70)}, {}, {fibres, 1.0},
                                       CompactionForm::gutowski, diagnostics);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->scale, 280e-6, 0.01 * 280e-6);
  EXPECT_NEAR(fit->free_volume, 0.30, 0.003);
  EXPECT_NEAR(fit->shape, 0.70, 0.007);
  for (std::size_t i = 0; i < fit->pressure.size(); ++i) // as the table that is written
    EXPECT_NEAR(fit->fitted[i], fit->measured[i], 0.01 * fit->measured[i]) << fit->pressure[i];
}

TEST(IdentifyCompaction, OfAPublishedCurveEachThicknessIsWithinAPercent) {
  const std::vector<double> v{0.52, 0.545, 0.570, 0.600, 0.665, 0.685};
  const std::vector<double> p{0.0, 0.1014, 0.3447, 0.8274, 2.7579, 6.8948};
  Diagnostics diagnostics;
  const auto fit = identify_compaction({volumes(v, p)}, {}, {fibres, 1.0}, {}, diagnostics);
  ASSERT_TRUE(fit);
  EXPECT_EQ(fit->form, CompactionForm::table); // the law of three numbers is 2 % off
  for (std::size_t i = 0; i < v.size(); ++i)
    EXPECT_NEAR(fit->fitted[i], fibres / v[i], 0.01 * fibres / v[i]) << p[i];
}

TEST(IdentifyCompaction, ChoosesTheLawThatRowsHaveOfAStackToo) {
  Curve stack = measured(toll_manson, 0.45, 0.90);
  stack.x_is = Quantity::length;
  for (double& x : stack.x)
    x = 8.0 * fibres / x; // thickness of eight plies
  Diagnostics diagnostics;
  const auto fit = identify_compaction({stack}, {}, {fibres, 8.0}, {}, diagnostics);
  ASSERT_TRUE(fit);
  EXPECT_EQ(fit->form, CompactionForm::toll_manson);
  EXPECT_NEAR(fit->scale, 60.0, 0.6);
  EXPECT_NEAR(fit->shape, 9.0, 0.09);
  EXPECT_NEAR(fit->free_volume, 0.45, 0.0045);
}

/// Of 20 curves with noise of 1 % in thickness each number is within its 95 % limits in 16 or more,
/// by chance less than once in 400 if the limits are right.
TEST(IdentifyCompaction, NumbersOfNoisyCurvesAreWithinTheirLimits) {
  int scale = 0, shape = 0, rest = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Diagnostics diagnostics;
    const auto fit = identify_compaction({measured(toll_manson, 0.45, 0.90, 0.01, seed)}, {},
                                         {fibres, 1.0}, {}, diagnostics);
    ASSERT_TRUE(fit) << seed;
    EXPECT_EQ(fit->form, CompactionForm::toll_manson) << seed;
    // s and n go together: s is judged by the law's own scale, its logarithm
    scale += std::abs(std::log(fit->scale / 60.0)) <= fit->scale_limits / fit->scale;
    shape += std::abs(fit->shape - 9.0) <= fit->shape_limits;
    rest += std::abs(fit->free_volume - 0.45) <= fit->free_limits;
  }
  EXPECT_GE(scale, 16);
  EXPECT_GE(shape, 16);
  EXPECT_GE(rest, 16);
}

TEST(IdentifyCompaction, OpeningGoesItsOwnWayToTheSameEnd) {
  const auto opening = [](double v) {
    return 60.0 * (std::pow(v, 9.0) - std::pow(0.50, 9.0)) / 1.2;
  };
  Diagnostics diagnostics;
  const auto fit =
      identify_compaction({measured(toll_manson, 0.45, 0.90)}, {measured(opening, 0.50, 0.90)},
                          {fibres, 1.0}, {}, diagnostics);
  ASSERT_TRUE(fit);
  EXPECT_EQ(fit->form, CompactionForm::table);
  EXPECT_NEAR(fibres / fit->unloading.thickness.front(), 0.50, 0.005);
  EXPECT_EQ(fit->unloading.thickness.back(), fit->loading.thickness.back());
  EXPECT_EQ(fit->unloading.pressure.back(), fit->loading.pressure.back());
}

TEST(IdentifyCompaction, RefusesWhatIsNone) {
  for (const Curve& curve :
       {volumes({0.5, 0.6, 0.95}, {0, 1, 2}), volumes({0.5, 0.6}, {0, 1}),
        volumes({0.6, 0.55, 0.5}, {0, 1, 2}), volumes({0.5, 0.6, 0.7}, {-1, 1, 2})}) {
    Diagnostics diagnostics;
    EXPECT_FALSE(identify_compaction({curve}, {}, {fibres, 1.0}, {}, diagnostics));
    ASSERT_EQ(diagnostics.errors.size(), 1U);
    EXPECT_EQ(diagnostics.errors[0].file, "c.csv");
  }
}

} // namespace
} // namespace plyform::fit_compaction_test
