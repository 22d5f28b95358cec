// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/setup/key_value.hpp"

#include <gtest/gtest.h>

namespace plyform::key_value_test {
namespace {

const std::filesystem::path hemisphere = PLYFORM_CASES "/hemisphere_0/case.toml";

std::optional<TomlNode> value_of(const std::string& key, const std::vector<Override>& overrides) {
  Diagnostics unknown;
  const auto value = value_of_key(hemisphere, overrides, key, unknown);
  EXPECT_TRUE(unknown.errors.empty()) << unknown.errors.front().text();
  return value;
}

double number_of(const std::string& key, const std::vector<Override>& overrides = {}) {
  return value_of(key, overrides).value().number;
}

TEST(KeyValue, IsOfTheFileOfItsFabricAnOverrideOrTheDefault) {
  EXPECT_EQ(number_of("tool.1.points.1.2"), 10.0);
  EXPECT_EQ(number_of("fabrics.glass.weft.stiffness"), 48000.0);
  EXPECT_EQ(number_of("ply.0.angle", {{"ply.0.angle", "30"}}), 30.0); // degrees, as in the file
  EXPECT_EQ(number_of("stack.bottom"), 0.0);
  EXPECT_EQ(value_of("contact.self", {})->text, "auto");
  EXPECT_FALSE(value_of("fabrics.glass.warp.buckling_force", {}));
}

TEST(KeyValue, IsThatOfACaseWithMistakesToo) {
  EXPECT_EQ(number_of("contact.friction", {{"contact.friction", "-1"}}), -1.0);
  Diagnostics unknown;
  EXPECT_FALSE(value_of_key("none.toml", {}, "contact.friction", unknown));
  EXPECT_TRUE(unknown.errors.empty());
}

TEST(KeyValue, OfACostParameterIsPickedForTheAccuracyAskedFor) {
  const std::vector<Override> overrides{{"accuracy.shear_deg", "3.0"}, {"solver.duration", "0.05"}};
  const PickedCase picked = pick_case(hemisphere, overrides);
  EXPECT_EQ(number_of("solver.duration", overrides), 0.05);
  EXPECT_EQ(number_of("solver.fibre_softening", overrides),
            picked.reading.value->solver.fibre_softening);
  EXPECT_EQ(number_of("blanks.square.element_size", overrides),
            picked.reading.value->blanks[0].element_size);
  EXPECT_NE(number_of("solver.fibre_softening", overrides), number_of("solver.fibre_softening"));
}

TEST(KeyValue, ReportsKeysAndItemsThatDoNotExist) {
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"solver.durration", "did you mean duration?"},
      {"tool.3.name", "its items are numbered from 0 to 2"},
      {"tool.x.name", "its items are numbered from 0 to 2"},
      {"contact.friction.0", "ask for contact.friction itself"},
      {"", "it has"}};
  for (const auto& [key, remedy] : wrong) {
    Diagnostics unknown;
    EXPECT_FALSE(value_of_key(hemisphere, {}, key, unknown)) << key;
    ASSERT_EQ(unknown.errors.size(), 1u) << key;
    EXPECT_NE(unknown.errors[0].remedy.find(remedy), std::string::npos) << unknown.errors[0].text();
  }
}

} // namespace
} // namespace plyform::key_value_test
