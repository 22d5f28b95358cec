// SPDX-License-Identifier: GPL-3.0-or-later
// The table of units: sizes from elsewhere, spellings, and what it does not know.
#include "base/geometry.hpp"
#include "base/units.hpp"

#include <gtest/gtest.h>
#include <set>

namespace plyform::units_test {
namespace {

using Q = Quantity;

struct Size {
  const char* name;
  Quantity quantity;
  double factor;
};

// By hand from the definitions: 1 in = 25.4 mm, 1 lb = 0.45359237 kg, g = 9.80665 m/s2.
const Size sizes[] = {{"mm", Q::length, 1.0},
                      {"km", Q::length, 1e6},
                      {"ft", Q::length, 304.8},
                      {"yd", Q::length, 914.4},
                      {"mil", Q::length, 0.0254},
                      {"thou", Q::length, 0.0254},
                      {"Zoll", Q::length, 25.4},
                      {"Inches", Q::length, 25.4},
                      {"mile", Q::length, 1609344.0},
                      {"LBF", Q::force, 0.45359237 * 9.80665},
                      {"lb", Q::force, 0.45359237 * 9.80665},
                      {"lbs", Q::force, 0.45359237 * 9.80665},
                      {"ozf", Q::force, 0.45359237 * 9.80665 / 16.0},
                      {"kip", Q::force, 453.59237 * 9.80665},
                      {"kp", Q::force, 9.80665},
                      {"kgf", Q::force, 9.80665},
                      {"tf", Q::force, 9806.65},
                      {"p", Q::force, 9.80665e-3},
                      {"dyn", Q::force, 1e-5},
                      {"kn", Q::force, 1000.0},
                      {"pdl", Q::force, 0.45359237 * 0.3048},
                      {"gon", Q::angle, 0.9 * degree},
                      {"Degrees", Q::angle, degree},
                      {"arcmin", Q::angle, degree / 60.0},
                      {"mm/m", Q::strain, 1e-3},
                      {"in/in", Q::strain, 1.0},
                      {"microstrain", Q::strain, 1e-6},
                      {"bar", Q::stress, 0.1},
                      {"PSI", Q::stress, 0.45359237 * 9.80665 / (25.4 * 25.4)},
                      {"lbf/in2", Q::stress, 0.45359237 * 9.80665 / (25.4 * 25.4)},
                      {"ksi", Q::stress, 453.59237 * 9.80665 / (25.4 * 25.4)},
                      {"kgf/cm2", Q::stress, 0.0980665},
                      {"dyn/cm^2", Q::stress, 1e-7},
                      {"N/m\xC2\xB2", Q::stress, 1e-6},
                      {"KPA", Q::stress, 1e-3},
                      {"mmHg", Q::stress, 133.3224e-6},
                      {"atm", Q::stress, 0.101325},
                      {"lbf/in", Q::force_per_length, 0.45359237 * 9.80665 / 25.4},
                      {"kgf/cm", Q::force_per_length, 0.980665},
                      {"kN/m", Q::force_per_length, 1.0},
                      {"hours", Q::time, 3600.0},
                      {"ms", Q::time, 1e-3},
                      {"N*mm", Q::other, 1.0},
                      {"ft-lb", Q::other, 1.0},
                      {"mm/min", Q::other, 1.0},
                      {"kg", Q::other, 1.0}};

TEST(UnitTable, HasTheSizesOfTheirDefinitions) {
  for (const Size& size : sizes) {
    const auto unit = find_unit(size.name);
    ASSERT_TRUE(unit) << size.name;
    EXPECT_EQ(quantity_name(unit->quantity), quantity_name(size.quantity)) << size.name;
    EXPECT_NEAR(unit->factor, size.factor, 1e-9 * size.factor) << size.name;
  }
}

TEST(UnitTable, NamesEachUnitOnce) {
  const std::vector<std::string> names = unit_names();
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  for (const std::string& name : names)
    EXPECT_TRUE(find_unit(name)) << name;
  EXPECT_GT(names.size(), 150u);
  EXPECT_LT(unit_names(Q::force).size(), names.size());
}

TEST(UnitTable, DoesNotGuess) {
  for (const char* name : {"furlong", "", "mm/furlong", "N/mm4", "mm^", "/", "N//mm", "lbfs", "2"})
    EXPECT_FALSE(find_unit(name)) << name;
  // read as one as often as as the other
  for (const char* name : {"MN", "Mm", "mpa", "ton", "TONS", "tonf", "Grad"}) {
    EXPECT_FALSE(find_unit(name)) << name;
    EXPECT_NE(ambiguous_unit(name), "") << name;
  }
  EXPECT_EQ(ambiguous_unit("furlong"), "");
  EXPECT_EQ(ambiguous_unit("mm"), "");
}

TEST(UnitTable, ListsOneNameOfEachSize) {
  const std::string forces = units_of(Q::force);
  for (const char* name : {"kN", "lbf", "kgf", "kip"})
    EXPECT_NE(forces.find(name), std::string::npos) << name;
  EXPECT_EQ(forces.find("pounds"), std::string::npos);
  EXPECT_EQ(forces.find("mm"), std::string::npos);
}

} // namespace
} // namespace plyform::units_test
