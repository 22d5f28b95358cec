// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of friction as a case file gives them; wrong ones are in tests/data/broken.
#include "core/accuracy/error_model.hpp"
#include "core/setup/friction_ahead.hpp"
#include "support/case_files.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace plyform::friction_laws_test {
namespace {

Case read() {
  return good_case(data_folder / "good" / "friction.toml");
}

const FrictionLawSpec& law(const Case& data, int a, int b) {
  return data.friction_laws.at(static_cast<std::size_t>(data.friction.law_of(a, b)))->spec();
}

TEST(FrictionLaws, AreGivenToPairsTheLastThatFits) {
  const Case data = read();
  EXPECT_EQ(law(data, 0, 1).name, "dry");
  EXPECT_EQ(law(data, 1, 0).name, "dry");
  EXPECT_EQ(law(data, 1, 2).name, "resin");
  EXPECT_EQ(law(data, 2, 2).name, "resin"); // of a ply with itself
  EXPECT_EQ(law(data, 2, 3).name, "film");
  EXPECT_EQ(data.friction.law_of(0, 3), -1);
  EXPECT_EQ(data.friction(0, 3), 0.25);
}

TEST(FrictionLaws, AreReadInUnitsOfTheProgram) {
  const Case data = read();
  const FrictionLawSpec& resin = law(data, 1, 2);
  EXPECT_EQ(resin.kind, FrictionLawSpec::Kind::hersey);
  EXPECT_TRUE(resin.film_beyond);
  EXPECT_NEAR(resin.viscosity_at(10.0), std::sqrt(500e-6 * 50e-6), 1e-15); // N s/mm^2
  EXPECT_NEAR(resin.hersey(1e-2), std::sqrt(0.06), 1e-12);
  const FrictionLawSpec& film = law(data, 2, 3);
  EXPECT_EQ(film.viscosity, 300.0 * 1e-6);
  EXPECT_EQ(film.film, 0.1);
  EXPECT_EQ(film.yield, 0.001);
  EXPECT_EQ(film.over_slip.size(), 2u);
  EXPECT_EQ(film.tack.front().value, 0.01);
  const FrictionLawSpec& dry = law(data, 0, 1);
  EXPECT_NEAR(FrictionLaw(dry).by_angle(std::atan(1.0)), 0.3, 1e-12); // 45 degrees
  EXPECT_EQ(dry.over_wear.back().value, 0.7);
  const FrictionLawSpec& formula = data.friction_laws.at(1)->spec();
  EXPECT_EQ(formula.name, "stribeck");
  EXPECT_NEAR(formula.hersey(4e-3), 0.2 * std::exp(-2.0) + 1.5 * std::sqrt(4e-3), 1e-12);
}

TEST(FrictionLaws, WithRatesAreNotWhatErrorsWereMeasuredFor) {
  Case data = read();
  EXPECT_EQ(not_measured(data), "not measured: friction.resin depends on the slip speed");
  data.friction.law.assign(data.friction.law.size(), -1);
  EXPECT_EQ(not_measured(data), "");
}

TEST(FrictionLaws, AreToldWithTheRangeThatARunWillReach) {
  Case data = read();
  data.boundaries[1].as<Grip>().stroke = 15.0; // mm in 5 s, 4/3 of it in the middle: 4 mm/s
  const auto all = [&] {
    std::string text;
    for (const std::string& line : friction_ahead(data))
      text += line + "\n";
    return text;
  };
  const std::string told = all();
  EXPECT_NE(told.find("friction resin: slip of 4 mm/s at most in the process"), std::string::npos)
      << told;
  EXPECT_NE(told.find("friction film: slip of 4 mm/s"), std::string::npos) << told;
  EXPECT_EQ(told.find("stribeck"), std::string::npos) << told; // nobody has it
  EXPECT_EQ(told.find("warning"), std::string::npos) << told;  // 80 1/s; pressures are not known
  PressureLoad load;
  load.ply = 2, load.pressure = 1e-4;
  data.loads = {load};
  EXPECT_NE(all().find("warning: the run reaches Hersey numbers of"), std::string::npos) << all();
  data.process.duration = 1.0; // 400 1/s
  EXPECT_NE(all().find("warning: rates in the film reach 400 1/s"), std::string::npos) << all();
  data.boundaries[1].as<Grip>().stroke = 0.0;
  EXPECT_NE(all().find("nothing is driven"), std::string::npos) << all();
}

TEST(FrictionLaws, FollowTheTemperature) {
  const fs::path file = data_folder / "good" / "film_temperature.toml";
  const PreparedCase read = prepare_case(file, {});
  ASSERT_TRUE(read.value) << all_texts(read);
  const Case& data = *read.value;
  const FrictionLawSpec &melt = law(data, 0, 1), &film = law(data, 0, 2);
  EXPECT_EQ(melt.viscosity, 600.0 * 1e-6);
  EXPECT_NEAR(melt.flow_at(200.0), 0.631296, 1e-6); // 41 kJ/mol
  EXPECT_NEAR(film.flow_at(110.0), 3.0, 1e-12);
  EXPECT_EQ(film.flow.most, 220.0);
  EXPECT_EQ(film.flow_at(std::nan("")), 1.0);
  // of 180 and 200 degC on a floor of 60 to 20: 100 to 130 degC
  std::string warnings, told;
  for (const std::string& warning : read.warnings)
    warnings += warning + "\n";
  EXPECT_NE(warnings.find("friction film: films may come to 100 to 130 degC, means of both bodies, "
                          "and their viscosity is known for 110 to 220 degC"),
            std::string::npos)
      << warnings;
  EXPECT_EQ(warnings.find("friction melt"), std::string::npos) << warnings;
  for (const std::string& line : friction_ahead(data))
    told += line + "\n";
  // 41 kJ/mol, from 200 degC of the upper ply alone to 180 of the lower
  EXPECT_NE(told.find("viscosity at the temperatures of its films: 0.631 to 1 times"),
            std::string::npos)
      << told;
}

} // namespace
} // namespace plyform::friction_laws_test
