// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of shear that are no polynomials: found where the rows have them, and nowhere else.
#include "core/identify/choose_shear.hpp"
#include "core/identify/nonnegative.hpp"
#include "core/identify/shear_table.hpp"
#include "support/fit_curves.hpp"
#include "support/membrane_checks.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace plyform::shear_laws_test {
namespace {

const ShearTest strip = shear_test(BiasSpecimen{300.0, 100.0});
const ShearTest frame = shear_test(FrameSpecimen{200.0});

Fabric fabric_of(const ShearLaw& law) {
  Fabric fabric = glass_weave();
  fabric.crossings[0].shear = law;
  return fabric;
}

/// Sticks up to 0.3 N mm within 1 degree, then turns as the glass weave does.
double sticking(double degrees) {
  const double t = std::min(degrees, 1.0);
  return 0.3 * 0.5 * t * (3.0 - t * t) +
         glass_weave().crossings[0].shear.at(degrees * degree).value;
}

ShearLaw sticking_law() {
  ShearLaw law;
  for (double g = 0.0; g <= 60.0; g += g < 2.0 ? 0.125 : 1.0) {
    law.angle.push_back(g * degree);
    law.torque.push_back(sticking(g));
  }
  return law;
}

/// Turns at nearly constant torque, then locks at once: no polynomial of five does it.
ShearLaw locking_law() {
  ShearLaw law;
  law.angle = {0.0, 1.0 * degree, 5.0 * degree, 30.0 * degree, 38.0 * degree, 45.0 * degree};
  law.torque = {0.0, 0.3, 0.4, 0.6, 1.2, 4.0};
  return law;
}

Curve curve_of(const ShearTest& test, const ShearLaw& law, double to, int rows = 60,
               double from = 0.0) {
  Curve curve{.file = "test.csv", .x_name = "d", .y_name = "F", .x = {}, .y = {}, .line = {}};
  const double begin = extension_at(test, from * degree), end = extension_at(test, to * degree);
  for (int i = 0; i <= rows; ++i) {
    curve.x.push_back(begin + (end - begin) * i / rows);
    curve.y.push_back(test_load(test, fabric_of(law), curve.x.back()));
    curve.line.push_back(i + 1);
  }
  return curve;
}

double wrong_by(const ShearLaw& found, const ShearLaw& law, double from, double to) {
  double largest = 0.0;
  for (double g = from; g <= to; g += 0.25)
    largest =
        std::max(largest, std::abs(found.at(g * degree).value / law.at(g * degree).value - 1.0));
  return largest;
}

TEST(NonNegative, IsTheLeastOfAllWithoutNegativeNumbers) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int repeat = 0; repeat < 50; ++repeat) {
    Eigen::MatrixXd a(12, 5);
    Eigen::VectorXd b(12);
    for (double& value : a.reshaped())
      value = normal(random);
    for (double& value : b)
      value = normal(random);
    const Eigen::VectorXd u = nonnegative_least_squares(a, b);
    const Eigen::VectorXd gain = a.transpose() * (b - a * u);
    for (Eigen::Index i = 0; i < 5; ++i) { // Karush, Kuhn and Tucker
      EXPECT_GE(u[i], 0.0);
      EXPECT_LE(gain[i], 1e-9);
      EXPECT_NEAR(gain[i] * u[i], 0.0, 1e-9);
    }
  }
}

TEST(ShearTableBasis, IsLinearInItsTorquesAtItself) {
  const TorqueTable table{{0.02, 0.1, 0.4, 0.7, 0.8}, Eigen::VectorXd{{0.3, 0.35, 0.35, 0.9, 2.0}}};
  const TableBasis basis(table);
  ShearLaw law;
  law.angle = {0.0, 0.02, 0.1, 0.4, 0.7, 0.8};
  law.torque = {0.0, 0.3, 0.35, 0.35, 0.9, 2.0};
  for (double g = 0.0; g <= 0.9; g += 0.013) {
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(5);
    basis.add(g, 1.0, row);
    EXPECT_NEAR(row * table.torque, law.at(g).value, 1e-8) << g;
    for (const std::size_t i : {1u, 4u, 5u}) { // not at level chords, which have two derivatives
      const double h = 1e-5;
      ShearLaw more = law, less = law;
      more.torque[i] += h;
      less.torque[i] -= h;
      if (i == 1) continue;
      EXPECT_NEAR(row[static_cast<Eigen::Index>(i) - 1],
                  (more.at(g).value - less.at(g).value) / (2.0 * h), 1e-4)
          << g << " " << i;
    }
  }
}

