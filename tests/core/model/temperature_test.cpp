// SPDX-License-Identifier: GPL-3.0-or-later
// Factors over temperature against numbers computed by hand, and temperatures over time.
#include "core/model/temperature.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <stdexcept>

namespace plyform::temperature_test {
namespace {

TEST(TemperatureFactor, IsOneUnlessALawSaysOtherwise) {
  const TemperatureFactor none;
  EXPECT_FALSE(none.depends());
  EXPECT_EQ(none.at(-40.0), 1.0);
  EXPECT_EQ(none.at(400.0), 1.0);
}

TEST(TemperatureFactor, OfArrheniusIsThatOfTheHandbook) {
  // E = 41 kJ/mol, from 180 to 200 degC: E/R = 4931.17 K; 1/473.15 - 1/453.15 = -9.32817e-5 1/K;
  // exp(-0.459980) = 0.631296
  const TemperatureFactor melt(ArrheniusFactor{41000.0, 180.0});
  EXPECT_TRUE(melt.depends());
  EXPECT_EQ(melt.at(180.0), 1.0);
  EXPECT_NEAR(melt.at(200.0), 0.631296, 1e-6);
  // colder by 20 K: 1/433.15 - 1/453.15 = 1.018940e-4; exp(0.502458) = 1.652778
  EXPECT_NEAR(melt.at(160.0), 1.652778, 1e-6);
  // a million at 1/T = 1/453.15 + 6 ln(10)/4931.17, 199.66 K, and no more
  EXPECT_NEAR(melt.range().least, 199.66 - 273.15, 0.01);
  EXPECT_NEAR(melt.at(melt.range().least), 1e6, 1.0);
  EXPECT_EQ(melt.at(-300.0), melt.at(melt.range().least));
}

TEST(TemperatureFactor, OfWlfIsTheOneShiftInBothFormsOfItsConstants) {
  // 10^(-17.44 * 50 / 101.6) from the glass transition to 50 K above it
  const TemperatureFactor at_glass(WlfFactor{17.44, 51.6, 100.0});
  EXPECT_EQ(at_glass.at(100.0), 1.0);
  EXPECT_NEAR(std::log10(at_glass.at(150.0)), -17.44 * 50.0 / 101.6, 1e-12);
  // Williams, Landel and Ferry give the same law with the reference 50 K above it: C1 = 8.86,
  // C2 = 101.6; T_g + 50 to T_g + 100 is -8.86 * 50 / 151.6 there, -2.922
  const TemperatureFactor above(WlfFactor{8.86, 101.6, 150.0});
  EXPECT_NEAR(std::log10(above.at(200.0)), -2.9222, 1e-4);
  EXPECT_NEAR(std::log10(at_glass.at(200.0) / at_glass.at(150.0)), -2.9222, 0.05);
  // a million at 6 C2 / (C1 + 6) = 41.0 K below the reference, and no more
  EXPECT_NEAR(above.range().least, 150.0 - 41.023, 1e-3);
  EXPECT_NEAR(above.at(above.range().least), 1e6, 1.0);
  EXPECT_EQ(above.at(60.0), above.at(above.range().least));
}

TEST(TemperatureFactor, OfATableGoesThroughItsPointsAndNeverTurns) {
  // viscosities in Pa s, of which the one at the reference is taken out
  const TemperatureFactor table(
      TableFactor{{160.0, 180.0, 200.0, 220.0}, {5200.0, 3100.0, 2000.0, 1900.0}, 180.0});
  EXPECT_EQ(table.at(180.0), 1.0);
  EXPECT_NEAR(table.at(160.0), 5200.0 / 3100.0, 1e-14);
  EXPECT_NEAR(table.at(220.0), 1900.0 / 3100.0, 1e-14);
  for (double t = 160.0; t < 220.0; t += 0.25)
    EXPECT_GT(table.at(t), table.at(t + 0.25)) << t;
  EXPECT_EQ(table.at(150.0), table.at(160.0)); // held
  EXPECT_EQ(table.range().text(), "160 to 220 degC");
  EXPECT_TRUE(table.range().holds(160.0));
  EXPECT_FALSE(table.range().holds(220.5));
  // two points: an exponential between them, so that the middle has the geometric mean
  const TemperatureFactor two(TableFactor{{150.0, 250.0}, {400.0, 100.0}, 150.0});
  EXPECT_NEAR(two.at(200.0), 0.5, 1e-15);
}

TEST(TemperatureFactor, ExtremesAreThoseOfASearch) {
  const TemperatureFactor none, melt(ArrheniusFactor{41000.0, 180.0}),
      turns(TableFactor{{100.0, 120.0, 150.0, 180.0}, {1.0, 4.0, 0.5, 2.0}, 150.0});
  for (const TemperatureFactor& law : {none, melt, turns})
    for (const TemperatureRange& range : {TemperatureRange{90.0, 200.0},
                                          {110.0, 130.0},
                                          {125.0, 140.0},
                                          {160.0, 160.0},
                                          {130.0, 170.0}}) {
      double least = law.at(range.least), most = least;
      for (double t = range.least; t <= range.most; t += 0.25)
        least = std::min(least, law.at(t)), most = std::max(most, law.at(t));
      EXPECT_EQ(law.extremes(range), std::pair(least, most)) << range.text();
    }
}

TEST(TemperatureFactor, RefusesTablesThatAreNone) {
  const auto make = [](std::vector<double> t, std::vector<double> v, double reference) {
    return TemperatureFactor(TableFactor{std::move(t), std::move(v), reference});
  };
  EXPECT_THROW(make({150.0}, {1.0}, 150.0), std::invalid_argument);
  EXPECT_THROW(make({150.0, 150.0}, {1.0, 2.0}, 150.0), std::invalid_argument);
  EXPECT_THROW(make({150.0, 160.0}, {1.0, 0.0}, 150.0), std::invalid_argument);
  EXPECT_THROW(make({150.0, 160.0}, {1.0, 2.0}, 170.0), std::invalid_argument);
}

TEST(TemperatureAt, IsStraightBetweenStagesAndStaysBeyondThem) {
  const std::vector<TemperatureStage> stages{{2.0, 200.0}, {6.0, 100.0}, {8.0, 100.0}};
  EXPECT_EQ(temperature_at(stages, 0.0), 200.0);
  EXPECT_EQ(temperature_at(stages, 2.0), 200.0);
  EXPECT_EQ(temperature_at(stages, 3.0), 175.0);
  EXPECT_EQ(temperature_at(stages, 7.0), 100.0);
  EXPECT_EQ(temperature_at(stages, 1e6), 100.0);
}

} // namespace
} // namespace plyform::temperature_test
