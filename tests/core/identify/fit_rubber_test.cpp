// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of rubber found again from the curves that they make; which law is taken, what is told, and
// what is refused.
#include "core/identify/fit_rubber.hpp"
#include "support/fit_curves.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace plyform::fit_rubber_test {
namespace {

const MooneyRivlinLaw both{0.16, 0.04}, neo{0.15, 0.0};

/// Nominal stress over strain, 40 rows.
RubberCurve rubber_curve(const MooneyRivlinLaw& law, RubberTest test, double stretch) {
  Curve curve{.file = "rubber.csv", .x_name = "e", .y_name = "s", .x = {}, .y = {}, .line = {}};
  curve.y_is = Quantity::stress, curve.x_is = Quantity::strain;
  for (int i = 0; i <= 40; ++i) {
    curve.x.push_back((stretch - 1.0) * i / 40.0);
    const double l = 1.0 + curve.x.back();
    curve.y.push_back(test == RubberTest::uniaxial ? uniaxial_load(law, l)
                                                   : equibiaxial_load(law, l));
    curve.line.push_back(i + 1);
  }
  return {curve, test};
}

struct Outcome {
  std::optional<RubberFit> fit;
  std::string texts;
  std::size_t warnings = 0;
};

Outcome found(const std::vector<RubberCurve>& curves, RubberLaw law = RubberLaw::chosen,
              const RubberSpecimen& specimen = {}, FitOptions options = {}) {
  Diagnostics diagnostics;
  options.corrections.compliance = 0.0;
  Outcome outcome;
  outcome.fit = identify_rubber(curves, specimen, law, options, diagnostics);
  outcome.texts = texts(diagnostics);
  outcome.warnings = diagnostics.warnings.size();
  return outcome;
}

TEST(IdentifyRubber, FindsBothConstantsOfExactCurves) {
  for (const RubberTest test : {RubberTest::uniaxial, RubberTest::equibiaxial}) {
    const Outcome o = found({rubber_curve(both, test, 2.5)});
    ASSERT_TRUE(o.fit) << o.texts;
    EXPECT_FALSE(o.fit->neo_hookean) << o.fit->why;
    EXPECT_NEAR(o.fit->law.c10, both.c10, 1e-9);
    EXPECT_NEAR(o.fit->law.c01, both.c01, 1e-9);
    EXPECT_DOUBLE_EQ(o.fit->largest_stretch, 2.5);
    EXPECT_EQ(o.warnings, 0u) << o.texts;
  }
}

TEST(IdentifyRubber, TakesNeoHookeanWhereTheRowsDoNotTellTheConstants) {
  const RubberCurve exact = rubber_curve(both, RubberTest::uniaxial, 1.1);
  const RubberCurve noisy{noisy_curve(exact.curve, 0.01, 0.0, 3), exact.test};
  const Outcome o = found({noisy});
  ASSERT_TRUE(o.fit) << o.texts;
  EXPECT_TRUE(o.fit->neo_hookean) << o.fit->why;
  EXPECT_NE(o.fit->why.find("do not tell C10 from C01"), std::string::npos) << o.fit->why;
  EXPECT_NE(o.texts.find("uniaxial tension alone"), std::string::npos) << o.texts;
  EXPECT_NE(o.texts.find("--equibiaxial"), std::string::npos) << o.texts;
  EXPECT_NEAR(o.fit->law.shear_modulus(), both.shear_modulus(), 0.06 * both.shear_modulus());

  const Outcome asked = found({noisy}, RubberLaw::mooney_rivlin);
  ASSERT_TRUE(asked.fit) << asked.texts;
  EXPECT_FALSE(asked.fit->neo_hookean);
  EXPECT_NE(asked.texts.find("do not tell C10 from C01"), std::string::npos) << asked.texts;
  const double error = asked.fit->law.c01 - both.c01;
  EXPECT_LT(std::abs(error), 2.0 * asked.fit->confidence.coefficient[1]);
}

TEST(IdentifyRubber, BothTestsTogetherTellTheConstants) {
  const RubberCurve one = rubber_curve(both, RubberTest::uniaxial, 1.6),
                    two = rubber_curve(both, RubberTest::equibiaxial, 1.5);
  int inside = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Outcome o = found({{noisy_curve(one.curve, 0.01, 0.0, seed), one.test},
                             {noisy_curve(two.curve, 0.01, 0.0, 100 + seed), two.test}});
    ASSERT_TRUE(o.fit) << o.texts;
    EXPECT_FALSE(o.fit->neo_hookean) << o.fit->why;
    EXPECT_NEAR(o.fit->law.c10, both.c10, 0.05 * both.c10);
    EXPECT_NEAR(o.fit->law.c01, both.c01, 0.1 * both.c01);
    inside += std::abs(o.fit->law.c01 - both.c01) < o.fit->confidence.coefficient[1];
    EXPECT_LT(o.fit->by_both.equibiaxial, 0.1);
  }
  EXPECT_GE(inside, 16); // of 95 %
}

