// SPDX-License-Identifier: GPL-3.0-or-later
// --set KEY=VALUE, and the checks of the scene as a whole on a case changed by it.
#include "support/case_files.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>

namespace plyform::overrides_test {
namespace {

constexpr double pi = std::numbers::pi;

Case base_with(const std::vector<Override>& overrides) {
  return good_case(data_folder / "good/base.toml", overrides);
}

/// The one error that an override gives.
CaseError override_error(const std::string& key, const std::string& value) {
  const PreparedCase reading = prepare_case(data_folder / "good/base.toml", {{key, value}});
  EXPECT_EQ(reading.errors.size(), 1u) << key << "=" << value << "\n" << all_texts(reading);
  EXPECT_FALSE(reading.value);
  return reading.errors.empty() ? CaseError{} : reading.errors.front();
}

TEST(Override, ChangesAnyValueTheLastOneWins) {
  const Case c = base_with({{"tool.0.radius", "3"},
                            {"ply.0.angle", "10"},
                            {"ply.0.angle", "30"},
                            {"tool.0.position.2", "7.5"},
                            {"solver.outputs", "3"}});
  ASSERT_EQ(c.tools.size(), 2u);
  EXPECT_EQ(std::get<Sphere>(c.tools[0].shape).radius, 3.0);
  EXPECT_DOUBLE_EQ(c.plies[0].angle, pi / 6.0);
  EXPECT_EQ(c.tools[0].position, Vec3(0, 0, 7.5));
  EXPECT_EQ(c.solver.outputs, 3);
}

TEST(Override, NamesItemsOfLists) {
  const Case before = base_with({});
  const std::string name = before.tools[1].name;
  const Case c = base_with(
      {{"tool." + name + ".position.2", "7.5"}, {"ply." + before.plies[0].name + ".angle", "30"}});
  EXPECT_EQ(c.tools[1].position.z(), 7.5);
  EXPECT_EQ(c.tools[0].position, before.tools[0].position);
  EXPECT_DOUBLE_EQ(c.plies[0].angle, pi / 6.0);
  EXPECT_NE(override_error("tool.none.radius", "3").text().find(name), std::string::npos);
  EXPECT_EQ(override_error("tool.2.radius", "3").rule, "tool has no item 2");
}

/// Digits are a number even where an item has them for its name, which is warned of.
TEST(Override, TakesDigitsForANumber) {
  const PreparedCase reading = prepare_case(
      data_folder / "good/base.toml", {{"tool.1.name", "\"0\""}, {"tool.0.position.2", "7.5"}});
  ASSERT_TRUE(reading.value) << all_texts(reading);
  EXPECT_EQ(reading.value->tools[0].position.z(), 7.5);
  const std::vector<std::string>& told = reading.warnings;
  EXPECT_EQ(std::count_if(told.begin(), told.end(),
                          [](const std::string& text) {
                            return text.find("tool.1.name = \"0\"") != std::string::npos;
                          }),
            1);
}

TEST(Override, TakesBareWordsAsStrings) {
  const Case c = base_with({{"tool.0.motion", "force"},
                            {"tool.0.force", "5"},
                            {"tool.0", "{name = 'roll', shape = 'sphere', radius = 2, position = "
                                       "[0, 0, 9], motion = 'force', force = 6}"},
                            {"title", "two words"}});
  ASSERT_EQ(c.tools.size(), 2u);
  EXPECT_EQ(c.tools[0].motion, Motion::force);
  EXPECT_EQ(c.tools[0].force, 6.0);
  EXPECT_EQ(c.title, "two words");
}

TEST(Override, MakesTablesThatAreNotThere) {
  const Case c = good_case(data_folder / "good/inline.toml", {{"contact.friction", "0.4"},
                                                              {"blanks.new.size", "[4, 6]"},
                                                              {"blanks.new.element_size", "2"},
                                                              {"ply.0.blank", "new"}});
  EXPECT_EQ(c.friction(0, 0), 0.4);
  ASSERT_EQ(c.blanks.size(), 2u);
  EXPECT_EQ(c.blanks[c.plies[0].blank].outline.boundary[2], Vec2(2, 3));
}

TEST(Override, ReachesIntoFabricFilesAndExchangesThem) {
  EXPECT_EQ(base_with({{"fabrics.plain.thickness", "0.4"}}).fabrics.at(0).thickness, 0.4);
  EXPECT_EQ(base_with({{"fabrics.plain", "../fabrics/tables.toml"}}).fabrics.at(0).name,
            "skew fabric");
}

TEST(Override, PointsAtItsOwnMistakes) {
  struct {
    std::string key, value;
    int column;
    std::string fragment;
  } const wrong[] = {
      {"ply.3.angle", "1", 5, "ply has no item 3; its items are numbered from 0 to 0"},
      {"ply.first.angle", "1", 5, "ply has no item first"},
      {"tool.0.raduis", "5", 8, "did you mean radius?"},
      {"contct.friction", "0.1", 1, "did you mean contact?"},
      {"contact.friction", "-1", 18, "contact.friction = -1: must be at least 0"},
      {"contact.friction", "low", 18, "contact.friction = low: must be a number"},
      {"ply.0.angle", "[1", 13, "must be a TOML value or a word"},
      {"ply.0.angle", "", 13, "must be a TOML value or a word"},
      {"title.x", "1", 7, "title is a single value and has no x"},
      {"tool.0.inner_radius", "1", 8, "inner_radius is no key of shape sphere"},
      {"fabrics.plain", "absent.toml", 15, "No such file"},
      {"", "1", 1, "unknown key"},
  };
  for (const auto& [key, value, column, fragment] : wrong) {
    const CaseError error = override_error(key, value);
    EXPECT_EQ(error.file, "--set") << error.text();
    EXPECT_EQ(error.line, 1);
    EXPECT_EQ(error.column, column) << error.text();
    EXPECT_NE(error.text().find(fragment), std::string::npos) << error.text();
  }
}

// ---- the scene as a whole ----

TEST(SceneCheck, LetsAToolStandInTheBlanksHole) {
  const std::vector<Override> hole{{"blanks.square.mesh", "free"},
                                   {"blanks.square.element_size", "2"},
                                   {"blanks.square.holes", "[[[-3,-3],[3,-3],[3,3],[-3,3]]]"}};
  std::vector<Override> pin = hole;
  pin.push_back({"tool.0", "{name = 'pin', shape = 'cylinder', radius = 2, length = 30}"});
  base_with(pin);
  pin.back().second = "{name = 'pin', shape = 'cylinder', radius = 4, length = 30}";
  const PreparedCase wide = prepare_case(data_folder / "good/base.toml", pin);
  ASSERT_EQ(wide.errors.size(), 1u) << all_texts(wide);
  EXPECT_NE(wide.errors[0].text().find("lies inside ply"), std::string::npos);
}

TEST(SceneCheck, WarnsWhenTheStrokeLeavesLessThanTheStack) {
  // A ball of radius 7.7 in a hole of radius 8 leaves 0.3 mm, the ply is 0.5 mm thick.
  const PreparedCase reading = prepare_case(
      data_folder / "good/base.toml",
      {{"tool.0.radius", "7.7"}, {"tool.0.position.2", "9.0"}, {"tool.0.stroke", "11.0"}});
  ASSERT_TRUE(reading.value) << all_texts(reading);
  ASSERT_EQ(reading.warnings.size(), 1u);
  // The surfaces are sampled: a few thousandths of a mm more than the true distance.
  EXPECT_NE(reading.warnings[0].find("comes within 0.30"), std::string::npos)
      << reading.warnings[0];
}

TEST(SceneCheck, LetsToolsTouchThePlies) {
  base_with({{"tool.0.position.2", "5.5"}}); // ball of radius 5 on a ply whose top is at 0.5
  const PreparedCase inside =
      prepare_case(data_folder / "good/base.toml", {{"tool.0.position.2", "5.49"}});
  EXPECT_EQ(inside.errors.size(), 1u) << all_texts(inside);
}

} // namespace
} // namespace plyform::overrides_test
