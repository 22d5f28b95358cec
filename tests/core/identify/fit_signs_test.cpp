// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of both signs, and of stitches, from the curves that they make both ways.
#include "core/identify/fit_signs.hpp"
#include "core/identify/fit_stitch.hpp"
#include "core/identify/stitch_load.hpp"
#include "support/fit_curves.hpp"
#include "support/membrane_checks.hpp"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace plyform::fit_signs_test {
namespace {

constexpr double pi = std::numbers::pi;
const ShearTest frame = shear_test(FrameSpecimen{200.0});
const ShearTest strip = shear_test(BiasSpecimen{300.0, 100.0});

Fabric stitched(double stiffness, double taut_at, double breaks_at = 1e9) {
  Fabric fabric = glass_weave();
  fabric.stitches = {stitch_at(0.25 * pi, stiffness, taut_at)};
  fabric.stitches[0].law.breaking_force = fabric.stitches[0].law.at(breaks_at).value;
  return fabric;
}

/// The curve of a fabric, its loads times `level`.
Curve curve_of(const ShearTest& test, const Fabric& fabric, bool negative, double level = 1.0,
               double to_deg = 50.0, int rows = 60) {
  Curve curve{.file = negative ? "negative.csv" : "positive.csv",
              .x_name = "d",
              .y_name = "F",
              .x = {},
              .y = {},
              .line = {}};
  for (int i = 0; i <= rows; ++i) {
    const double d = extension_at(test, to_deg * degree) * i / rows;
    curve.x.push_back(d);
    curve.y.push_back(level * (test_load(test, fabric, d, negative) +
                               stitch_load(test, fabric, stitches_of(fabric), d, negative)));
    curve.line.push_back(i + 1);
  }
  return curve;
}

FitOptions exact() {
  FitOptions options;
  options.corrections.compliance = options.corrections.toe = options.corrections.load_zero = 0.0;
  return options;
}

StitchFit stitch_of(const SignedCurves& curves, const ShearTest& test, Fabric base) {
  Diagnostics diagnostics;
  const auto fit = identify_stitch(curves, {0}, test, base, exact(), diagnostics);
  EXPECT_TRUE(fit) << texts(diagnostics);
  return fit ? *fit : StitchFit{};
}

TEST(IdentifySigns, GivesTwoPolynomialsWhereTheSidesDiffer) {
  Fabric fabric = glass_weave();
  const std::vector<double> k = fabric.crossings[0].shear.k;
  fabric.crossings[0].shear.negative_k = {0.5 * k[0], 0.3 * k[1], 0.2 * k[2]};
  Diagnostics diagnostics;
  const auto fit = identify_signs({curve_of(strip, fabric, false)}, {curve_of(strip, fabric, true)},
                                  strip, glass_weave(), exact(), diagnostics);
  ASSERT_TRUE(fit) << texts(diagnostics);
  EXPECT_TRUE(fit->difference.differs());
  EXPECT_FALSE(fit->both);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(fit->law.k[i], k[i], 1e-6);
    EXPECT_NEAR(fit->law.negative_k[i], fabric.crossings[0].shear.negative_k[i], 1e-6);
  }
}

/// n specimens of one side with levels that scatter by 4 %.
std::vector<Curve> several(const Fabric& fabric, bool negative, double level, unsigned seed) {
  std::vector<Curve> curves;
  for (unsigned n = 0; n < 3; ++n)
    curves.push_back(noisy_curve(curve_of(frame, fabric, negative, level * (0.96 + 0.04 * n)),
                                 0.005, 0.0, seed + n));
  return curves;
}

TEST(IdentifySigns, GivesOneLawWhereTheyDoNotDifferBeyondScatter) {
  const Fabric fabric = glass_weave();
  Diagnostics diagnostics;
  const auto same = identify_signs(several(fabric, false, 1.0, 1), several(fabric, true, 0.97, 5),
                                   frame, fabric, exact(), diagnostics);
  ASSERT_TRUE(same) << texts(diagnostics);
  EXPECT_TRUE(same->law.odd());
  EXPECT_NEAR(same->law.at(0.5).value / fabric.crossings[0].shear.at(0.5).value, 0.985, 0.01);
  const auto less = identify_signs(several(fabric, false, 1.0, 1), several(fabric, true, 0.7, 5),
                                   frame, fabric, exact(), diagnostics);
  ASSERT_TRUE(less) << texts(diagnostics);
  EXPECT_FALSE(less->law.odd());
  EXPECT_NEAR(less->law.at(-0.5).value / less->law.at(0.5).value, -0.7, 0.02);
}

