// SPDX-License-Identifier: GPL-3.0-or-later
// Several specimens: their scatter, and limits of confidence that hold what they say.
#include "core/identify/fit_shear.hpp"
#include "core/identify/fit_tension.hpp"
#include "support/fit_curves.hpp"
#include "support/membrane_checks.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace plyform::specimens_test {
namespace {

const ShearTest bias = shear_test(BiasSpecimen{300.0, 100.0});

FitOptions stiff_machine() {
  FitOptions options;
  options.corrections.compliance = 0.0;
  return options;
}

/// The glass weave's loads times `factor`, up to 50 degrees.
Curve glass_curve(double factor, int rows = 60) {
  Curve curve{.file = "test.csv", .x_name = "d", .y_name = "F", .x = {}, .y = {}, .line = {}};
  for (int i = 0; i <= rows; ++i) {
    curve.x.push_back(extension_at(bias, 50.0 * degree) * i / rows);
    curve.y.push_back(factor * test_load(bias, glass_weave(), curve.x.back()));
    curve.line.push_back(i + 1);
  }
  return curve;
}

TEST(Statistics, AreStudents) {
  EXPECT_NEAR(student_95(2.0), 4.302653, 1e-6); // tables
  EXPECT_NEAR(student_95(9.0), 2.262157, 1e-6);
  EXPECT_NEAR(student_95(1e6), 1.959966, 1e-5);
  EXPECT_NEAR(student_beyond(4.302653, 2.0), 0.05, 1e-7);
  const Spread spread = spread_of({1.0, 2.0, 3.0});
  EXPECT_DOUBLE_EQ(spread.mean, 2.0);
  EXPECT_DOUBLE_EQ(spread.deviation, 1.0);
  EXPECT_NEAR(spread.limits, 4.302653 / std::sqrt(3.0), 1e-6);
  EXPECT_NEAR(minimum_of([](double x) { return (x - 0.3) * (x - 0.3); }, -1.0, 2.0), 0.3, 1e-5);
}

TEST(Specimens, CountTheSameHoweverManyRowsTheyHave) {
  Diagnostics diagnostics;
  const auto fit = identify_shear({glass_curve(0.9, 300), glass_curve(1.1, 30)}, bias,
                                  glass_weave(), stiff_machine(), diagnostics);
  ASSERT_TRUE(fit) << texts(diagnostics);
  for (const double g : {10.0, 30.0, 50.0}) // weights by the fitted load draw neither way
    EXPECT_NEAR(fit->law.at(g * degree).value /
                    glass_weave().crossings[0].shear.at(g * degree).value,
                1.0, 0.01);
  ASSERT_EQ(fit->specimens.size(), 2u);
  EXPECT_NEAR(fit->specimens[0].coefficients[0], 0.9 * 0.37044, 1e-6);
  EXPECT_NEAR(fit->specimens[1].coefficients[2], 1.1 * 1.03113, 1e-6);
  EXPECT_NEAR(fit->scatter.law, 0.1 * std::sqrt(2.0), 1e-6);
  EXPECT_NEAR(fit->scatter.coefficient[1].deviation, 0.1 * std::sqrt(2.0) * 0.84105, 1e-6);
  EXPECT_NEAR(fit->confidence.coefficient[0],
              student_95(1.0) * 0.1 * std::sqrt(2.0) * 0.37044 / std::sqrt(2.0), 1e-6);
  EXPECT_EQ(fit->specimen.front(), 0u);
  EXPECT_EQ(fit->specimen.back(), 1u);
  EXPECT_EQ(fit->angle.size(), 332u);
}

TEST(Specimens, LimitsOfOneHoldTheLawInNineteenOfTwentyCurves) {
  int coefficient = 0, law = 0;
  constexpr int curves = 300;
  for (unsigned seed = 1; seed <= curves; ++seed) {
    Diagnostics diagnostics;
    const auto fit = identify_shear(noisy_curve(glass_curve(1.0), 0.01, 0.002, seed), bias,
                                    glass_weave(), stiff_machine(), diagnostics);
    ASSERT_TRUE(fit) << texts(diagnostics);
    coefficient += std::abs(fit->law.k[0] - 0.37044) <= fit->confidence.coefficient[0];
    const double at = fit->confidence.law_at;
    law += std::abs(fit->law.at(at).value / glass_weave().crossings[0].shear.at(at).value - 1.0) <=
           fit->confidence.law;
  }
  EXPECT_NEAR(coefficient / static_cast<double>(curves), 0.95, 0.04); // 3 standard errors
  EXPECT_NEAR(law / static_cast<double>(curves), 0.95, 0.04);
}

TEST(Specimens, LimitsWidenWhereNeighboursGoTogether) {
  Curve wavy = glass_curve(1.0);
  const Curve rough = noisy_curve(wavy, 0.01, 0.0, 1);
  for (std::size_t i = 0; i < wavy.size(); ++i)
    wavy.y[i] *= 1.0 + 0.014 * std::sin(0.5 * static_cast<double>(i));
  Diagnostics diagnostics;
  const auto a = identify_shear(wavy, bias, glass_weave(), stiff_machine(), diagnostics);
  const auto b = identify_shear(rough, bias, glass_weave(), stiff_machine(), diagnostics);
  ASSERT_TRUE(a && b) << texts(diagnostics);
  EXPECT_GT(a->confidence.coefficient[0], 2.0 * b->confidence.coefficient[0]);
}

TEST(Specimens, OfYarnsScatterInTheirStiffness) {
  std::vector<Curve> curves;
  for (const double stiffness : {44000.0, 46000.0, 48000.0}) {
    Curve curve{.file = "yarn.csv", .x_name = "e", .y_name = "N", .x = {}, .y = {}, .line = {}};
    for (int i = 0; i <= 40; ++i) {
      curve.x.push_back(0.01 * i / 40.0);
      curve.y.push_back(stiffness * curve.x.back());
      curve.line.push_back(i + 1);
    }
    curves.push_back(curve);
  }
  Diagnostics diagnostics;
  const auto fit = identify_tension(curves, {}, stiff_machine(), diagnostics);
  ASSERT_TRUE(fit) << texts(diagnostics);
  EXPECT_NEAR(fit->law.stiffness, 46000.0, 100.0);
  EXPECT_NEAR(fit->scatter.coefficient[0].deviation, 2000.0, 1e-6);
  EXPECT_NEAR(fit->confidence.coefficient[0], 4.302653 * 2000.0 / std::sqrt(3.0), 1e-2);
}

TEST(Specimens, OfOtherLengthsHaveTheirCommonPart) {
  const auto yarn = [](double from, double to) {
    Curve curve{.file = "yarn.csv", .x_name = "e", .y_name = "N", .x = {}, .y = {}, .line = {}};
    for (int i = 0; i <= 40; ++i) {
      curve.x.push_back(from + (to - from) * i / 40.0);
      curve.y.push_back(46000.0 * curve.x.back());
      curve.line.push_back(i + 1);
    }
    return curve;
  };
  Diagnostics diagnostics;
  const auto fit =
      identify_tension({yarn(0.0, 0.01), yarn(0.0, 0.02)}, {}, stiff_machine(), diagnostics);
  ASSERT_TRUE(fit) << texts(diagnostics);
  EXPECT_DOUBLE_EQ(fit->quality.to, 0.01);
  EXPECT_FALSE(
      identify_tension({yarn(0.0, 0.01), yarn(0.011, 0.02)}, {}, stiff_machine(), diagnostics));
  EXPECT_NE(texts(diagnostics).find("0 rows up to a strain of 0.01, where the shortest"),
            std::string::npos)
      << texts(diagnostics);
}

} // namespace
} // namespace plyform::specimens_test
