// SPDX-License-Identifier: GPL-3.0-or-later
// Planes of symmetry that a scene has, and what breaks those that it nearly has.
#include "core/setup/prepare_case.hpp"
#include "core/setup/symmetry_ahead.hpp"
#include "support/case_files.hpp"

#include <gtest/gtest.h>

namespace plyform::symmetry_ahead_test {
namespace {

std::vector<PlaneAhead> planes_of(const std::string& name, const std::vector<Override>& overrides) {
  const PreparedCase prepared =
      prepare_case(std::string(PLYFORM_CASES "/") + name + "/case.toml", overrides);
  EXPECT_TRUE(prepared.value) << all_texts(prepared);
  if (!prepared.value) return {};
  return symmetry_planes(*prepared.value, prepared.meshes);
}

std::vector<std::string> holding(const std::vector<PlaneAhead>& planes) {
  std::vector<std::string> names;
  for (const PlaneAhead& ahead : planes)
    if (ahead.broken.empty() && ahead.assumed.empty()) names.push_back(ahead.name);
  return names;
}

/// Whether that plane is broken by one thing, which these words tell.
testing::AssertionResult broken_by(const std::vector<PlaneAhead>& planes, const std::string& name,
                                   const std::string& words) {
  for (const PlaneAhead& ahead : planes) {
    if (ahead.name != name) continue;
    if (ahead.broken.size() == 1 && ahead.broken[0].find(words) != std::string::npos)
      return testing::AssertionSuccess();
    auto wrong = testing::AssertionFailure() << ahead.broken.size() << " break it:";
    for (const std::string& what : ahead.broken)
      wrong << "\n  " << what;
    return wrong;
  }
  return testing::AssertionFailure() << "no plane " << name;
}

TEST(SymmetryAhead, FindsThePlanesOfShippedCases) {
  const std::vector<std::string> quarter = {"x = 0", "y = 0"};
  EXPECT_EQ(holding(planes_of("hemisphere_0", {})), quarter);
  EXPECT_EQ(holding(planes_of("pocket", {})), quarter);
  EXPECT_EQ(holding(planes_of("hemisphere_ncf", {})), quarter);
  EXPECT_EQ(holding(planes_of("circular_table", {})), quarter);
  EXPECT_TRUE(holding(planes_of("square_box", {})).empty()); // plies at 30 degrees
  EXPECT_TRUE(planes_of("two_ply_hemisphere", {}).empty());  // a quarter is modelled already
}

TEST(SymmetryAhead, OffersFamiliesThatDifferByLittleAsAnAssumption) {
  const std::vector<PlaneAhead> planes = planes_of("hemisphere_five_ply", {});
  EXPECT_EQ(planes.size(), 4u);
  for (const PlaneAhead& ahead : planes) {
    EXPECT_TRUE(ahead.broken.empty()) << ahead.name << ahead.broken.front();
    ASSERT_EQ(ahead.assumed.size(), 1u) << ahead.name;
    EXPECT_NE(ahead.assumed[0].find("differ by 4.2 %"), std::string::npos) << ahead.assumed[0];
  }
  EXPECT_EQ(holding(planes_of("hemisphere_five_ply", {{"fabrics.glass.weft.stiffness", "46000.0"}}))
                .size(),
            4u);
  const std::vector<PlaneAhead> apart =
      planes_of("hemisphere_0", {{"fabrics.glass.weft.stiffness", "60000.0"}});
  EXPECT_TRUE(broken_by(apart, "y = x", "they differ"));
  EXPECT_EQ(holding(apart), (std::vector<std::string>{"x = 0", "y = 0"}));
}

TEST(SymmetryAhead, TellsWhatBreaksScenesThatAreNearlySymmetric) {
  const std::string one = "hemisphere_0";
  EXPECT_TRUE(
      broken_by(planes_of(one, {{"ply.0.angle", "0.5"}}), "x = 0", "fibres in other directions"));
  const std::vector<PlaneAhead> seed = planes_of(one, {{"ply.0.seed", "[1.0, 0.0]"}});
  EXPECT_TRUE(broken_by(seed, "x = 0", "the blank of ply ply: its mirror image is 2 mm off"));
  EXPECT_EQ(holding(seed), std::vector<std::string>{"y = 0"});
  const std::vector<PlaneAhead> punch = planes_of(one, {{"tool.0.position", "[0.0, 0.05, 75.6]"}});
  EXPECT_TRUE(broken_by(punch, "y = 0", "tool punch: its mirror image is 0.1 mm off"));
  EXPECT_EQ(holding(punch), std::vector<std::string>{"x = 0"});
  EXPECT_TRUE(broken_by(planes_of(one, {{"tool.0.direction", "[0.01, 0.0, -1.0]"}}), "x = 0",
                        "the motion of tool punch"));
  EXPECT_TRUE(
      broken_by(planes_of(one, {{"gravity", "[100.0, 0.0, -9810.0]"}}), "x = 0", "gravity"));
  EXPECT_TRUE(broken_by(planes_of("hemisphere_ncf", {{"ply.0.angle", "0.5"}}), "y = 0", "has the"));
  // springs of which one gives way, grippers of which one has another programme
  const std::string drawn = "springs_and_grippers";
  const auto broken = [&](const std::vector<Override>& overrides) {
    for (const PlaneAhead& ahead : planes_of(drawn, overrides))
      if (ahead.name == "y = 0") return ahead.broken;
    return std::vector<std::string>{"no such plane"};
  };
  EXPECT_EQ(broken({}),
            (std::vector<std::string>{"boundary spring_south", "boundary spring_north"}));
  EXPECT_TRUE(broken({{"boundary.0.max_force", "12.0"}}).empty());
  EXPECT_EQ(broken({{"boundary.0.max_force", "12.0"},
                    {"boundary.3.stroke_programme", "[[0.5, 15.0], [0.8, 15.0], [1.0, 20.0]]"}}),
            (std::vector<std::string>{"boundary gripper_south", "boundary gripper_north"}));
}

TEST(SymmetryAhead, TakesALawOfOneSignForItsOwnImageOnlyWhereFamiliesExchange) {
  const std::vector<PlaneAhead> planes =
      planes_of("hemisphere_0", {{"fabrics.glass.shear.negative_polynomial", "[0.2, 0.4, 0.5]"},
                                 {"fabrics.glass.weft.stiffness", "46000.0"}});
  EXPECT_TRUE(broken_by(planes, "x = 0", "shears the other way"));
  EXPECT_EQ(holding(planes), (std::vector<std::string>{"y = x", "y = -x"}));
}

} // namespace
} // namespace plyform::symmetry_ahead_test
