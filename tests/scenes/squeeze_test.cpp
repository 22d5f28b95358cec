// SPDX-License-Identifier: GPL-3.0-or-later
// Plies between a driven tool and a fixed one that leave them too little room: contact does not
// give way, and the run says who is squeezed.
#include "core/solver/run.hpp"
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

} // namespace
} // namespace plyform::squeeze_test