TEST(ShearLaws, AStaticTorqueIsFoundForWhatItIs) {
  for (const ShearTest& test : {strip, frame})
    for (unsigned seed = 1; seed <= 3; ++seed) {
      const ShearOutcome o = identify_glass(
          {noisy_curve(curve_of(test, sticking_law(), 55.0), 0.005, 0.001, seed)}, test);
      ASSERT_TRUE(o.fit) << o.texts;
      EXPECT_TRUE(o.fit->law.tabulated()) << o.fit->why;
      EXPECT_FALSE(o.says("load zero")) << o.texts;
      EXPECT_LT(wrong_by(o.fit->law, sticking_law(), 5.0, 55.0), 0.05) << seed;
      EXPECT_LT(o.fit->quality.misfit, 0.01);
      EXPECT_NE(o.fit->why.find("polynomial of 3 "), std::string::npos) << o.fit->why;
    }
}

TEST(ShearLaws, AStaticTorqueIsWrittenAsATableThatPassesIt) {
  FitOptions options;
  options.law = ShearFormKind::with_static;
  options.coefficients = 3;
  const ShearOutcome o = identify_glass({curve_of(strip, sticking_law(), 55.0)}, strip, options);
  ASSERT_TRUE(o.fit) << o.texts;
  EXPECT_NEAR(o.fit->static_torque, 0.3, 0.003);
  EXPECT_NEAR(o.fit->static_angle, 1.0 * degree, 1e-9);
  EXPECT_LE(o.fit->law.angle.size(), 40u);
  for (double g = 1.0; g <= 55.0; g += 0.1) {
    const double x = g * degree, powers = o.fit->polynomial[0] * x +
                                          o.fit->polynomial[1] * std::pow(x, 3) +
                                          o.fit->polynomial[2] * std::pow(x, 5);
    EXPECT_NEAR(o.fit->law.at(x).value / (o.fit->static_torque + powers), 1.0, 1.1e-3) << g;
  }
}

TEST(ShearLaws, ATableFollowsStickingAndLocking) {
  for (const ShearTest& test : {strip, frame})
    for (unsigned seed = 1; seed <= 2; ++seed) {
      const ShearOutcome o = identify_glass(
          {noisy_curve(curve_of(test, locking_law(), 44.0), 0.01, 0.001, seed)}, test);
      ASSERT_TRUE(o.fit) << o.texts;
      ASSERT_EQ(o.fit->form.kind, ShearFormKind::table) << o.fit->why;
      EXPECT_LE(o.fit->form.size, 8);
      EXPECT_LT(o.fit->quality.misfit, 0.03);
      EXPECT_TRUE(std::is_sorted(o.fit->law.torque.begin(), o.fit->law.torque.end()));
      EXPECT_LT(wrong_by(o.fit->law, locking_law(), 5.0, 44.0), 0.08) << seed;
      EXPECT_EQ(o.fit->confidence.coefficient.size(), o.fit->law.angle.size() - 1);
      EXPECT_TRUE(o.says("a table follows slack, slip and compliance")) << o.texts;
    }
}

/// Residuals of smooth curves go together: what chance could do says little about them.
TEST(ShearLaws, ACurveWithoutNoiseHasItsTableToo) {
  ShearLaw flat = locking_law(); // of which the polynomial of 3 falls
  flat.angle = {0.0, 0.5 * degree, 20.0 * degree, 40.0 * degree, 55.0 * degree};
  flat.torque = {0.0, 0.08, 0.1, 0.2, 1.5};
  for (const ShearLaw& law : {locking_law(), flat}) {
    const ShearOutcome outcome = identify_glass({curve_of(frame, law, 44.0, 100)}, frame);
    ASSERT_TRUE(outcome.fit) << outcome.texts;
    EXPECT_EQ(outcome.fit->form.kind, ShearFormKind::table) << outcome.fit->why;
    EXPECT_LT(outcome.fit->quality.misfit, 0.02);
    EXPECT_FALSE(outcome.says("load zero")) << outcome.texts;
  }
}

/// The choice is of means of rows, the law of all rows.
TEST(ShearLaws, ManyRowsHaveTheLawOfFew) {
  const ShearOutcome few = identify_glass({curve_of(frame, sticking_law(), 45.0, 150)}, frame),
                     many = identify_glass({curve_of(frame, sticking_law(), 45.0, 3000)}, frame);
  ASSERT_TRUE(few.fit && many.fit) << few.texts << many.texts;
  EXPECT_EQ(many.fit->form, few.fit->form);
  EXPECT_EQ(many.fit->quality.rows, 3001u);
  EXPECT_LT(wrong_by(many.fit->law, sticking_law(), 2.0, 45.0), 0.01);
}

TEST(ShearLaws, LoadsBeyondAnyUnitAreRefused) {
  for (const double factor : {1e-300, 1e300}) {
    Curve curve = curve_of(frame, sticking_law(), 45.0);
    for (double& load : curve.y)
      load *= factor;
    for (const auto law : {ShearFormKind::polynomial, ShearFormKind::with_static}) {
      FitOptions options;
      options.law = law;
      options.doubtful = true;
      const ShearOutcome outcome = identify_glass({curve}, frame, options);
      EXPECT_FALSE(outcome.fit);
      EXPECT_TRUE(outcome.says("must lie between 1e-12 and 1e+12")) << outcome.texts;
    }
  }
}

