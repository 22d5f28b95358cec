// SPDX-License-Identifier: GPL-3.0-or-later
// What check foresees of a run.
#include "core/run/run.hpp"
#include "core/setup/outlook.hpp"
#include "core/setup/size_ahead.hpp"

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
  EXPECT_GT(bytes_for(480000.0), 1e9);
}

} // namespace
} // namespace plyform::outlook_test
