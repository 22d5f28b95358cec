// SPDX-License-Identifier: GPL-3.0-or-later
// The first answer: plies of a stack alone between the tools.
#include "core/setup/instant.hpp"
#include "core/setup/run_prepared.hpp"
#include "support/case_files.hpp"

#include <gtest/gtest.h>

namespace plyform::instant_test {
namespace {

PreparedCase shipped(const std::string& name, std::vector<Override> overrides = {}) {
  overrides.emplace_back("accuracy.instant", "true");
  PreparedCase prepared =
      prepare_case(std::string(PLYFORM_CASES "/") + name + "/case.toml", overrides);
  return prepared;
}

std::vector<std::vector<std::size_t>> groups_of(const std::vector<PlyAlone>& alone) {
  std::vector<std::vector<std::size_t>> groups;
  for (const PlyAlone& one : alone) {
    groups.push_back(one.plies);
    std::sort(groups.back().begin(), groups.back().end());
  }
  return groups;
}

TEST(Instant, FormsPliesThatAreAlikeOnceEachInTheRoomThatTheOthersLeave) {
  const PreparedCase prepared = shipped("hemisphere_five_ply");
  ASSERT_TRUE(prepared.value) << all_texts(prepared);
  const std::vector<PlyAlone> alone = plies_alone(prepared);
  const std::vector<std::vector<std::size_t>> expected = {{0, 2, 4}, {1, 3}};
  EXPECT_EQ(groups_of(alone), expected);
  ASSERT_EQ(alone[0].plies.front(), 2u); // the one in the middle
  const Case& middle = *alone[0].prepared.value;
  ASSERT_EQ(middle.plies.size(), 1u);
  EXPECT_EQ(middle.part_at.size(), 2u); // a quarter, with families taken as one
  ASSERT_EQ(middle.tool_clearance.size(), 3u);
  for (const double room : middle.tool_clearance) // two plies of 0.6 mm on either side
    EXPECT_NEAR(room, 1.2, 1e-12);
  EXPECT_NEAR(middle.tools[2].force, 300.0 / 5.0 / 4.0, 1e-9); // of a quarter
  const std::vector<PlyAlone> moved =
      plies_alone(shipped("hemisphere_five_ply", {{"ply.2.seed", "[1.0, 0.0]"}}));
  EXPECT_EQ(moved.size(), 3u);
}

TEST(Instant, KnowsOnWhichSideOfAPlyAToolIs) {
  const std::vector<PlyAlone> alone = plies_alone(shipped("hemisphere_two_ply"));
  ASSERT_EQ(alone.size(), 2u);
  // punch, die, holder: of the lower ply and of the upper
  const std::vector<double> lower = alone[0].prepared.value->tool_clearance,
                            upper = alone[1].prepared.value->tool_clearance;
  ASSERT_EQ(lower.size(), 3u);
  EXPECT_NEAR(lower[0], 0.6, 1e-12);
  EXPECT_NEAR(lower[1], 0.0, 1e-12);
  EXPECT_NEAR(lower[2], 0.6, 1e-12);
  EXPECT_NEAR(upper[0], 0.0, 1e-12);
  EXPECT_NEAR(upper[1], 0.6, 1e-12);
  EXPECT_NEAR(upper[2], 0.0, 1e-12);
}

TEST(Instant, GivesAllPliesOfAStackWithItsDrawIn) {
  const PreparedCase prepared = shipped("hemisphere_five_ply");
  RunHooks hooks;
  std::size_t frames = 0;
  hooks.frame = [&](const Frame& frame) {
    ++frames;
    EXPECT_EQ(frame.plies.size(), 5u);
  };
  const RunResult result = run_prepared(prepared, 2, hooks);
  EXPECT_EQ(result.summary.status, "instant") << result.summary.message;
  EXPECT_EQ(frames, 6u);
  ASSERT_EQ(result.last.plies.size(), 5u);
  for (std::size_t p = 0; p < 5; ++p) {
    const PlyFrame& ply = result.last.plies[p];
    EXPECT_EQ(ply.name, "ply" + std::to_string(p + 1));
    EXPECT_NEAR(ply.x0.front().z(), prepared.value->plies[p].z, 1e-12);
    // standard: 21.5 to 22.1 mm, largest shear 44 to 47 degrees
    EXPECT_NEAR(result.summary.plies[p].draw_in.mean(), 21.8, 2.0);
    double largest = 0.0;
    for (const double shear : ply.shear_deg)
      largest = std::max(largest, std::abs(shear));
    EXPECT_NEAR(largest, 44.0, 6.0);
  }
  for (const KnownForce& known : result.summary.known_forces)
    EXPECT_FALSE(known.to_end());
}

TEST(Instant, RefusesWhatActsOnAStackOnly) {
  const PreparedCase pressed =
      prepare_case(data_folder / "good" / "loads.toml", {{"accuracy.instant", "true"}});
  EXPECT_FALSE(pressed.value);
  EXPECT_NE(all_texts(pressed).find("forms each ply alone, which says nothing of this case"),
            std::string::npos)
      << all_texts(pressed);
}

} // namespace
} // namespace plyform::instant_test
