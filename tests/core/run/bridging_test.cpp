// SPDX-License-Identifier: GPL-3.0-or-later
// Where plies span hollows of tools, on shapes that are given: what presses them, what is a hollow,
// what is a wrinkle. Weave 0.6 mm thick.
#include "core/results/bridging.hpp"
#include "core/results/wrinkles.hpp"
#include "core/run/bridging.hpp"
#include "core/run/output_state.hpp"
#include "support/scene_checks.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <numbers>

namespace plyform::bridging_test {
namespace {

constexpr double t = 0.6; // mm

/// A die with a groove along y, 40 mm wide and 10 mm deep, whose flanks slope by 45 degrees.
Tool grooved_die() {
  Tool die;
  die.name = "die";
  die.shape = ExtrudedProfile{
      round_corners(
          {{-200, 0, 0}, {-20, 0, 0}, {-10, -10, 0}, {10, -10, 0}, {20, 0, 0}, {200, 0, 0}}, false,
          {"", "", ""}),
      300.0};
  return die;
}

Tool floor_plate() {
  Tool floor;
  floor.name = "floor";
  floor.shape = Plane{};
  return floor;
}

/// Plies of 120 mm on z = 0, with elements of a size, that these pressures (N/mm^2, upwards) act
/// on.
Scene scene_of(std::size_t plies, const Tool& tool, const std::vector<double>& pressures,
               double size = 4.0) {
  Case data = stack_of(std::vector<double>(plies, 0.0), rectangle(120.0, 120.0, size));
  data.tools = {tool};
  for (std::size_t p = 0; p < pressures.size(); ++p)
    if (pressures[p] != 0.0)
      data.loads.push_back({static_cast<int>(p),
                            pressures[p] > 0.0 ? PlyFace::below : PlyFace::above,
                            std::abs(pressures[p]),
                            {}});
  set_friction(data, 0.0);
  Scene s = make_scene(data);
  s.time = data.solver.duration; // pressures have risen
  return s;
}

void shape(PlyBody& ply, const std::function<double(const Vec2&)>& height) {
  for (Vec3& x : ply.x)
    x.z() = height(x.head<2>());
}

std::vector<PlyFrame> plies_of(const Scene& s) {
  ThreadPool pool(1);
  return make_frame(s, tool_surfaces(s, pool), {}, pool).plies;
}

TEST(Bridging, AFlatPlyPressedOverAGrooveHasItsHeightAndArea) {
  const std::vector<PlyFrame> plies = plies_of(scene_of(1, grooved_die(), {-0.1}));
  const Bridging found = bridging_of(plies[0]);
  fmt::print("height {:.3f} mm of 10, area {:.0f} mm2 of 4800\n", found.height, found.area);
  EXPECT_NEAR(found.height, 10.0, 1e-9);
  EXPECT_LE(std::abs(found.at.x()), 10.0);
  // From where the flank's normal has 0.3 mm on: 0.42 mm behind the edge.
  EXPECT_NEAR(found.area, 120.0 * 40.0, 0.05 * 120.0 * 40.0);
  EXPECT_LT(wrinkles_of(plies[0], {}).highest.height, 1e-9);
}

TEST(Bridging, WhatNothingPressesBridgesNothing) {
  EXPECT_EQ(bridging_of(plies_of(scene_of(1, grooved_die(), {0.1}))[0]).height, 0.0); // upwards
  for (const PlyFrame& ply : plies_of(scene_of(1, grooved_die(), {})))
    EXPECT_TRUE(ply.bridging_height.empty());
  // A vacuum between the outermost of three: each is pressed onto the middle one, all to no side.
  for (const PlyFrame& ply : plies_of(scene_of(3, grooved_die(), {0.1, 0.0, -0.1})))
    EXPECT_EQ(bridging_of(ply).height, 0.0);
  // The same with one of them stretched.
  Scene vacuum = scene_of(3, grooved_die(), {0.1, 0.0, -0.1});
  shape(vacuum.plies[2], [](const Vec2& p) { return 2.0 + 0.5 * std::abs(p.y()); });
  for (const PlyFrame& ply : plies_of(vacuum))
    EXPECT_EQ(bridging_of(ply).height, 0.0);
  // A sheet that has not come to the tool spans nothing.
  Scene s = scene_of(1, grooved_die(), {-0.1});
  shape(s.plies[0], [](const Vec2&) { return 3.0; });
  EXPECT_EQ(bridging_of(plies_of(s)[0]).height, 0.0);
}

TEST(Bridging, EachPlyOfAStackHasTheHeightLessThePliesBelow) {
  for (const PlyFrame& ply : plies_of(scene_of(3, grooved_die(), {0.05, 0.0, -0.1}))) {
    const Bridging found = bridging_of(ply);
    EXPECT_NEAR(found.height, 10.0, 1e-9) << ply.name;
    EXPECT_NEAR(found.area, 120.0 * 40.0, 0.1 * 120.0 * 40.0) << ply.name;
  }
  // The lowest is drawn in: the others span what it leaves.
  Scene s = scene_of(3, grooved_die(), {0.0, 0.0, -0.1});
  shape(s.plies[0],
        [](const Vec2& p) { return 0.5 * t - std::clamp(20.0 - std::abs(p.x()), 0.0, 10.0); });
  const std::vector<PlyFrame> plies = plies_of(s);
  EXPECT_EQ(bridging_of(plies[0]).height, 0.0);
  EXPECT_NEAR(bridging_of(plies[2]).height, 10.0, 1e-9);
}

/// A wave of its own on a flat tool is a wrinkle, whatever presses it down.
TEST(Bridging, AWavePressedOntoAFlatToolIsAWrinkle) {
  Scene s = scene_of(1, floor_plate(), {-0.1});
  shape(s.plies[0], [](const Vec2& p) {
    const double u = std::min(std::abs(p.x()), 12.0);
    return 0.5 * t + 1.5 * (1.0 + std::cos(std::numbers::pi * u / 12.0));
  });
  const PlyFrame ply = plies_of(s)[0];
  EXPECT_EQ(bridging_of(ply).height, 0.0);
  EXPECT_GT(wrinkles_of(ply, {&s.tools[0].body}).highest.height, 2.5);
}

/// A ply sucked into a slot, deeper than wrinkles look for the tool, is bridging alone.
TEST(Bridging, APlyDrawnIntoASlotIsNoWrinkle) {
  Tool die = grooved_die();
  die.shape = ExtrudedProfile{
      round_corners(
          {{-200, 0, 0}, {-12, 0, 4}, {-12, -90, 0}, {12, -90, 0}, {12, 0, 4}, {200, 0, 0}}, false,
          {"", "", ""}),
      300.0};
  Scene s = scene_of(1, die, {-0.1}, 2.0);
  // Over the edges, from which it leaves at 30 degrees, in an arc.
  const double leave = 30.0 * degree, round = 4.0 + 0.5 * t, from = 16.0 - round * std::sin(leave),
               radius = from / std::sin(leave);
  shape(s.plies[0], [&](const Vec2& p) {
    const double u = std::abs(p.x());
    if (u > from) return -4.0 + std::sqrt(round * round - std::pow(std::max(16.0 - u, 0.0), 2));
    return -4.0 + round * std::cos(leave) + radius * std::cos(leave) -
           std::sqrt(radius * radius - u * u);
  });
  PlyFrame ply = plies_of(s)[0];
  const double pressed = wrinkles_of(ply, {&s.tools[0].body}).highest.height;
  ply.pushed.clear();
  const double alone = wrinkles_of(ply, {&s.tools[0].body}).highest.height;
  fmt::print("wrinkles {:.2f} mm pressed, {:.2f} mm not; bridging {:.2f} mm\n", pressed, alone,
             bridging_of(ply).height);
  EXPECT_LT(pressed, 0.3);
  EXPECT_GT(alone, 2.0);
  EXPECT_GT(bridging_of(ply).height, 5.0);
}

/// A punch over the groove presses once the mould is closed, not before.
TEST(Bridging, OfAMouldThatIsClosed) {
  for (const double open : {0.0, 5.0}) {
    Case data = stack_of({0.0}, rectangle(120.0, 120.0, 4.0));
    Tool punch;
    punch.name = "punch";
    punch.shape = Box{{140.0, 140.0, 20.0}, 0.0};
    punch.position = {0.0, 0.0, 10.0 + t + 5.0};
    punch.motion = Motion::driven;
    punch.stroke = 5.0;
    data.tools = {grooved_die(), punch};
    set_friction(data, 0.0);
    Scene s = make_scene(data);
    s.tools[1].body.displacement.z() = open - 5.0;
    const PlyFrame ply = plies_of(s)[0];
    ASSERT_FALSE(ply.bridging_height.empty());
    EXPECT_NEAR(bridging_of(ply).height, open > 0.0 ? 0.0 : 10.0, 1e-9);
    // A punch that stops before the mould is closed never presses.
    data.tools[1].stroke = 2.0;
    EXPECT_TRUE(plies_of(make_scene(data))[0].bridging_height.empty());
  }
}

/// Over the middle of a hollow the height has a ridge, and nodes need not lie on it: elements of
/// 7.5 mm over the groove's bottom corner, where flanks of 45 degrees meet 20 mm down.
TEST(Bridging, IsHighestBetweenNodes) {
  Tool die = grooved_die();
  die.shape = ExtrudedProfile{
      round_corners({{-200, 0, 0}, {-20, 0, 0}, {0, -20, 0}, {20, 0, 0}, {200, 0, 0}}, false,
                    {"", "", ""}),
      300.0};
  for (const double size : {120.0 / 15.0, 120.0 / 17.0}) {
    const Bridging found = bridging_of(plies_of(scene_of(1, die, {-0.1}, size))[0]);
    const double theory = (20.0 + 0.5 * t) * std::sqrt(0.5) - 0.5 * t;
    fmt::print("elements of {:.3f} mm: height {:.4f} mm of {:.4f}\n", size, found.height, theory);
    EXPECT_NEAR(found.height, theory, 1e-3 * theory);
  }
}

/// Of two plies as large as each other in a closed mould one ends 0.03 mm before the other: what
/// lies over its border is held up by it all the same.
TEST(Bridging, NothingBridgesAtTheBorderOfAPlyOfTheSameSize) {
  Case data = stack_of({0.0, 0.0}, rectangle(120.0, 120.0, 4.0));
  Tool punch;
  punch.name = "punch";
  punch.shape = Box{{140.0, 140.0, 20.0}, 0.0};
  punch.position = {0.0, 0.0, 10.0 + 2.0 * t + 5.0};
  punch.motion = Motion::driven;
  punch.stroke = 5.0;
  data.tools = {floor_plate(), punch};
  set_friction(data, 0.0);
  Scene s = make_scene(data);
  s.tools[1].body.displacement.z() = -5.0;
  for (const std::size_t shorter : {std::size_t{0}, std::size_t{1}}) {
    Scene& now = s;
    for (std::size_t p = 0; p < 2; ++p)
      for (std::size_t n = 0; n < now.plies[p].x.size(); ++n) {
        const double share = p == shorter ? 1.0 - 0.03 / 60.0 : 1.0;
        now.plies[p].x[n].head<2>() = share * now.plies[p].x0[n].head<2>();
      }
    for (const PlyFrame& ply : plies_of(now)) {
      ASSERT_FALSE(ply.bridging_height.empty());
      EXPECT_EQ(bridging_of(ply).height, 0.0) << ply.name;
    }
  }
  // What is really open is found: the lower one ends 20 mm before.
  for (std::size_t n = 0; n < s.plies[0].x.size(); ++n)
    s.plies[0].x[n].head<2>() = 2.0 / 3.0 * s.plies[0].x0[n].head<2>();
  EXPECT_NEAR(bridging_of(plies_of(s)[1]).height, t, 1e-9);
}

} // namespace
} // namespace plyform::bridging_test
