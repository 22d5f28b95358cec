// SPDX-License-Identifier: GPL-3.0-or-later
// What check foresees of a run.
#include "core/run/run.hpp"
#include "core/setup/compaction_ahead.hpp"
#include "core/setup/outlook.hpp"
#include "core/setup/size_ahead.hpp"
#include "support/packing_weave.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace plyform::outlook_test {
namespace {

TEST(Outlook, ForeseesTheStepsOfDraftsWithinAThird) {
  for (const char* name : {"hemisphere_0", "hemisphere_45", "bias_extension", "picture_frame"}) {
    const PreparedCase prepared = prepare_case(std::string(PLYFORM_CASES "/") + name + "/case.toml",
                                               {{"accuracy.shear_deg", "3"}});
    ASSERT_TRUE(prepared.value) << name;
    const double foreseen = look_ahead(prepared, 1).steps;
    const auto taken =
        static_cast<double>(run_case(*prepared.value, 1, {}, prepared.meshes).summary.steps);
    EXPECT_NEAR(foreseen, taken, taken / 3.0) << name;
  }
}

TEST(Outlook, WarnsOfAMouldThatClosesOnPliesOfWhichOnlySomeGiveWay) {
  Fabric without = packing_weave();
  without.compaction.reset(), without.name = "plain";
  const auto warned = [](const std::vector<Fabric>& fabrics, double gap) {
    const Scene scene = make_scene(between_plates(fabrics, gap));
    ThreadPool pool(1);
    Lines lines;
    describe_compaction(scene, pool, lines);
    return lines;
  };
  const Lines lines = warned({packing_weave(), without}, 1.1);
  ASSERT_EQ(lines.size(), 1u);
  for (const char* part : {"    warning: ", "plies ply1, ", "on ply2, ", "give plain a compaction"})
    EXPECT_NE(lines[0].find(part), std::string::npos) << lines[0];
  EXPECT_TRUE(warned({packing_weave(), packing_weave()}, 1.1).empty());
  EXPECT_TRUE(warned({without, without}, 1.1).empty());
  EXPECT_TRUE(warned({packing_weave(), without}, 3.0).empty()); // no mould that closes
}

TEST(Outlook, TellsTheMemory) {
  const PreparedCase prepared = prepare_case(PLYFORM_CASES "/hemisphere_0/case.toml", {});
  ASSERT_TRUE(prepared.value);
  std::vector<double> done{0.0};
  const Outlook outlook = look_ahead(prepared, 1, [&](const std::string& words, double fraction) {
    EXPECT_FALSE(words.empty());
    done.push_back(fraction);
  });
  EXPECT_TRUE(std::is_sorted(done.begin(), done.end()) && done.back() > 0.9 && done.back() < 1.0);
  EXPECT_NE(outlook.lines.back().find("MB of memory"), std::string::npos) << outlook.lines.back();
  EXPECT_GT(bytes_for(*prepared.value, 480000.0), 1e9);
}

TEST(Outlook, OfMillionsOfTrianglesTellsWhatTheyTakeAndMakesNoScene) {
  const PreparedCase prepared = prepare_case(
      PLYFORM_CASES "/hemisphere_0/case.toml",
      {{"blanks.square.mesh_from", "element_size"}, {"blanks.square.element_size", "0.45"}},
      CaseSize::any);
  ASSERT_TRUE(prepared.value);
  const Outlook outlook = look_ahead(prepared, 1);
  EXPECT_NE(outlook.lines.back().find("no step of so many was tried"), std::string::npos);
  EXPECT_GT(outlook.seconds, 0.0);
  EXPECT_EQ(outlook.step, 0.0);
}

} // namespace
} // namespace plyform::outlook_test
