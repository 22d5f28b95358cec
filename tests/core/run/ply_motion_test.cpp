// SPDX-License-Identifier: GPL-3.0-or-later
// Plies that fly, plies that have left the scene, and energies that are rounding errors.
#include "core/run/ply_motion.hpp"
#include "core/run/run.hpp"
#include "core/setup/prepare_case.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace plyform::ply_motion_test {
namespace {

RunResult run_of(const std::string& file, const std::vector<Override>& overrides = {}) {
  const PreparedCase prepared = prepare_case(file, overrides);
  EXPECT_TRUE(prepared.value) << file;
  return run_case(prepared.value.value(), 1, {}, prepared.meshes);
}

TEST(PlyMotion, AStrokeSoFastThatThePlyFliesIsDoubtfulAndNotPredicted) {
  const std::string hemisphere = PLYFORM_CASES "/hemisphere_0/case.toml";
  const Summary fast = run_of(hemisphere, {{"solver.duration", "0.0125"}}).summary;
  EXPECT_GT(fast.motion_share, flying);
  EXPECT_EQ(fast.status, "doubtful");
  EXPECT_NE(fast.message.find("flies at the end"), std::string::npos) << fast.message;
  EXPECT_TRUE(std::isnan(fast.accuracy.inertia_deg));
  EXPECT_TRUE(std::isnan(fast.accuracy.promised_deg));
  EXPECT_NE(fast.accuracy.unknown, "");
  const Summary slow = run_of(hemisphere, {{"solver.duration", "0.035"}}).summary;
  EXPECT_LT(slow.motion_share, flying);
  EXPECT_EQ(slow.message.find("flies"), std::string::npos) << slow.message;
  EXPECT_FALSE(std::isnan(slow.accuracy.promised_deg));
}

TEST(PlyMotion, APlyThatIsThrownOutOfTheSceneIsDoubtful) {
  const RunResult run = run_of(PLYFORM_TEST_DATA "/motion/thrown_ply.toml");
  EXPECT_EQ(run.summary.status, "doubtful");
  const std::string& said = run.summary.message;
  EXPECT_NE(said.find("do not trust ply p0: at the end all of it lies"), std::string::npos) << said;
  EXPECT_NE(said.find("do not trust the way of front"), std::string::npos) << said;
  EXPECT_NE(said.find("p0 flies"), std::string::npos) << said;
}

TEST(PlyMotion, NothingThatHappensIsNotDoubtful) {
  const RunResult run = run_of(PLYFORM_TEST_DATA "/motion/nothing_happens.toml");
  EXPECT_EQ(run.summary.status, "done") << run.summary.message;
  EXPECT_LT(std::abs(run.last.energy.balance_error()), 1e-6);
  EXPECT_LT(run.last.energy.kinetic_over_shear(), 1e-6);
  EXPECT_GT(run.last.energy.floor, 0.0);
  for (const std::string& what : run.summary.work.missing)
    ADD_FAILURE() << what;
}

} // namespace
} // namespace plyform::ply_motion_test