TEST(IdentifySigns, JoinsTablesAndPolynomialsThroughZero) {
  ShearLaw polynomial, table;
  polynomial.k = {0.37, 0.84, 1.03};
  table.angle = {0.0, 0.05, 0.5, 1.0};
  table.torque = {0.0, 0.2, 0.4, 2.0};
  const ShearLaw law = law_of_both_signs(polynomial, 1.0, table, 1.0);
  for (const double g : {0.1, 0.3, 0.6, 1.0})
    EXPECT_NEAR(law.at(g).value / polynomial.at(g).value, 1.0, g > 0.2 ? 2e-3 : 0.03) << g;
  for (std::size_t i = 1; i < 4; ++i)
    EXPECT_DOUBLE_EQ(law.at(-table.angle[i]).value, -table.torque[i]);
  EXPECT_EQ(law.at(0.0).value, 0.0);
}

/// A static torque that is reached within a degree on one side, a soft polynomial on the other: the
/// slopes at 0 differ by a factor of forty.
TEST(IdentifySigns, KeepsTheLawOfEachSideNearZero) {
  ShearLaw soft, stiff;
  soft.k = {0.2, 0.3, 0.5};
  stiff.angle = {0.0, 0.01, 0.02, 0.3, 0.6, 0.9};
  stiff.torque = {0.0, 0.08, 0.1, 0.2, 0.5, 1.2};
  ShearLaw steep; // a table whose first point is far out
  steep.angle = {0.0, 0.2, 0.9}, steep.torque = {0.0, 0.5, 1.0};
  for (const auto& [a, b] :
       {std::pair{stiff, soft}, {soft, stiff}, {steep, soft}, {stiff, steep}}) {
    const ShearLaw law = law_of_both_signs(a, 0.9, b, 0.8);
    double worst = 0.0;
    for (double g = 0.25; g < 45.0; g += 0.01) {
      worst = std::max(worst, std::abs(law.at(g * degree).value / a.at(g * degree).value - 1.0));
      worst = std::max(worst, std::abs(law.at(-g * degree).value / -b.at(g * degree).value - 1.0));
    }
    fmt::print("{} rows, within {:.2g} %\n", law.angle.size(), 100.0 * worst);
    EXPECT_LT(worst, 0.011);
    EXPECT_LT(law.angle.size(), 50u);
  }
}

/// Single specimens of one fabric, whose levels scatter by 3 %, show no difference of the signs.
TEST(IdentifySigns, TakesScatterOfSingleSpecimensForNoDifference) {
  const Fabric fabric = glass_weave();
  std::mt19937 random(3);
  std::normal_distribution<double> normal(1.0, 0.03);
  const auto one = [&](bool negative, double level, unsigned seed) {
    return std::vector{noisy_curve(curve_of(frame, fabric, negative, level), 0.005, 0.0, seed)};
  };
  int told = 0;
  for (unsigned seed = 0; seed < 8; ++seed) {
    Diagnostics diagnostics;
    const double first = normal(random), second = normal(random);
    const auto fit = identify_signs(one(false, first, 2 * seed), one(true, second, 2 * seed + 1),
                                    frame, fabric, exact(), diagnostics);
    ASSERT_TRUE(fit) << texts(diagnostics);
    told += fit->difference.differs();
  }
  EXPECT_EQ(told, 0);
}

TEST(IdentifyStitch, FindsLineSlackAndBreakAgain) {
  struct Known {
    double stiffness, taut_at, breaks_at;
  };
  for (const ShearTest& test : {frame, strip})
    for (const Known& known : {Known{24.0, 0.0, 1e9}, Known{24.0, 0.02, 1e9},
                               Known{10.0, 0.05, 0.15}, Known{24.0, 0.02, 0.195}}) {
      const Fabric fabric = stitched(known.stiffness, known.taut_at, known.breaks_at);
      const StitchFit fit = stitch_of(
          {{curve_of(test, fabric, false)}, {curve_of(test, fabric, true)}}, test, stitched(1, 0));
      ASSERT_TRUE(fit.line);
      EXPECT_NEAR(fit.law.tension.stiffness / known.stiffness, 1.0, 0.01);
      EXPECT_NEAR(fit.law.taut_at, known.taut_at, 0.001);
      EXPECT_EQ(fit.breaks, known.breaks_at < 1.0);
      if (fit.breaks) {
        EXPECT_NEAR(fit.law.breaking_force / fabric.stitches[0].law.breaking_force, 1.0, 0.06);
      }
      EXPECT_NEAR(fit.slack.law.at(0.5).value / fabric.crossings[0].shear.at(0.5).value, 1.0, 1e-6);
    }
}

