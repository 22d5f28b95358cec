// SPDX-License-Identifier: GPL-3.0-or-later
// A ply drawn into a channel forms over one extrusion as over rounded boxes in its place.
#include "core/run/run.hpp"
#include "support/scene_checks.hpp"
#include "support/thread_checks.hpp"

#include <fmt/format.h>

namespace plyform::extrusion_test {
namespace {

constexpr double gap = 40.0, fillet = 8.0, reach = 120.0; // mm

/// A rod, 30 mm across, goes 25 mm down into the channel.
Case channel_case(bool extruded) {
  Case data = stack_of({0.0}, rectangle(160.0, 60.0, 8.0));
  Tool punch;
  punch.name = "punch";
  punch.shape = Cylinder{15.0, 100.0};
  if (extruded)
    punch.shape =
        ExtrudedProfile{{{ProfileSegment::Kind::arc, {15, 0}, {15, 0}, {0, 0}, -1}}, 100.0};
  else
    punch.rotation = Eigen::AngleAxisd(M_PI / 2.0, Vec3::UnitX()).toRotationMatrix();
  punch.position = {0.0, 0.0, 15.6};
  punch.motion = Motion::driven;
  punch.stroke = 25.0;
  data.tools = {punch};
  const double wide = 100.0, half = 0.5 * gap;
  if (extruded) {
    Tool die;
    die.name = "die";
    die.shape = ExtrudedProfile{round_corners({{-half - reach, 0, 0},
                                               {-half, 0, fillet},
                                               {-half, -60, fillet},
                                               {half, -60, fillet},
                                               {half, 0, fillet},
                                               {half + reach, 0, 0}},
                                              false, {"", "", ""}),
                                wide};
    data.tools.push_back(die);
  } else {
    for (const double side : {-1.0, 1.0}) {
      Tool wall;
      wall.name = side < 0.0 ? "left" : "right";
      wall.shape = Box{{reach, wide, 60.0}, fillet};
      wall.position = {side * (half + 0.5 * reach), 0.0, -30.0};
      data.tools.push_back(wall);
    }
  }
  set_friction(data, 0.2);
  data.solver.fibre_softening = 100.0;
  data.solver.duration = 0.03;
  data.solver.mass_damping = 2000.0; // 1/s: without it free edges flutter, and 1e-9 mm become 0.1
  data.solver.outputs = 1;
  return data;
}

TEST(ExtrusionScene, ChannelFormsAsBoxesDo) {
  const EndedRun boxes = run_on_any_threads([] { return make_scene(channel_case(false)); });
  const EndedRun channel = run_on_any_threads([] { return make_scene(channel_case(true)); });
  for (const EndedRun* run : {&boxes, &channel})
    ASSERT_TRUE(ended(run->result.summary.status)) << run->result.summary.message;
  const std::vector<Vec3>& a = boxes.result.last.plies[0].x;
  const std::vector<Vec3>& b = channel.result.last.plies[0].x;
  ASSERT_EQ(a.size(), b.size());
  double most = 0.0, lowest = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n) {
    most = std::max(most, (a[n] - b[n]).norm());
    lowest = std::min(lowest, a[n].z());
  }
  fmt::print("largest difference {:.2g} mm\n", most);
  EXPECT_LT(lowest, -23.0);
  EXPECT_LT(most, 1e-6); // rounding
}

} // namespace
} // namespace plyform::extrusion_test
