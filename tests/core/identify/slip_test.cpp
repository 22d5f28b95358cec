// SPDX-License-Identifier: GPL-3.0-or-later
// Slip: what the formula without it does to a law, and angles of a second file.
#include "core/identify/slip.hpp"
#include "support/fit_curves.hpp"
#include "support/membrane_checks.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace plyform::slip_test {
namespace {

const ShearTest bias = shear_test(BiasSpecimen{450.0, 150.0});

/// The glass weave's loads at angles to 40 degrees, in a machine whose extension is `stretch` times
/// that of the cells.
Curve slipping_curve(double stretch) {
  Curve curve{.file = "test.csv", .x_name = "d", .y_name = "F", .x = {}, .y = {}, .line = {}};
  for (int i = 0; i <= 80; ++i) {
    const double angle = 0.5 * i * degree, d = extension_at(bias, angle);
    curve.x.push_back(stretch * d);
    curve.y.push_back(test_load(bias, glass_weave(), d));
    curve.angle.push_back(angle);
    curve.line.push_back(i + 2);
  }
  curve.angle_name = "gamma";
  return curve;
}

TEST(Slip, SaysHowFarTheFormulaIsOff) {
  const Curve curve = slipping_curve(1.1);
  FitOptions options;
  options.measured_angle = true;
  Diagnostics diagnostics;
  const auto fit = identify_shear(curve, bias, glass_weave(), options, diagnostics);
  ASSERT_TRUE(fit) << texts(diagnostics);
  const SlipEffect effect = slip_effect({curve}, bias, glass_weave(), options, fit->law);
  ASSERT_EQ(effect.at.size(), 4u);
  EXPECT_EQ(effect.refusal, "");
  EXPECT_NEAR(effect.work, 1.0 - 1.0 / 1.1, 1e-12);
  FitOptions crosshead;
  crosshead.doubtful = true;
  const auto formula = identify_shear(curve, bias, glass_weave(), crosshead, diagnostics);
  ASSERT_TRUE(formula) << texts(diagnostics);
  for (const SlipAt& at : effect.at) {
    EXPECT_NEAR(at.formula, shear_angle(bias, 1.1 * extension_at(bias, at.angle)), 0.01 * degree);
    EXPECT_NEAR(
        at.torque,
        formula->law.at(at.angle).value / glass_weave().crossings[0].shear.at(at.angle).value - 1.0,
        1e-6);
    EXPECT_LT(at.torque, -0.05); // loads stand at angles that are too large
  }
  const SlipEffect none =
      slip_effect({slipping_curve(1.0)}, bias, glass_weave(), options, fit->law);
  EXPECT_NEAR(none.work, 0.0, 1e-12);
  EXPECT_NEAR(none.at.back().torque, 0.0, 1e-6);
}

TEST(Slip, MayBeThatOfAPlainWeave) {
  EXPECT_EQ(usual_slip(0.0), 0.0);
  EXPECT_NEAR(usual_slip(26.0 * degree), 4.0 * degree, 1e-12);
  EXPECT_NEAR(usual_slip(44.0 * degree), 8.5 * degree, 1e-12);
  Curve curve = slipping_curve(1.0);
  curve.angle.clear();
  Diagnostics diagnostics;
  const auto fit = identify_shear(curve, bias, glass_weave(), {}, diagnostics);
  ASSERT_TRUE(fit) << texts(diagnostics);
  const SlipEffect effect = possible_slip({curve}, bias, glass_weave(), {}, fit->law);
  ASSERT_EQ(effect.at.size(), 3u); // the middle has 32.5 degrees where the formula says 40
  for (const SlipAt& at : effect.at) {
    EXPECT_TRUE(std::isnan(at.formula));
    EXPECT_LT(at.torque, -0.1);
    EXPECT_GT(at.torque, -0.5);
  }
}

TEST(Slip, HasItsAnglesFromASecondFile) {
  Curve angles{.file = "angles.csv", .x_name = "d", .y_name = "phi", .x = {}, .y = {}, .line = {}};
  for (int i = 1; i <= 9; ++i) { // from 10 mm on, one row twice
    angles.x.insert(angles.x.end(), i == 5 ? 2 : 1, 10.0 * i);
    angles.y.insert(angles.y.end(), i == 5 ? 2 : 1, 0.004 * 10.0 * i);
    angles.line.insert(angles.line.end(), i == 5 ? 2 : 1, i + 1);
  }
  Curve curve = slipping_curve(1.0);
  curve.angle.clear();
  Diagnostics diagnostics;
  ASSERT_TRUE(put_angles(curve, angles, diagnostics)) << texts(diagnostics);
  EXPECT_NE(texts(diagnostics)
                .find("beyond 10 to 90 mm of angles.csv, where angles were measured: "
                      "left out"),
            std::string::npos);
  EXPECT_GE(curve.x.front(), 10.0);
  EXPECT_EQ(curve.angle_name, "phi");
  ASSERT_EQ(curve.angle.size(), curve.size());
  for (std::size_t i = 0; i < curve.size(); ++i)
    EXPECT_NEAR(curve.angle[i], 0.004 * curve.x[i], 1e-12);
  Curve before = slipping_curve(0.1);
  EXPECT_FALSE(put_angles(before, angles, diagnostics));
  EXPECT_NE(texts(diagnostics).find("rows are within 10 to 90 mm"), std::string::npos);
}

} // namespace
} // namespace plyform::slip_test
