// SPDX-License-Identifier: GPL-3.0-or-later
// Mean and scatter of several laboratories' laws, and the laws beside the mean.
#include "base/geometry.hpp"
#include "core/identify/laboratories.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <stdexcept>

namespace plyform::laboratories_test {
namespace {

LaboratoryCurve line(const std::string& name, double slope, double to_degrees) {
  return {name, ShearLaw{.k = {slope}, .angle = {}, .torque = {}}, to_degrees * degree};
}

TEST(Laboratories, CountTheSameHoweverManyCurvesTheyHave) {
  const LaboratoryMean mean = laboratory_mean(
      {line("A", 1.0, 40.0), line("B", 4.0, 40.0), line("A", 3.0, 40.0), line("C", 6.0, 40.0)});
  ASSERT_EQ(mean.laboratories.size(), 3u);
  EXPECT_EQ(mean.laboratories[0].curves, 2u);
  EXPECT_DOUBLE_EQ(mean.common, 40.0 * degree);
  for (const double g : {0.25, 10.0, 40.0}) { // A has 2, B 4, C 6
    const double at = g * degree;
    EXPECT_NEAR(mean.value_at(mean.mean, at), 4.0 * at, 1e-12);
    EXPECT_NEAR(mean.value_at(mean.between, at), 2.0 * at, 1e-12);
    EXPECT_NEAR(mean.value_at(mean.within, at), std::sqrt(2.0) * at, 1e-12);
  }
  EXPECT_THROW(laboratory_mean({line("A", 1.0, 40.0), line("A", 3.0, 40.0)}),
               std::invalid_argument);
}

TEST(Laboratories, GoOnByTheGrowthOfThoseThatReach) {
  const LaboratoryMean mean =
      laboratory_mean({line("A", 1.0, 30.0), line("B", 3.0, 40.0), line("C", 5.0, 45.25)});
  EXPECT_DOUBLE_EQ(mean.common, 30.0 * degree);
  EXPECT_NEAR(mean.angle.back(), 45.25 * degree, 1e-12);
  EXPECT_NEAR(mean.value_at(mean.mean, 30.0 * degree), 3.0 * 30.0 * degree, 1e-12);
  // All laws grow as their angle; the deviation stays two thirds, more than that of B and C.
  EXPECT_NEAR(mean.value_at(mean.mean, 40.0 * degree), 3.0 * 40.0 * degree, 1e-12);
  EXPECT_NEAR(mean.mean.back(), 3.0 * 45.25 * degree, 1e-12);
  EXPECT_NEAR(mean.value_at(mean.between, 40.0 * degree), 2.0 * 40.0 * degree, 1e-12);
  EXPECT_NEAR(mean.between.back(), 2.0 * 45.25 * degree, 1e-12);
  EXPECT_EQ(mean.reach.front(), 3u);
  EXPECT_EQ(mean.reach.back(), 1u);
  EXPECT_TRUE(std::isnan(mean.laboratories[0].torque.back()));
  EXPECT_TRUE(std::isnan(mean.within.front()));
}

/// All agree up to 30 degrees; to 40 B grows by a third and C fourfold, their mean by 8/3.
TEST(Laboratories, GoOnByTheScatterOfThoseThatReachWhereItIsMore) {
  ShearLaw late{.k = {},
                .angle = {0.0, 30.0 * degree, 40.0 * degree},
                .torque = {0.0, 3.0 * degree, 12.0 * degree}};
  const LaboratoryMean mean =
      laboratory_mean({line("A", 0.1, 30.0), line("B", 0.1, 40.0), {"C", late, 40.0 * degree}});
  EXPECT_NEAR(mean.value_at(mean.mean, 30.0 * degree), 3.0 * degree, 1e-12);
  EXPECT_NEAR(mean.mean.back(), 8.0 * degree, 1e-12);
  EXPECT_NEAR(mean.value_at(mean.between, 30.0 * degree), 0.0, 1e-12);
  EXPECT_NEAR(mean.between.back(), std::sqrt(32.0) * degree, 1e-12); // of 4 and 12
}

TEST(Laboratories, HaveLawsBesideTheirMean) {
  const ShearLaw stiff{.k = {1.0, 2.0, 9.0}, .angle = {}, .torque = {}};
  const ShearLaw soft{.k = {0.5, 1.0, 4.5}, .angle = {}, .torque = {}};
  const LaboratoryMean mean =
      laboratory_mean({{"A", stiff, 50.0 * degree}, {"B", soft, 50.0 * degree}});
  const double spread = 0.25 * std::sqrt(2.0);
  for (const double deviations : {-1.0, 0.0, 1.0}) {
    const DeviatedLaw law = deviated_law(mean, deviations);
    EXPECT_FALSE(law.cut_from);
    EXPECT_LE(law.law.angle.size(), 12u);
    EXPECT_TRUE(law.law.odd());
    for (double g = 0.0; g <= 50.0; g += 0.25) {
      const double wanted = (0.75 + deviations * spread) * stiff.at(g * degree).value;
      EXPECT_NEAR(law.law.at(g * degree).value, wanted,
                  0.011 * std::max(wanted, 0.11 * stiff.at(50.0 * degree).value))
          << g;
      EXPECT_GE(law.law.at(g * degree).slope, 0.0);
    }
  }
}

TEST(Laboratories, CutWhatWouldFallOrBeNegative) {
  // C's law is far above that of the others up to 20 degrees: the mean less a deviation is
  // negative.
  ShearLaw early{.k = {}, .angle = {0.0, 20.0 * degree, 40.0 * degree}, .torque = {0.0, 9.0, 9.1}};
  const LaboratoryMean mean =
      laboratory_mean({line("A", 0.1, 40.0), line("B", 0.1, 40.0), {"C", early, 40.0 * degree}});
  const DeviatedLaw law = deviated_law(mean, -1.0);
  ASSERT_TRUE(law.cut_from);
  EXPECT_NEAR(*law.cut_from, 0.5 * degree, 1e-9);
  for (double g = 0.0; g <= 40.0; g += 0.25) {
    EXPECT_GE(law.law.at(g * degree).value, 0.0);
    EXPECT_GE(law.law.at(g * degree).slope, 0.0);
  }
  EXPECT_FALSE(deviated_law(mean, 1.0).cut_from);
}

} // namespace
} // namespace plyform::laboratories_test
