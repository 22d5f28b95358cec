// SPDX-License-Identifier: GPL-3.0-or-later
// Springs and grippers of a case file; what is possible and hardly meant: pulls into a ply, unusual
// springs, holders in each other. What is impossible: tests/data/broken/spring_*.toml,
// gripper_*.toml.
#include "support/case_files.hpp"

#include <gtest/gtest.h>

namespace plyform::attachment_checks_test {
namespace {

/// The warnings of a case, which has no error.
std::vector<std::string> warnings(const std::string& file, const std::vector<Override>& changes) {
  const PreparedCase reading = prepare_case(file, changes);
  for (const CaseError& error : reading.errors)
    ADD_FAILURE() << error.text();
  return reading.warnings;
}

bool any_has(const std::vector<std::string>& lines, const std::string& part) {
  return std::any_of(lines.begin(), lines.end(),
                     [&](const std::string& line) { return line.find(part) != std::string::npos; });
}

const std::string springs = std::string(PLYFORM_TEST_DATA) + "/good/springs.toml";

TEST(AttachmentChecks, ReadsSpringsAndGrippers) {
  const Case c = good_case(springs);
  ASSERT_EQ(c.boundaries.size(), 5u);
  const auto &hung = c.boundaries[0].as<TensionSpring>(),
             &slack = c.boundaries[1].as<TensionSpring>();
  const auto &cylinder = c.boundaries[2].as<Gripper>(), &pulsed = c.boundaries[3].as<Gripper>(),
             &drive = c.boundaries[4].as<Gripper>();
  EXPECT_TRUE(hung.place.on_edge);
  EXPECT_EQ(hung.anchor, Vec3(-50, 0, 5));
  EXPECT_EQ(hung.carrier, 0);
  EXPECT_EQ(hung.stiffness, 0.5);
  EXPECT_EQ(hung.preload, 4.0);
  EXPECT_FALSE(hung.natural_length);
  EXPECT_EQ(hung.max_force, 9.0);
  EXPECT_EQ(c.boundaries[1].ply, 0);
  EXPECT_EQ(slack.carrier, -1);
  EXPECT_EQ(slack.natural_length, 60.0);
  EXPECT_TRUE(std::isinf(slack.max_force));
  EXPECT_EQ(cylinder.direction, Vec3(1, 0, 0)); // given as (2, 0, 0)
  EXPECT_EQ(cylinder.force, 12.0);
  EXPECT_EQ(cylinder.stiffness, 0.0);
  EXPECT_DOUBLE_EQ(cylinder.mass, 5e-4); // t
  EXPECT_TRUE(cylinder.guided);
  EXPECT_EQ(pulsed.force, 7.0); // the largest
  EXPECT_EQ(pulsed.programme, (std::vector<Stage>{{0.5, 3.0}, {1.0, 7.0}}));
  EXPECT_EQ(drive.stiffness, 30.0);
  EXPECT_EQ(drive.stroke, 6.0);
  EXPECT_EQ(drive.programme, (std::vector<Stage>{{0.4, 6.0}, {1.0, 2.0}}));
  EXPECT_FALSE(drive.guided);
}

TEST(AttachmentChecks, NothingIsWarnedOfInAGoodCase) {
  EXPECT_TRUE(warnings(springs, {}).empty());
}

TEST(AttachmentChecks, PullsIntoThePlyAreWarnedOf) {
  EXPECT_TRUE(any_has(warnings(springs, {{"boundary.0.anchor", "[50.0, 0.0, 5.0]"}}),
                      "boundary.0 = hung: pulls into ply cloth, towards (-19.9, 0)"));
  EXPECT_TRUE(any_has(warnings(springs, {{"boundary.2.direction", "[-1.0, 0.0, 0.0]"}}),
                      "boundary.2 = cylinder: pulls into ply cloth"));
  // upwards is neither in nor out
  EXPECT_TRUE(warnings(springs, {{"boundary.2.direction", "[0.0, 0.0, 1.0]"}}).empty());
}

TEST(AttachmentChecks, StiffnessBeyondTheUsualIsWarnedOf) {
  EXPECT_TRUE(
      any_has(warnings(springs, {{"boundary.0.stiffness", "5000.0"}}), "boundary.0.stiffness"));
}

TEST(AttachmentChecks, HoldersInEachOtherAreWarnedOf) {
  const std::string box = std::string(PLYFORM_CASES) + "/square_box/case.toml";
  EXPECT_FALSE(any_has(warnings(box, {}), "overlaps tool"));
  EXPECT_FALSE(any_has(warnings(box, {{"tool.5.force", "20.0"}}), "overlaps tool"));
  EXPECT_TRUE(
      any_has(warnings(box, {{"tool.6.position", "[95.0, -35.5, 6.2]"}}), "overlaps tool holder_"));
}

} // namespace
} // namespace plyform::attachment_checks_test
