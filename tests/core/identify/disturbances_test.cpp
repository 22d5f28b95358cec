// SPDX-License-Identifier: GPL-3.0-or-later
// What a machine adds to a curve of a known law: found, told by its size, and taken off.
// docs/verification/identification.md has how often and how well with noise of two kinds.
#include "core/identify/fit_shear.hpp"
#include "core/identify/fit_tension.hpp"
#include "support/fit_curves.hpp"
#include "support/membrane_checks.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace plyform::disturbances_test {
namespace {

const ShearTest bias = shear_test(BiasSpecimen{300.0, 100.0});

/// The glass weave's curve from an extension on, 61 rows to 55 degrees, with noise.
Curve glass_curve(unsigned seed, double from = 0.0, double of_load = 0.003,
                  double of_largest = 0.0005) {
  Curve curve{.file = "test.csv", .x_name = "d", .y_name = "F", .x = {}, .y = {}, .line = {}};
  const double end = extension_at(bias, 55.0 * degree);
  for (int i = 0; i <= 60; ++i) {
    curve.x.push_back(from + (end - from) * i / 60.0);
    curve.y.push_back(test_load(bias, glass_weave(), curve.x.back()));
    curve.line.push_back(i + 1);
  }
  return noisy_curve(curve, of_load, of_largest, seed);
}

double wrong_by(const ShearLaw& law) {
  double largest = 0.0;
  for (double g = 5.0; g <= 55.0; g += 0.5)
    largest = std::max(largest, std::abs(law.at(g * degree).value /
                                             glass_weave().crossings[0].shear.at(g * degree).value -
                                         1.0));
  return largest;
}

ShearOutcome identify(const Curve& curve, const FitOptions& options = {}) {
  return identify_glass({curve}, bias, options);
}

TEST(Disturbances, AreNotFoundWhereThereAreNone) {
  int alarms = 0;
  for (unsigned seed = 1; seed <= 100; ++seed)
    for (const double noise : {0.003, 0.01}) {
      const ShearOutcome outcome = identify(glass_curve(seed, 0.0, noise, 0.2 * noise));
      ASSERT_TRUE(outcome.fit) << outcome.texts;
      alarms += outcome.says("the rows show");
    }
  EXPECT_LE(alarms, 2); // four kinds, each once in a thousand curves by chance
}

TEST(Disturbances, ALoadZeroIsRefusedAndTakenOff) {
  for (const double share : {-0.018, 0.02}) {
    Curve curve = glass_curve(3);
    const double zero = share * curve.y.back();
    for (double& y : curve.y)
      y += zero;
    const ShearOutcome refused = identify(curve);
    EXPECT_FALSE(refused.fit);
    EXPECT_TRUE(refused.says("a load zero off by") && refused.says("--zero fit takes it off"))
        << refused.texts;
    FitOptions options;
    options.corrections.fit_load_zero = true;
    const ShearOutcome found = identify(curve, options);
    ASSERT_TRUE(found.fit) << found.texts;
    const Corrected& taken = found.fit->specimens[0].corrected;
    EXPECT_NEAR(taken.load_zero, zero, 2.0 * taken.load_zero_limits);
    EXPECT_LT(wrong_by(found.fit->law), 0.04); // 92 % before
    options.corrections = {};
    options.corrections.load_zero = zero;
    EXPECT_LT(wrong_by(identify(curve, options).fit->law), 0.02);
    options.corrections.load_zero = 0.0; // the user knows better
    EXPECT_TRUE(identify(curve, options).fit);
  }
}

TEST(Disturbances, ADisplacementZeroIsTakenOffEitherWay) {
  for (const double late : {-1.0, 1.0}) {
    Curve curve = glass_curve(5, std::max(late, 0.0), 0.001, 0.0002); // less shows no millimetre
    for (double& x : curve.x)
      x -= late;
    if (late < 0.0) {
      curve.x.insert(curve.x.begin(), 0.0);
      curve.y.insert(curve.y.begin(), 0.0);
      curve.line.insert(curve.line.begin(), 0);
    }
    const ShearOutcome plain = identify(curve);
    ASSERT_TRUE(plain.fit) << plain.texts;
    EXPECT_GT(wrong_by(plain.fit->law), 0.09);
    EXPECT_TRUE(plain.says(late > 0.0 ? "too late" : "slack up to")) << plain.texts;
    FitOptions options;
    options.corrections.fit_toe = true;
    const ShearOutcome found = identify(curve, options);
    ASSERT_TRUE(found.fit) << found.texts;
    const Corrected& taken = found.fit->specimens[0].corrected;
    EXPECT_NEAR(taken.toe, -late, 2.0 * taken.toe_limits);
    EXPECT_LT(wrong_by(found.fit->law), 0.06);
    options.corrections = {};
    options.corrections.toe = -late;
    EXPECT_LT(wrong_by(identify(curve, options).fit->law), 0.01);
  }
}

TEST(Disturbances, ADisplacementZeroThatNoiseHidesIsToldOf) {
  Curve curve = glass_curve(5, 1.0, 0.01, 0.002);
  for (double& x : curve.x)
    x -= 1.0;
  const ShearOutcome plain = identify(curve);
  ASSERT_TRUE(plain.fit) << plain.texts;
  EXPECT_TRUE(plain.says("not known from this curve: the displacement zero (known to"))
      << plain.texts;
  FitOptions options;
  options.corrections.toe = 0.0; // the user knows
  EXPECT_FALSE(identify(curve, options).says("not known"));
  options.corrections = {};
  options.corrections.fit_toe = true; // and the limits say how little that helps
  const ShearOutcome found = identify(curve, options);
  ASSERT_TRUE(found.fit) << found.texts;
  EXPECT_GT(found.fit->confidence.law, 2.0 * plain.fit->confidence.law);
}

TEST(Disturbances, ComplianceIsToldOfAndTakenOff) {
  Curve curve = glass_curve(7);
  for (std::size_t i = 0; i < curve.size(); ++i)
    curve.x[i] += 0.02 * curve.y[i];
  Diagnostics diagnostics;
  const auto plain = identify_shear(curve, bias, glass_weave(), {}, diagnostics);
  ASSERT_TRUE(plain) << texts(diagnostics);
  EXPECT_NE(
      texts(diagnostics)
          .find("not known from this curve: the compliance of machine and clamps (0.01 mm/N would"),
      std::string::npos);
  EXPECT_GT(wrong_by(plain->law), 0.07);
  FitOptions options;
  options.corrections.compliance = 0.02;
  EXPECT_LT(wrong_by(identify(curve, options).fit->law), 0.01);
  options.corrections.compliance = 2.0;
  const ShearOutcome refused = identify(curve, options);
  EXPECT_FALSE(refused.fit);
  EXPECT_TRUE(refused.says("nine tenths or more")) << refused.texts;
}

TEST(Disturbances, ASuddenSlipIsFoundAtItsRow) {
  for (const std::size_t row : {15u, 30u, 50u}) {
    Curve curve = glass_curve(9);
    for (std::size_t i = row; i < curve.size(); ++i)
      curve.x[i] += 5.0;
    const ShearOutcome plain = identify(curve);
    EXPECT_FALSE(plain.fit);
    EXPECT_TRUE(plain.says("a slip of") && plain.says("before line " + std::to_string(row + 1)))
        << plain.texts;
    FitOptions options;
    options.corrections.fit_slip = true;
    const ShearOutcome found = identify(curve, options);
    ASSERT_TRUE(found.fit) << found.texts;
    const Corrected& taken = found.fit->specimens[0].corrected;
    EXPECT_NEAR(taken.slip, 5.0, 2.0 * taken.slip_limits);
    EXPECT_EQ(taken.slip_line, static_cast<int>(row) + 1);
    EXPECT_LT(wrong_by(found.fit->law), 0.05); // 45 % before
  }
}

TEST(Disturbances, SlipThatGoesOnIsSeenByTheMeasuredAngle) {
  Curve curve = glass_curve(11);
  const double end = curve.x.back();
  for (double& x : curve.x) {
    curve.angle.push_back(shear_angle(bias, x));
    x *= 1.0 + 5.0 / end;
  }
  curve.angle_name = "gamma";
  const ShearOutcome plain = identify(curve);
  EXPECT_TRUE(plain.says("the measured shear angle (gamma) is up to") &&
              plain.says("--angle-column gamma takes the measured one"))
      << plain.texts;
  ASSERT_TRUE(plain.fit) << plain.texts;
  EXPECT_GT(wrong_by(plain.fit->law), 0.4);
  FitOptions options;
  options.measured_angle = true;
  const ShearOutcome found = identify(curve, options);
  ASSERT_TRUE(found.fit) << found.texts;
  EXPECT_LT(wrong_by(found.fit->law), 0.01);
  EXPECT_TRUE(found.says("the law is of the measured angle")) << found.texts;
}

TEST(Disturbances, AThousandTimesTheLoadIsNoFabric) {
  for (const double factor : {1e-3, 1e3}) {
    Curve curve = glass_curve(13);
    for (double& y : curve.y)
      y *= factor;
    const ShearOutcome refused = identify(curve);
    EXPECT_FALSE(refused.fit);
    EXPECT_TRUE(refused.says("is no fabric's: usually 0.001 to 10 N/mm")) << refused.texts;
    FitOptions options;
    options.doubtful = true;
    EXPECT_TRUE(identify(curve, options).fit);
  }
}

TEST(Disturbances, OfAStripAreFoundAndTakenOff) {
  Curve curve{.file = "strip.csv", .x_name = "d", .y_name = "F", .x = {}, .y = {}, .line = {}};
  for (int i = 0; i <= 60; ++i) {
    curve.x.push_back(0.1 + 2.0 * i / 60.0);
    curve.y.push_back(25.0 * 46000.0 / 200.0 * (curve.x.back() - 0.1));
    curve.line.push_back(i + 1);
  }
  curve = noisy_curve(curve, 0.003, 0.0005, 1);
  FitOptions options;
  options.corrections.compliance = 0.0;
  Diagnostics diagnostics;
  const auto plain = identify_tension(curve, {25.0, 200.0}, options, diagnostics);
  ASSERT_TRUE(plain) << texts(diagnostics);
  EXPECT_GT(std::abs(plain->law.stiffness / 46000.0 - 1.0), 0.03);
  EXPECT_NE(texts(diagnostics).find("slack up to 0.1"), std::string::npos) << texts(diagnostics);
  EXPECT_NE(texts(diagnostics).find("a load zero off by -"), std::string::npos); // looks the same
  options.corrections.fit_toe = true;
  const auto found = identify_tension(curve, {25.0, 200.0}, options, diagnostics);
  ASSERT_TRUE(found) << texts(diagnostics);
  EXPECT_NEAR(found->specimens[0].corrected.toe, 0.1, 0.01);
  EXPECT_NEAR(found->law.stiffness / 46000.0, 1.0, 0.01);
}

} // namespace
} // namespace plyform::disturbances_test
