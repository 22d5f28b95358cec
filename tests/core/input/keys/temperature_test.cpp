// SPDX-License-Identifier: GPL-3.0-or-later
// Temperatures and cooling as a case file gives them; wrong ones are in tests/data/broken.
#include "support/case_files.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace plyform::temperature_keys_test {
namespace {

TEST(Temperatures, AreReadInTheProgramsUnits) {
  const Case read = good_case(data_folder / "good" / "temperature.toml");
  ASSERT_EQ(read.plies.size(), 2u);
  EXPECT_TRUE(has_temperature(read));
  EXPECT_EQ(start_temperature(read, read.plies[0]), 180.0);
  EXPECT_EQ(start_temperature(read, read.plies[1]), 190.0);
  ASSERT_EQ(read.tools.size(), 2u);
  EXPECT_EQ(tool_temperature(read, read.tools[0], 3.0), 60.0);
  EXPECT_EQ(tool_temperature(read, read.tools[1], 4.0), 90.0); // half of the way in 8 s
  EXPECT_EQ(tool_temperature(read, read.tools[1], 20.0), 120.0);
  EXPECT_NEAR(read.fabrics[0].heat_capacity.value(), 1.2e9, 1.0); // N mm/(t K)
  ASSERT_TRUE(read.process.cooling);
  const Cooling& cooling = *read.process.cooling;
  EXPECT_NEAR(cooling.to_tools, 0.4, 1e-15); // N/(mm s K)
  EXPECT_NEAR(cooling.to_air, 0.02, 1e-15);
  EXPECT_NEAR(cooling.to_plies, 0.5, 1e-15);
  EXPECT_EQ(cooling.surroundings, (std::vector<TemperatureStage>{{2.0, 180.0}, {6.0, 25.0}}));
  const Case other = good_case(data_folder / "good" / "cooling.toml");
  EXPECT_EQ(other.process.cooling.value().surroundings,
            (std::vector<TemperatureStage>{{0.0, 25.0}}));
  EXPECT_EQ(other.process.cooling->to_plies, 0.0);
}

TEST(Temperatures, LawsAreReadAndWarnedOfWhereTheyHaveNothingToActOn) {
  const PreparedCase read = prepare_case(data_folder / "good" / "temperature.toml", {});
  ASSERT_TRUE(read.value) << all_texts(read);
  const Fabric& prepreg = read.value->fabrics[0];
  EXPECT_EQ(prepreg.flow_reference, 180.0);
  EXPECT_NEAR(prepreg.flow.at(150.0), 9000.0 / 3100.0, 1e-12);
  EXPECT_EQ(prepreg.flow.range().text(), "150 to 220 degC");
  std::string warnings;
  for (const std::string& warning : read.warnings)
    warnings += warning + "\n";
  EXPECT_NE(warnings.find("temperature.toml:14:1: warning: temperature of fabric prepreg: does "
                          "nothing, as no law of it depends on rates"),
            std::string::npos)
      << warnings;
  EXPECT_NE(warnings.find("ply lower may come to "), std::string::npos) << warnings;
  const Case other = good_case(data_folder / "good" / "cooling.toml");
  EXPECT_NEAR(other.fabrics[0].flow.at(200.0), 0.631296, 1e-6); // 41 kJ/mol
  EXPECT_NEAR(std::log10(other.fabrics[1].flow.at(230.0)), -8.86 * 50.0 / 151.6, 1e-12);
}

TEST(Temperatures, ElasticShearHasATableOfItsOwnAndNeedsNoRates) {
  const PreparedCase read = prepare_case(data_folder / "good" / "shear_temperature.toml", {});
  ASSERT_TRUE(read.value) << all_texts(read);
  EXPECT_TRUE(read.warnings.empty()) << read.warnings.front();
  EXPECT_FALSE(read.value->process.duration);
  const Fabric& prepreg = read.value->fabrics[0];
  EXPECT_FALSE(prepreg.flow.depends());
  EXPECT_EQ(prepreg.shear_over_temperature.at(180.0), 1.0);
  EXPECT_NEAR(prepreg.shear_over_temperature.at(160.0), 1.6, 1e-12);
  EXPECT_EQ(prepreg.shear_over_temperature.range().text(), "160 to 220 degC");
}

TEST(Temperatures, AreNoneWhereNoneIsGiven) {
  const Case read = good_case(data_folder / "good" / "base.toml");
  EXPECT_FALSE(has_temperature(read));
  EXPECT_FALSE(start_temperature(read, read.plies[0]));
  EXPECT_FALSE(read.process.cooling);
}

} // namespace
} // namespace plyform::temperature_keys_test
