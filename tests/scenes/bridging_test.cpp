// SPDX-License-Identifier: GPL-3.0-or-later
// A strip that a pressure p draws into a V-shaped groove against a tension T per width, without
// friction: an arc of radius T/p between the flanks, which meet at 2 alpha. Its height over them,
// along their normals, is
//   h = (1 - sin(alpha)) T/p,   whatever its thickness                                      (B)
#include "core/results/bridging.hpp"
#include "core/run/run.hpp"
#include "support/strip_scenes.hpp"

#include <gtest/gtest.h>

namespace plyform::bridging_scene_test {
namespace {

constexpr double width = 4.0, tension = 1.0; // mm, N/mm

/// 45 degrees down either way, to 30 mm; two grippers hold the strip's ends on the land.
Case strip_over_groove(bool yarns, double size, double pressure, double length) {
  Case data = stack_of({0.0}, rectangle(length, width, size));
  if (!yarns) {
    Fabric foil;
    foil.name = "foil";
    foil.thickness = 0.5, foil.surface_density = 4.75e-10;
    foil.sheet = IsotropicLaw{50.0, 0.0};
    data.fabrics = {foil};
  }
  Tool die;
  die.name = "die";
  die.shape = ExtrudedProfile{
      round_corners({{-150, 0, 0}, {-30, 0, 8}, {0, -30, 0}, {30, 0, 8}, {150, 0, 0}}, false,
                    {"", "", ""}),
      60.0};
  data.tools = {die};
  data.plies[0].z = 0.5 * data.fabrics[0].thickness;
  for (const double side : {-1.0, 1.0}) {
    Gripper gripper;
    const double near = side * 66.0, far = side * 72.0;
    gripper.place = {false, {Vec2(std::min(near, far), -width), Vec2(std::max(near, far), width)}};
    gripper.direction = side * Vec3::UnitX();
    gripper.force = tension * width;
    gripper.programme = {{0.05, gripper.force}};
    gripper.guided = true;
    data.boundaries.push_back({side < 0.0 ? "left" : "right", -1, gripper});
  }
  data.loads = {{0, PlyFace::above, pressure, {{0.6, pressure}}}};
  set_friction(data, 0.0);
  data.solver.duration = 0.03;
  data.solver.mass_damping = 1500.0;
  data.solver.step_factor = 0.8;
  data.solver.fibre_softening = yarns ? 200.0 : 1.0;
  data.solver.outputs = 1;
  return data;
}

struct Found {
  Bridging bridging;
  double wrinkle = 0.0;
};

Found spanned(bool yarns, double size, double pressure, double length = 140.0,
              double step_factor = 0.8) {
  Case data = strip_over_groove(yarns, size, pressure, length);
  data.solver.step_factor = step_factor;
  const RunResult run = run_case(data, 1, {});
  EXPECT_TRUE(ended(run.summary.status)) << run.summary.message;
  EXPECT_LT(std::abs(run.last.energy.balance_error()), 1e-3);
  EXPECT_LT(run.last.energy.kinetic, 1e-5 * run.last.energy.external);
  const Found found{bridging_of(run.last.plies[0]), run.summary.plies.at(0).wrinkle.height};
  const double theory = (1.0 - std::sqrt(0.5)) * tension / pressure;
  fmt::print("{}, elements of {:g} mm, {:g} N/mm2: height {:.3f} mm ({:.3f} of (B)) at x {:.2f} "
             "mm, {:.0f} mm2 ({:.2f} of the arc); wrinkle {:.2f} mm\n",
             yarns ? "yarns" : "film", size, pressure, found.bridging.height,
             found.bridging.height / theory, found.bridging.at.x(), found.bridging.area,
             found.bridging.area / (0.5 * std::numbers::pi * tension / pressure * width),
             found.wrinkle);
  return found;
}

TEST(BridgingScene, HeightOverAGrooveFallsAsTensionOverPressure) {
  for (const double pressure : {0.05, 0.1, 0.2}) {
    const double theory = (1.0 - std::sqrt(0.5)) * tension / pressure;
    const Found found = spanned(false, 2.0, pressure);
    EXPECT_NEAR(found.bridging.height, theory, 0.1 * theory);
    EXPECT_LT(std::abs(found.bridging.at.x()), 2.0);
    EXPECT_LT(found.wrinkle, 0.1);
  }
}

// An odd number of elements: no node lies over the groove's middle, where the height is largest.
TEST(BridgingScene, IsTheCurvesHighestWhereverNodesLie) {
  constexpr double pressure = 0.08, theory = (1.0 - 0.70710678118654752) * tension / pressure;
  for (const auto& [size, elements] : {std::pair(2.0, 71.0), std::pair(1.5, 95.0)})
    for (const double step_factor : {0.8, 0.5}) {
      const Found found = spanned(false, size, pressure, elements * size, step_factor);
      EXPECT_NEAR(found.bridging.height, theory, 0.02 * theory) << size << ' ' << step_factor;
    }
}

TEST(BridgingScene, HalfTheElementSizeGivesTheSameHeight) {
  const Bridging coarse = spanned(false, 2.0, 0.1).bridging,
                 fine = spanned(false, 1.0, 0.1).bridging;
  EXPECT_NEAR(coarse.height, fine.height, 0.1 * fine.height);
  EXPECT_NEAR(coarse.area, fine.area, 0.2 * fine.area); // its border is half an element off
}

TEST(BridgingScene, YarnsThatSpanAGrooveHaveTheTensionOfTheStrip) {
  const Found found = spanned(true, 2.0, 0.1);
  const double theory = (1.0 - std::sqrt(0.5)) * tension / 0.1;
  EXPECT_NEAR(found.bridging.height, theory, 0.1 * theory);
  const double per_yarn = tension / glass_weave().families[0].density;
  fmt::print("tension of {}: {:.3f} N at most, {:.3f} N in the mean of {:.3f} N\n",
             found.bridging.family, found.bridging.largest_tension, found.bridging.mean_tension,
             per_yarn);
  EXPECT_EQ(found.bridging.family, "warp");
  EXPECT_NEAR(found.bridging.mean_tension, per_yarn, 0.05 * per_yarn);
}

/// The fault's own scene: three plies between wavy tools that stop 2.8 mm before they are closed.
/// What they bend is the tools', no wrinkle, and nothing is pressed yet.
TEST(BridgingScene, AStripBetweenWavyToolsThatAreOpenHasNeither) {
  const double g = 1.8, s = std::sqrt(0.5); // mm, of the stack
  const auto wavy = [&](double gap) {
    const double large = 40.0 + gap, low = 40.0 - std::sqrt(3300.0);
    const Vec2 middle(large * 4.0 / 7.0 - 40.0, 40.0 - large * (40.0 - low) / 70.0),
        end(-40.0 - large * s, 40.0 - large * s);
    const Vec2 far = end + Vec2(-60.0, 60.0);
    using Kind = ProfileSegment::Kind;
    const auto mirrored = [](const Vec2& p) { return Vec2(-p.x(), p.y()); };
    return Profile{{Kind::line, far, end},
                   {Kind::arc, end, middle, {-40.0, 40.0}, 1},
                   {Kind::arc, middle, mirrored(middle), {0.0, low}, -1},
                   {Kind::arc, mirrored(middle), mirrored(end), {40.0, 40.0}, 1},
                   {Kind::line, mirrored(end), mirrored(far)}};
  };
  Case data = stack_of({0.0, 0.0, 0.0}, rectangle(136.0, 32.0, 4.0));
  Tool die;
  die.name = "die";
  die.shape = ExtrudedProfile{wavy(g), 80.0};
  Profile upside = wavy(0.0);
  std::reverse(upside.begin(), upside.end());
  for (ProfileSegment& one : upside)
    std::swap(one.a, one.b), one.turn = -one.turn;
  Tool punch;
  punch.name = "punch";
  punch.shape = ExtrudedProfile{upside, 80.0};
  punch.position = {0.0, 0.0, 14.61};
  punch.motion = Motion::driven;
  punch.stroke = 11.81;
  data.tools = {die, punch};
  for (Ply& ply : data.plies)
    ply.z += 12.8 - 0.3;
  stiffen_yarns(data.fabrics[0]);
  set_friction(data, 0.2);
  data.solver.duration = 0.05;
  data.solver.fibre_softening = 100.0;
  data.solver.outputs = 2;
  const RunResult run = run_case(data, 1, {});
  ASSERT_TRUE(ended(run.summary.status)) << run.summary.message;
  for (std::size_t p = 0; p < 3; ++p) {
    double low = 1e9, high = -1e9;
    for (const Vec3& x : run.last.plies[p].x)
      low = std::min(low, x.z()), high = std::max(high, x.z());
    EXPECT_GT(high - low, 3.0); // it bends
    EXPECT_LT(run.summary.plies[p].wrinkle.height, 0.1);
    EXPECT_TRUE(run.last.plies[p].bridging_height.empty());
  }
}

} // namespace
} // namespace plyform::bridging_scene_test