/// The zero of a polynomial's curve is found with the polynomial, whatever the noise.
TEST(ShearLaws, AZeroIsFoundWithTheLawThatNeedsNoOther) {
  const Curve exact = curve_of(strip, glass_weave().crossings[0].shear, 55.0);
  for (unsigned seed = 0; seed < 10; ++seed) {
    Curve curve = exact;
    for (double& load : curve.y)
      load += 0.02 * exact.y.back();
    curve = noisy_curve(curve, 0.01, 0.002, seed);
    FitOptions options;
    options.corrections.fit_load_zero = true;
    const ShearOutcome outcome = identify_glass({curve}, strip, options);
    ASSERT_TRUE(outcome.fit) << outcome.texts;
    EXPECT_EQ(outcome.fit->form, ShearForm{}) << seed;
    EXPECT_LT(wrong_by(outcome.fit->law, glass_weave().crossings[0].shear, 5.0, 55.0), 0.15);
  }
}

TEST(ShearLaws, APolynomialStaysOne) {
  int others = 0;
  for (unsigned seed = 1; seed <= 40; ++seed)
    for (const double noise : {0.003, 0.01}) {
      const ShearOutcome o =
          identify_glass({noisy_curve(curve_of(strip, glass_weave().crossings[0].shear, 55.0),
                                      noise, 0.2 * noise, seed)},
                         strip);
      ASSERT_TRUE(o.fit) << o.texts;
      others += !(o.fit->form == ShearForm{});
    }
  EXPECT_LE(others, 2);
}

TEST(ShearLaws, RowsThatDoNotReachZeroDoNotTell) {
  const ShearOutcome o = identify_glass({curve_of(frame, sticking_law(), 45.0, 8, 5.0)}, frame);
  ASSERT_TRUE(o.fit) << o.texts;
  EXPECT_TRUE(o.says("the curve does not show whether")) << o.texts;
  Curve off = curve_of(frame, glass_weave().crossings[0].shear, 45.0, 40, 5.0);
  for (double& y : off.y)
    y += 0.02 * off.y.back();
  const ShearOutcome zero = identify_glass({off}, frame);
  EXPECT_TRUE(zero.says("load zero")) << zero.texts;
}

TEST(ShearLaws, TorqueThatFallsIsRefusedForWhatItIs) {
  ShearLaw soft = locking_law();
  soft.torque = {0.0, 0.3, 0.4, 0.6, 0.5, 0.3};
  const ShearOutcome o =
      identify_glass({noisy_curve(curve_of(strip, soft, 44.0), 0.005, 0.001, 1)}, strip);
  EXPECT_FALSE(o.fit);
  EXPECT_TRUE(o.says("falls")) << o.texts;
  FitOptions table;
  table.points = 5;
  const ShearOutcome forced = identify_glass({curve_of(strip, soft, 44.0)}, strip, table);
  EXPECT_FALSE(forced.fit);
  EXPECT_TRUE(forced.says("the torque of the rows falls from 0.58") && forced.says("--to 29"))
      << forced.texts;
}

TEST(ShearLaws, TablesOfSeveralSpecimensScatterAsTheyDo) {
  std::vector<Curve> curves;
  for (const double factor : {0.9, 1.0, 1.1}) {
    curves.push_back(curve_of(strip, locking_law(), 44.0));
    for (double& y : curves.back().y)
      y *= factor;
  }
  FitOptions options;
  options.points = 5;
  const ShearOutcome o = identify_glass(curves, strip, options);
  ASSERT_TRUE(o.fit) << o.texts;
  EXPECT_NEAR(o.fit->scatter.law, 0.1, 1e-6);
  EXPECT_NEAR(o.fit->confidence.law, student_95(2.0) * 0.1 / std::sqrt(3.0), 1e-6);
  EXPECT_EQ(o.fit->of_specimen.size(), 3u);
}

TEST(ShearLaws, LimitsOfATableHoldIt) {
  int held = 0;
  constexpr int curves = 100;
  FitOptions options;
  options.points = 5;
  for (unsigned seed = 1; seed <= curves; ++seed) {
    const ShearOutcome o = identify_glass(
        {noisy_curve(curve_of(strip, locking_law(), 44.0), 0.01, 0.0, seed)}, strip, options);
    ASSERT_TRUE(o.fit) << o.texts;
    const double at = 25.0 * degree; // where the curve is smooth
    held += std::abs(o.fit->law.at(at).value / locking_law().at(at).value - 1.0) <=
            o.fit->confidence.law;
  }
  EXPECT_GE(held, 90); // the widest limits of the law, wherever they are
}

} // namespace
} // namespace plyform::shear_laws_test
