// SPDX-License-Identifier: GPL-3.0-or-later
// What stitches add to the load of shear tests: the closed form, virtual work, both signs.
#include "core/identify/stitch_load.hpp"
#include "support/membrane_checks.hpp"

#include <gtest/gtest.h>
#include <numbers>

namespace plyform::stitch_load_test {
namespace {

constexpr double pi = std::numbers::pi;
const ShearTest frame = shear_test(FrameSpecimen{200.0});
const ShearTest strip = shear_test(BiasSpecimen{300.0, 100.0});

TEST(StitchLoad, OfAFrameIsTheClosedFormOfADiagonal) {
  Fabric fabric = glass_weave();
  fabric.stitches = {stitch_at(0.25 * pi, 24.0, 0.02)};
  for (const double degrees : {5.0, 20.0, 45.0}) {
    const double g = degrees * degree, length = std::sqrt(1.0 + std::sin(g));
    const double torque = // per area
        0.2 * 24.0 * (length - 1.02) * std::cos(g) / (2.0 * length);
    // (41) for a torque per area: F = a sqrt(2) tau / (cos(g/2) - sin(g/2))
    const double wanted = 200.0 * std::sqrt(2.0) * torque / (std::cos(0.5 * g) - std::sin(0.5 * g));
    EXPECT_NEAR(stitch_load(frame, fabric, {0}, extension_at(frame, g), false), wanted,
                1e-9 * wanted);
    EXPECT_EQ(stitch_load(frame, fabric, {0}, extension_at(frame, g), true), 0.0); // slack
  }
}

/// The load is the derivative of what stitches store, along any direction, either way.
TEST(StitchLoad, DoesTheWorkThatStitchesStore) {
  Fabric fabric = glass_weave();
  for (const double angle : {0.25 * pi, 0.6, 2.0})
    for (const bool negative : {false, true})
      for (const ShearTest& test : {frame, strip}) {
        fabric.stitches = {stitch_at(angle, 24.0, -0.1)};
        const Stitch& stitch = fabric.stitches[0];
        const auto stored = [&](double d) {
          const double g = (negative ? -1.0 : 1.0) * shear_angle(test, d);
          const auto energy = [&](double at) {
            return stitch.density * stitch.law.at(elongation_of(fabric, stitch, at).strain).energy;
          };
          return test.whole_area * energy(g) + test.half_area * energy(0.5 * g);
        };
        const double d = 40.0, h = 1e-4;
        const double wanted = (stored(d + h) - stored(d - h)) / (2.0 * h);
        EXPECT_NEAR(stitch_load(test, fabric, {0}, d, negative), wanted, 1e-6 * std::abs(wanted));
      }
}

TEST(StitchLoad, OfAPreTensionIsNegativeWhereShearSlackensIt) {
  Fabric fabric = glass_weave();
  fabric.stitches = {stitch_at(0.25 * pi, 10.0, -0.1)};
  EXPECT_NEAR(stitch_load(frame, fabric, {0}, 0.0, true),
              -stitch_load(frame, fabric, {0}, 0.0, false), 1e-12);
  EXPECT_GT(stitch_load(frame, fabric, {0}, 0.0, false), 1.0);
}

TEST(StitchLoad, EndsWhereStitchesBreakZoneByZone) {
  Fabric fabric = glass_weave();
  fabric.stitches = {stitch_at(0.25 * pi, 24.0)};
  const double g = 30.0 * degree;
  fabric.stitches[0].law.breaking_force = 24.0 * (std::sqrt(1.0 + std::sin(g)) - 1.0);
  const auto load = [&](const ShearTest& test, double degrees) {
    return stitch_load(test, fabric, {0}, extension_at(test, degrees * degree), false);
  };
  EXPECT_GT(load(frame, 29.9), 10.0);
  EXPECT_EQ(load(frame, 30.1), 0.0);
  EXPECT_GT(load(strip, 30.1), 1.0); // the zones that shear by half hold
  EXPECT_EQ(load(strip, 60.2), 0.0);
}

} // namespace
} // namespace plyform::stitch_load_test
