// SPDX-License-Identifier: GPL-3.0-or-later
// Equations (40) and (41) against what they stand for: the power of the load is that of the cells.
#include "core/identify/shear_tests.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace plyform::shear_tests_test {
namespace {

using std::numbers::pi;
using std::numbers::sqrt2;
constexpr double deg = pi / 180.0;

Fabric glass() { // Hamila and Boisse 2008, table 1
  Fabric fabric = woven_fabric();
  fabric.families[0].density = fabric.families[1].density = 0.25;
  fabric.crossings[0].shear.k = {0.37044, 0.84105, 1.03113};
  return fabric;
}

const BiasSpecimen strip{300.0, 100.0};
const FrameSpecimen frame{200.0};

TEST(ShearTests, LoadIsTheDerivativeOfTheCellsEnergy) {
  const Fabric fabric = glass();
  const auto bias_energy = [&](double d) { // zones by (40), each with its own angle
    const double angle = shear_angle(shear_test(strip), d);
    return 0.0625 * (100.0 * (600.0 - 300.0) / 2.0 * fabric.crossings[0].shear.at(angle).energy +
                     100.0 * 100.0 * fabric.crossings[0].shear.at(0.5 * angle).energy);
  };
  const auto frame_energy = [&](double d) {
    return 0.0625 * 200.0 * 200.0 *
           fabric.crossings[0].shear.at(shear_angle(shear_test(frame), d)).energy;
  };
  constexpr double h = 1e-3; // mm: cut-off 1e-8 relative at most, rounding 1e-10
  for (const double angle : {0.5, 5.0, 20.0, 40.0, 60.0, 80.0}) {
    const double b = extension_at(shear_test(strip), angle * deg);
    const double f = extension_at(shear_test(frame), angle * deg);
    const double bias_load = test_load(shear_test(strip), fabric, b);
    const double frame_load = test_load(shear_test(frame), fabric, f);
    EXPECT_NEAR((bias_energy(b + h) - bias_energy(b - h)) / (2.0 * h), bias_load, 1e-5 * bias_load);
    EXPECT_NEAR((frame_energy(f + h) - frame_energy(f - h)) / (2.0 * h), frame_load,
                1e-5 * frame_load);
  }
}

TEST(ShearTests, KinematicsIsThatOfAHingedSquare) {
  // Half the specimen's diagonal D between two sides of D/sqrt2 that meet at pi/2 - gamma.
  for (const double angle : {0.0, 10.0, 45.0, 70.0, 89.0}) {
    const double half = std::cos(0.5 * (0.5 * pi - angle * deg));
    EXPECT_NEAR(200.0 + extension_at(shear_test(strip), angle * deg), sqrt2 * 200.0 * half, 1e-11);
    EXPECT_NEAR(200.0 * sqrt2 + extension_at(shear_test(frame), angle * deg), 2.0 * 200.0 * half,
                1e-11);
  }
}

TEST(ShearTests, PictureFrameLoadIsEquation41) {
  const Fabric fabric = glass();
  for (const double angle : {0.0, 3.0, 30.0, 60.0, 85.0}) {
    const double g = angle * deg;
    const double expected = 0.0625 * 200.0 * sqrt2 * fabric.crossings[0].shear.at(g).value /
                            (std::cos(0.5 * g) - std::sin(0.5 * g));
    const double d = extension_at(shear_test(frame), g);
    EXPECT_NEAR(test_load(shear_test(frame), fabric, d), expected, 1e-11 * expected);
  }
}

TEST(ShearTests, BiasLoadIsEquation40InAClosedPoint) {
  // gamma = 30 degrees: (1 + d/D)^2 = 3/2; 2 / (sqrt2 D sqrt(1 - 3/4)) = 4 / (sqrt2 D)
  const double d = 200.0 * (std::sqrt(1.5) - 1.0);
  const auto torque = [](double g) {
    return 0.37044 * g + 0.84105 * std::pow(g, 3) + 1.03113 * std::pow(g, 5);
  };
  const double expected =
      0.0625 * (15000.0 * torque(pi / 6.0) + 5000.0 * torque(pi / 12.0)) * 4.0 / (sqrt2 * 200.0);
  EXPECT_NEAR(shear_angle(shear_test(strip), d), pi / 6.0, 1e-14);
  EXPECT_NEAR(test_load(shear_test(strip), glass(), d), expected, 1e-12 * expected);
}

TEST(ShearTests, AngleAndExtensionAreInverse) {
  for (const ShearTest& test : {shear_test(strip), shear_test(frame)}) {
    EXPECT_EQ(shear_angle(test, 0.0), 0.0);
    EXPECT_EQ(extension_at(test, 0.0), 0.0);
    EXPECT_EQ(test_load(test, glass(), 0.0), 0.0);
    for (double g = -20.0; g < 90.0; g += 0.37)
      EXPECT_NEAR(shear_angle(test, extension_at(test, g * deg)), g * deg,
                  1e-13 / std::cos(g * deg));
  }
}

TEST(ShearTests, LockAt90DegreesAndNotBefore) {
  for (const ShearTest& test : {shear_test(strip), shear_test(frame)}) {
    const double end = locking_extension(test);
    EXPECT_NEAR(end, (sqrt2 - 1.0) * test.diagonal, 1e-12);
    EXPECT_LT(shear_angle(test, 0.9999999 * end), 0.5 * pi);
    EXPECT_GT(shear_angle(test, 0.9999999 * end), 0.5 * pi - 1e-3);
    EXPECT_TRUE(std::isnan(shear_angle(test, 1.0001 * end)));
  }
}

TEST(ShearTests, ZonesFillTheSpecimenWithTheTwoTrianglesAtTheClamps) {
  for (const double length : {200.0, 250.0, 400.0}) {
    const ShearTest test = shear_test(BiasSpecimen{length, 100.0});
    EXPECT_NEAR(test.whole_area + test.half_area + 0.5 * 100.0 * 100.0, length * 100.0, 1e-9);
  }
}

TEST(ShearTests, RefuseSpecimensThatTheEquationsDoNotHoldFor) {
  EXPECT_FALSE(fault_of(strip));
  EXPECT_FALSE(fault_of(BiasSpecimen{200.0, 100.0}));
  EXPECT_EQ(fault_of(BiasSpecimen{199.0, 100.0})->size, "length");
  EXPECT_EQ(fault_of(BiasSpecimen{200.0, 0.0})->size, "width");
  EXPECT_EQ(fault_of(BiasSpecimen{std::nan(""), 100.0})->size, "length");
  EXPECT_EQ(fault_of(FrameSpecimen{-1.0})->size, "side");
  EXPECT_TRUE(fault_of(FrameSpecimen{std::numeric_limits<double>::infinity()}));
  EXPECT_THROW(shear_test(BiasSpecimen{199.0, 100.0}), std::invalid_argument);
  EXPECT_THROW(shear_test(FrameSpecimen{0.0}), std::invalid_argument);
}

} // namespace
} // namespace plyform::shear_tests_test
