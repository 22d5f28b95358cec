// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of yarns and cells: slope, value and energy belong together.
#include "core/model/fabric.hpp"
#include "support/membrane_checks.hpp"

#include <gtest/gtest.h>

namespace plyform::fabric_test {
namespace {

constexpr double h = 1e-6; // strain or rad: cut-off 1e-12 relative, rounding 1e-9

template <class Law>
void expect_consistent(const Law& law, double at, double scale) {
  const LawPoint p = law.at(at), below = law.at(at - h), above = law.at(at + h);
  EXPECT_NEAR(p.slope, (above.value - below.value) / (2.0 * h), 1e-7 * scale) << at;
  EXPECT_NEAR(p.value, (above.energy - below.energy) / (2.0 * h), 1e-7 * scale) << at;
}

TensionLaw crimped() { // soft until the crimp is gone
  TensionLaw law;
  law.strain = {0.0, 0.002, 0.005, 0.01};
  law.tension = {0.0, 10.0, 90.0, 320.0};
  return law;
}

TEST(TensionLaw, SlopeAndEnergyBelongToTheTension) {
  TensionLaw line;
  line.stiffness = 46000.0;
  for (const double strain : {-0.1, -1e-4, 1e-4, 0.003, 0.0049, 0.008, 0.011, 0.5}) {
    expect_consistent(line, strain, 46000.0);
    expect_consistent(crimped(), strain, 46000.0);
  }
}

TEST(TensionLaw, CarriesTensionOnly) {
  TensionLaw line;
  line.stiffness = 46000.0;
  for (const TensionLaw& law : {line, crimped()})
    for (const double strain : {-1.0, -1e-9, 0.0}) {
      const LawPoint p = law.at(strain);
      EXPECT_EQ(p.value, 0.0);
      EXPECT_EQ(p.slope, 0.0);
      EXPECT_EQ(p.energy, 0.0);
    }
}

TEST(TensionLaw, TakesCompressionIfAskedTo) {
  for (TensionLaw law : {TensionLaw{46000.0, {}, {}}, crimped()}) {
    law.compression = 400.0;
    for (const double strain : {-0.9, -1e-4, 1e-4, 0.003})
      expect_consistent(law, strain, 46000.0);
    EXPECT_EQ(law.at(-0.01).value, -4.0);
    EXPECT_EQ(law.at(0.0).value, 0.0);
    EXPECT_NEAR(law.largest_slope(), 46000.0, 1e-6); // of tension
  }
}

TEST(TensionLaw, BucklesAtItsForceAndComesBackTheSameWay) {
  for (TensionLaw law : {TensionLaw{46000.0, {}, {}}, crimped()}) {
    law.compression = 400.0;
    law.buckling_force = 2.0; // at a strain of 0.005
    EXPECT_EQ(law.buckling_strain(), 0.005);
    for (const double strain : {-0.9, -0.0051, -0.0049, -1e-4, 1e-4, 0.003})
      expect_consistent(law, strain, 46000.0);
    EXPECT_NEAR(law.at(-0.004).value, -1.6, 1e-14);
    EXPECT_NEAR(law.at(-0.005).value, -2.0, 1e-14);
    EXPECT_NEAR(law.at(-0.105).value, -2.0 - 4.0 * 0.1, 1e-13); // 0.01 of 400 N
    EXPECT_NEAR(law.at(-0.105).slope, 4.0, 1e-12);
    // a triangle, and a trapezium beyond
    EXPECT_NEAR(law.at(-0.105).energy, 0.5 * 2.0 * 0.005 + 0.5 * (2.0 + 2.4) * 0.1, 1e-13);
    const double tension = law.at(0.003).value;
    law.buckling_force = 0.0; // takes 0.01 of its stiffness from the start
    EXPECT_NEAR(law.at(-0.1).value, -0.4, 1e-13);
    EXPECT_EQ(law.at(0.003).value, tension);
    law.buckling_force = std::numeric_limits<double>::infinity();
    EXPECT_FALSE(law.buckles());
    EXPECT_EQ(law.at(-0.1).value, -40.0);
  }
}

TEST(TensionLaw, IsSoftenedNoFurtherThanItsCompression) {
  for (TensionLaw law : {TensionLaw{46000.0, {}, {}}, crimped()}) {
    law.compression = 460.0;
    law.buckling_force = 5.0;
    const TensionLaw some = softened(law, 10.0), much = softened(law, 1000.0);
    EXPECT_EQ(effective_softening(law, 10.0), 10.0);
    EXPECT_NEAR(effective_softening(law, 1000.0), 100.0, 1e-12);
    EXPECT_NEAR(some.largest_slope(), 4600.0, 1e-6);
    EXPECT_NEAR(much.largest_slope(), 460.0, 1e-6);
    EXPECT_NEAR(some.at(0.003).value, 0.1 * law.at(0.003).value, 1e-12);
    for (const TensionLaw& soft : {some, much}) // the cloth that is pressed stays the same
      for (const double strain : {-0.3, -0.005})
        EXPECT_EQ(soft.at(strain).value, law.at(strain).value);
    law.compression = 0.0;
    EXPECT_EQ(effective_softening(law, 1000.0), 1000.0);
    EXPECT_EQ(softened(law, 1000.0).largest_slope(), law.largest_slope() / 1000.0);
  }
}

TEST(TensionLaw, FollowsItsTableAndGoesOnWithTheLastSlope) {
  const TensionLaw law = crimped();
  for (std::size_t i = 0; i < law.strain.size(); ++i)
    EXPECT_NEAR(law.at(law.strain[i]).value, law.tension[i], 1e-12);
  EXPECT_NEAR(law.at(0.0035).value, 50.0, 1e-12);
  EXPECT_NEAR(law.at(0.02).value, 320.0 + 46000.0 * 0.01, 1e-9);
  EXPECT_NEAR(law.at(0.02).slope, 46000.0, 1e-6);
  EXPECT_NEAR(law.largest_slope(), 46000.0, 1e-6);
  // areas under the table: 0.01 + 0.15 + 1.025, and a trapezium beyond
  EXPECT_NEAR(law.at(0.01).energy, 1.185, 1e-12);
  EXPECT_NEAR(law.at(0.02).energy, 1.185 + 0.5 * (320.0 + 780.0) * 0.01, 1e-12);
}

TEST(ShearLaw, SlopeAndEnergyBelongToTheTorqueAndItIsOdd) {
  ShearLaw table;
  table.angle = {0.0, 0.3, 0.8};
  table.torque = {0.0, 0.1, 0.9};
  for (const ShearLaw& law : {glass_weave().crossings[0].shear, table})
    for (const double angle : {-1.2, -0.5, -0.2, -0.01, 0.01, 0.25, 0.6, 0.9, 1.5}) {
      expect_consistent(law, angle, 10.0);
      const LawPoint p = law.at(angle), mirrored = law.at(-angle);
      EXPECT_EQ(p.value, -mirrored.value);
      EXPECT_EQ(p.slope, mirrored.slope);
      EXPECT_EQ(p.energy, mirrored.energy);
      EXPECT_GT(p.value * angle, 0.0);
      EXPECT_GT(p.energy, 0.0);
    }
  // beyond the end on with its slope, that of the parabola through the last three points
  const double end = (1.3 * 1.6 - 0.5 * 0.1 / 0.3) / 0.8;
  EXPECT_NEAR(table.at(1.0).value, 0.9 + end * 0.2, 1e-12);
  EXPECT_EQ(table.at(0.0).value, 0.0);
  EXPECT_NEAR(table.at(0.0).slope, 0.1 / 0.3, 1e-15);
}

TEST(ShearLaw, IsThePapersPolynomial) {
  // Hamila and Boisse 2008, table 1, at 0.5 rad, by hand
  const LawPoint p = glass_weave().crossings[0].shear.at(0.5);
  EXPECT_NEAR(p.value, 0.18522 + 0.10513125 + 0.0322228125, 1e-12);
  EXPECT_NEAR(p.energy, 0.046305 + 0.01314140625 + 0.002685234375, 1e-12);
}

} // namespace
} // namespace plyform::fabric_test