TEST(IdentifyStitch, FindsAPreTensionAgain) {
  const Fabric fabric = stitched(3.0, -0.1); // 0.3 N from the start
  Fabric base = stitched(1.0, -0.2);
  const StitchFit fit =
      stitch_of({{curve_of(frame, fabric, false)}, {curve_of(frame, fabric, true)}}, frame, base);
  EXPECT_NEAR(fit.law.tension.stiffness, 3.0, 0.03);
  EXPECT_NEAR(fit.law.at(0.0).value, 0.3, 0.003);
}

TEST(IdentifyStitch, TakesATableWhereNoLineFits) {
  Fabric fabric = stitched(1.0, 0.0);
  StitchLaw& law = fabric.stitches[0].law;
  law.tension.strain = {0.0, 0.1, 0.3}, law.tension.tension = {0.0, 1.0, 12.0};
  const StitchFit fit = stitch_of(
      {{curve_of(frame, fabric, false)}, {curve_of(frame, fabric, true)}}, frame, stitched(1, 0));
  ASSERT_FALSE(fit.line);
  for (const double e : {0.05, 0.15, 0.25, 0.3})
    EXPECT_NEAR(fit.law.at(e).value / law.at(e).value, 1.0, 0.1) << e;
}

/// Noise of 1 % of the load: limits hold the truth about as often as they say.
TEST(IdentifyStitch, StaysWithinItsLimitsWithNoise) {
  const Fabric fabric = stitched(24.0, 0.02);
  int inside = 0;
  double worst = 0.0;
  constexpr int trials = 20;
  for (unsigned seed = 0; seed < trials; ++seed) {
    const StitchFit fit =
        stitch_of({{noisy_curve(curve_of(frame, fabric, false), 0.01, 0.0, 2 * seed)},
                   {noisy_curve(curve_of(frame, fabric, true), 0.01, 0.0, 2 * seed + 1)}},
                  frame, stitched(1, 0));
    const double off = fit.law.tension.stiffness - 24.0;
    worst = std::max(worst, std::abs(off));
    inside += std::abs(off) < fit.stiffness_limits;
  }
  fmt::print("stiffness 24 N found within {:.2g} N, {} of {} within limits\n", worst, inside,
             trials);
  EXPECT_LT(worst, 2.4);
  EXPECT_GE(inside, 16);
}

/// Specimens whose levels differ by some percent between the sides too: the break is found all the
/// same, and limits are of their scatter.
TEST(IdentifyStitch, FindsABreakBesideScatterOfSpecimens) {
  const Fabric fabric = stitched(24.0, 0.02, 0.195);
  SignedCurves curves;
  for (unsigned n = 0; n < 3; ++n) {
    curves.positive.push_back(
        noisy_curve(curve_of(frame, fabric, false, 0.95 + 0.06 * n), 0.01, 0.0005, n));
    curves.negative.push_back(
        noisy_curve(curve_of(frame, fabric, true, 1.08 - 0.06 * n), 0.01, 0.0005, 10 + n));
  }
  const StitchFit fit = stitch_of(curves, frame, stitched(1, 0));
  EXPECT_TRUE(fit.limits_between);
  EXPECT_TRUE(fit.breaks);
  EXPECT_NEAR(fit.law.tension.stiffness, 24.0, fit.stiffness_limits);
  EXPECT_LT(fit.stiffness_limits, 8.0);
}

TEST(IdentifyStitch, RefusesWhatShowsNoStitch) {
  const Fabric none = glass_weave();
  const auto refused = [&](const SignedCurves& curves, const Fabric& base) {
    Diagnostics diagnostics;
    EXPECT_FALSE(identify_stitch(curves, {0}, frame, base, exact(), diagnostics));
    return texts(diagnostics);
  };
  const SignedCurves alike{{noisy_curve(curve_of(frame, none, false), 0.01, 0.0, 3)},
                           {noisy_curve(curve_of(frame, none, true), 0.01, 0.0, 4)}};
  const std::string less = refused(alike, stitched(1, 0)); // by chance the drawn side bears less
  EXPECT_NE(less.find("stitch = 0 N: is all that"), std::string::npos) << less;
  const std::string chance = refused({alike.negative, alike.positive}, stitched(1, 0));
  EXPECT_NE(chance.find("do not differ beyond their scatter"), std::string::npos) << chance;
  const Fabric fabric = stitched(24.0, 0.0);
  const SignedCurves curves{{curve_of(frame, fabric, false)}, {curve_of(frame, fabric, true)}};
  Fabric along = stitched(1, 0);
  along.stitches[0].angle = 0.01;
  EXPECT_NE(refused(curves, along).find("lies along one of the families"), std::string::npos);
  EXPECT_FALSE(refused({curves.negative, curves.positive}, stitched(1, 0)).empty()); // exchanged
}

} // namespace
} // namespace plyform::fit_signs_test
