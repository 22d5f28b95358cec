// SPDX-License-Identifier: GPL-3.0-or-later
// Normalised shear forces of frames: the load of any frame, and the law that follows.
#include "core/identify/fit_shear.hpp"
#include "core/identify/measured_angle.hpp"
#include "core/identify/normalised_force.hpp"
#include "support/fit_curves.hpp"
#include "support/membrane_checks.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace plyform::normalised_force_test {
namespace {

/// F_norm = d1 d2 Cs / cos(gamma), as torque per area is F_norm cos(gamma).
Curve normalised_glass() {
  const Fabric glass = glass_weave();
  Curve curve{.file = "cao.csv", .x_name = "", .y_name = "UML", .x = {}, .y = {}, .line = {}};
  for (int i = 0; i <= 10; ++i) {
    const double angle = 5.0 * i * degree;
    curve.angle.push_back(angle);
    curve.x.push_back(0.0);
    curve.y.push_back(glass.families[0].density * glass.families[1].density *
                      glass.crossings[0].shear.at(angle).value / std::cos(angle));
    curve.line.push_back(i + 2);
  }
  curve.angle_name = "shear_angle_deg";
  curve.y_is = Quantity::force_per_length;
  return curve;
}

TEST(NormalisedForce, IsTheLoadOfAFrameOfAnySize) {
  const Fabric glass = glass_weave();
  for (const double side : {50.0, 200.0, 330.0}) {
    Curve curve = normalised_glass();
    take_normalised(curve, side, true);
    const ShearTest frame = shear_test(FrameSpecimen{side});
    for (std::size_t i = 0; i < curve.size(); ++i)
      EXPECT_NEAR(curve.y[i], test_load(frame, glass, extension_at(frame, curve.angle[i])),
                  1e-12 * side);
    EXPECT_EQ(curve.y_is, Quantity::force);
    const std::vector<double> before = curve.y;
    take_normalised(curve, side, true); // loads are left alone
    EXPECT_EQ(curve.y, before);

    FitOptions options;
    options.measured_angle = angles_count({curve}, {});
    Diagnostics diagnostics;
    const auto fit = identify_shear(curve, frame, glass, options, diagnostics);
    ASSERT_TRUE(fit) << texts(diagnostics);
    for (const double g : {5.0, 25.0, 50.0})
      EXPECT_NEAR(fit->law.at(g * degree).value / glass.crossings[0].shear.at(g * degree).value,
                  1.0, 1e-9);
  }
}

TEST(NormalisedForce, GoesByTheExtensionWhereNoAngleIsMeasured) {
  Curve by_angle = normalised_glass(), by_extension = normalised_glass();
  const ShearTest frame = shear_test(FrameSpecimen{200.0});
  for (std::size_t i = 0; i < by_extension.size(); ++i)
    by_extension.x[i] = extension_at(frame, by_extension.angle[i]);
  by_extension.x.back() = 2.0 * locking_extension(frame); // no angle: refused later
  take_normalised(by_angle, 200.0, true);
  take_normalised(by_extension, 200.0, false);
  for (std::size_t i = 0; i + 1 < by_angle.size(); ++i)
    EXPECT_NEAR(by_extension.y[i], by_angle.y[i], 1e-12);
  EXPECT_TRUE(by_extension.y.back() > 0.0);
}

} // namespace
} // namespace plyform::normalised_force_test
