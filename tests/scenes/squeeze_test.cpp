// SPDX-License-Identifier: GPL-3.0-or-later
// Plies between a driven tool and a fixed one that leave them too little room: contact does not
// give way, and the run says who is squeezed.
#include "core/run/run.hpp"
#include "core/solver/scene.hpp"
#include "support/scene_checks.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace plyform::squeeze_test {
namespace {

/// `plies` on a floor, under a box that comes down by `stroke` (mm) from where it touches.
Case under_a_press(int plies, double stroke) {
  Case data = stack_of(std::vector<double>(static_cast<std::size_t>(plies), 0.0),
                       rectangle(60.0, 60.0, 10.0));
  const double top = glass_weave().thickness * plies;
  Tool floor;
  floor.name = "floor";
  floor.shape = Box{{200.0, 200.0, 10.0}};
  floor.position = {0.0, 0.0, -5.0};
  Tool press;
  press.name = "press";
  press.shape = Box{{200.0, 200.0, 10.0}};
  press.position = {0.0, 0.0, top + 5.0};
  press.motion = Motion::driven;
  press.stroke = stroke;
  data.tools = {floor, press};
  set_friction(data, 0.2);
  data.solver.duration = 0.01;
  data.solver.fibre_softening = 100.0;
  return data;
}

TEST(SqueezeScene, RoomThatContactHasIsUsedAndNoMore) {
  // a tenth of a millimetre into each tool, 0.15 mm between plies: 0.2 and 0.35 mm at the very most
  for (const auto& [plies, stroke] : {std::pair(1, 0.15), std::pair(2, 0.25)}) {
    const Summary told = run_case(under_a_press(plies, stroke), 1, {}).summary;
    EXPECT_TRUE(ended(told.status)) << told.message;
    EXPECT_LT(told.contact.max_tool_penetration_mm, 0.1);
    EXPECT_LT(told.contact.max_ply_penetration_mm, 0.15);
  }
}

TEST(SqueezeScene, TooLittleRoomIsNamed) {
  for (const auto& [plies, stroke] : {std::pair(1, 0.4), std::pair(2, 0.6)}) {
    const Summary told = run_case(under_a_press(plies, stroke), 1, {}).summary;
    fmt::print("{} steps: {}\n", told.steps, told.message);
    EXPECT_EQ(told.status, "stopped");
    for (const char* name : {"ply ply", "node ", "more room"})
      EXPECT_NE(told.message.find(name), std::string::npos) << told.message;
    EXPECT_EQ(told.contact.intersections_between_plies, 0);
    EXPECT_LT(told.contact.max_tool_penetration_mm, 0.1); // the last good state
    EXPECT_LT(told.contact.max_ply_penetration_mm, 0.15);
  }
}

/// Where two tools with prescribed places press the plies, the force is that of contact.
TEST(SqueezeScene, ForcesOfClosedToolsAreNotKnown) {
  for (const auto& [plies, stroke] : {std::pair(1, 0.05), std::pair(3, 0.12)}) {
    const RunResult run = run_case(under_a_press(plies, stroke), 1, {});
    fmt::print("{} plies: {:.1f} N, {}\n", plies, run.last.tools[1].force_N, run.summary.message);
    EXPECT_EQ(run.summary.status, "doubtful");
    EXPECT_NE(run.summary.message.find("do not trust the force of floor, press after"),
              std::string::npos);
    ASSERT_EQ(run.summary.known_forces.size(), 2u);
    for (const KnownForce& known : run.summary.known_forces) {
      EXPECT_FALSE(known.to_end());
      EXPECT_LT(known.stroke_mm, 0.5 * stroke);
    }
  }
}

/// Not where there is room, nor where one of them is pushed by a force, which the plies pass on.
TEST(SqueezeScene, ForcesOfAGivenForceAndOfOpenToolsAreKnown) {
  Case open = under_a_press(2, 1.0);
  open.tools[1].position.z() += 1.2;
  Case clamp = under_a_press(2, 0.0);
  clamp.tools[1].motion = Motion::force, clamp.tools[1].force = 50.0;
  Case formed = coarse_hemisphere({0.0, 0.5});
  formed.solver.duration = 0.03;
  for (const Case& data : {open, clamp, formed}) {
    const Summary told = run_case(data, 1, {}).summary;
    EXPECT_TRUE(ended(told.status)) << told.message;
    EXPECT_EQ(told.message.find("do not trust the force of"), std::string::npos) << told.message;
    for (const KnownForce& known : told.known_forces)
      EXPECT_TRUE(known.to_end());
  }
}

} // namespace
} // namespace plyform::squeeze_test