TEST(IdentifyRubber, TakesStretchesForcesAndDisplacements) {
  RubberCurve stretches = rubber_curve(neo, RubberTest::uniaxial, 2.0);
  for (double& x : stretches.curve.x)
    x += 1.0;
  stretches.curve.x_is = Quantity::stretch;
  RubberCurve forces = rubber_curve(neo, RubberTest::uniaxial, 2.0);
  for (double& x : forces.curve.x)
    x *= 50.0;
  for (double& y : forces.curve.y)
    y *= 25.0 * 1.5;
  forces.curve.x_is = Quantity::length, forces.curve.y_is = Quantity::force;
  for (const auto& [curve, specimen] :
       {std::pair{stretches, RubberSpecimen{}}, {forces, RubberSpecimen{25.0 * 1.5, 50.0}}}) {
    const Outcome o = found({curve}, RubberLaw::neo_hookean, specimen);
    ASSERT_TRUE(o.fit) << o.texts;
    EXPECT_NEAR(o.fit->law.shear_modulus(), 0.3, 1e-9);
    EXPECT_NEAR(o.fit->largest_stretch, 2.0, 1e-12);
  }
}

TEST(IdentifyRubber, SpecimensHaveTheSameWeightAndTheirScatter) {
  std::vector<RubberCurve> curves;
  for (const double mu : {0.28, 0.3, 0.32})
    curves.push_back(rubber_curve({0.5 * mu, 0.0}, RubberTest::uniaxial, 2.0));
  const Outcome o = found(curves, RubberLaw::neo_hookean);
  ASSERT_TRUE(o.fit) << o.texts;
  EXPECT_NEAR(o.fit->law.shear_modulus(), 0.3, 0.003);
  ASSERT_EQ(o.fit->scatter.coefficient.size(), 1u);
  EXPECT_NEAR(o.fit->scatter.coefficient[0].deviation, 0.02, 1e-6);
  EXPECT_NEAR(o.fit->confidence.coefficient[0], 4.303 * 0.02 / std::sqrt(3.0), 1e-4);
}

TEST(IdentifyRubber, DoesNotTakeALawThatSoftens) {
  const Outcome o = found({rubber_curve({0.19, -0.06}, RubberTest::uniaxial, 2.0)});
  ASSERT_TRUE(o.fit) << o.texts;
  EXPECT_TRUE(o.fit->neo_hookean);
  EXPECT_NE(o.fit->why.find("softens when stretched both ways"), std::string::npos) << o.fit->why;
  const Outcome asked =
      found({rubber_curve({0.19, -0.06}, RubberTest::uniaxial, 2.0)}, RubberLaw::mooney_rivlin);
  ASSERT_TRUE(asked.fit) << asked.texts;
  EXPECT_NE(asked.texts.find("unstable there"), std::string::npos) << asked.texts;
}

TEST(IdentifyRubber, WhatIsNoCurveOfRubberIsRefused) {
  RubberCurve falls = rubber_curve(neo, RubberTest::uniaxial, 2.0);
  falls.curve.y.back() = 0.1;
  RubberCurve kilo = rubber_curve({150.0, 0.0}, RubberTest::uniaxial, 2.0);
  RubberCurve few = rubber_curve(neo, RubberTest::uniaxial, 2.0);
  few.curve = rows_of(few.curve, {0, 10, 20});
  RubberCurve percent = rubber_curve(neo, RubberTest::uniaxial, 2.0);
  for (double& x : percent.curve.x)
    x *= 100.0;
  RubberCurve no_stretch = rubber_curve(neo, RubberTest::uniaxial, 2.0);
  no_stretch.curve.x_is = Quantity::stretch;
  for (const auto& [curve, words] : {std::pair{falls, "the stress falls"},
                                     {kilo, "is no fabric's"},
                                     {few, "at least 4"},
                                     {percent, "it must be at most 10"},
                                     {no_stretch, "a stretch is 1"}}) {
    const Outcome o = found({curve});
    EXPECT_FALSE(o.fit) << words;
    EXPECT_NE(o.texts.find(words), std::string::npos) << o.texts;
  }
}

TEST(IdentifyRubber, AWrongZeroIsFoundAndTakenOff) {
  RubberCurve shifted = rubber_curve(neo, RubberTest::uniaxial, 2.0);
  shifted.curve = noisy_curve(shifted.curve, 0.002, 0.0, 5);
  for (double& x : shifted.curve.x)
    x += 0.05;
  const Outcome o = found({shifted}, RubberLaw::neo_hookean);
  EXPECT_NE(o.texts.find("slack up to 0.05"), std::string::npos) << o.texts;
  FitOptions options;
  options.corrections.fit_toe = true;
  const Outcome taken = found({shifted}, RubberLaw::neo_hookean, {}, options);
  ASSERT_TRUE(taken.fit) << taken.texts;
  EXPECT_NEAR(taken.fit->law.shear_modulus(), 0.3, 0.003);
}

} // namespace
} // namespace plyform::fit_rubber_test
