// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/keys/given_values.hpp"

#include <fstream>
#include <gtest/gtest.h>

namespace plyform {
namespace {

using Values = std::vector<std::pair<std::string, std::string>>;

Values of(const std::string& text, const std::filesystem::path& file = "case.toml") {
  Diagnostics diagnostics;
  const std::optional<TomlNode> root = parse_entries(text, file.string(), diagnostics);
  return root ? given_values(*root, file.parent_path()) : Values{};
}

TEST(GivenValues, KeysAreDottedWithNamesOfItems) {
  const Values values = of("title = \"a\"\n[solver]\nduration = 0.1\naveraged = true\n"
                           "[[ply]]\nname = \"low\"\nangle = 45\n[[ply]]\nangle = -0.25\n");
  const Values expected = {
      {"title", "a"},          {"solver.duration", "0.1"}, {"solver.averaged", "true"},
      {"ply.low.name", "low"}, {"ply.low.angle", "45"},    {"ply.1.angle", "-0.25"}};
  EXPECT_EQ(values, expected);
}

TEST(GivenValues, AnItemWhoseNameIsNotItsAloneGoesByNumber) {
  const Values values = of("[[ply]]\nname = \"p\"\n[[ply]]\nname = \"p\"\n");
  const Values expected = {{"ply.0.name", "p"}, {"ply.1.name", "p"}};
  EXPECT_EQ(values, expected);
}

TEST(GivenValues, ListsAreOneValueAndLongOnesStillTellThemselvesApart) {
  std::string points = "points = [[0, 0.5], [1, 2]";
  for (int i = 0; i < 100; ++i)
    points += ", [" + std::to_string(i) + ", 1]";
  const Values shorter = of("points = [[0, 0.5], {x = 1}]\n");
  EXPECT_EQ(shorter, (Values{{"points", "[[0, 0.5], {x = 1}]"}}));
  const Values one = of(points + ", [7, 1]]\n"), other = of(points + ", [7, 2]]\n");
  ASSERT_EQ(one.size(), 1u);
  EXPECT_LT(one[0].second.size(), 200u);
  EXPECT_NE(one, other);
}

TEST(GivenValues, AFileIsToldWithItsContent) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / "plyform_given_values";
  std::filesystem::create_directories(folder);
  const auto write = [&](const std::string& content) {
    std::ofstream(folder / "part.stl") << content;
    return of("file = \"part.stl\"\nother = \"none.stl\"\n", folder / "case.toml");
  };
  const Values before = write("one"), after = write("two");
  std::filesystem::remove_all(folder);
  ASSERT_EQ(before.size(), 2u);
  EXPECT_EQ(before[0].second.rfind("part.stl (3 bytes, ", 0), 0u) << before[0].second;
  EXPECT_NE(before[0], after[0]);
  EXPECT_EQ(before[1], (Values::value_type{"other", "none.stl"}));
}

} // namespace
} // namespace plyform
