// SPDX-License-Identifier: GPL-3.0-or-later
// Whole runs of fabrics whose law of shear differs by the sign of the angle.
#include "core/identify/shear_tests.hpp"
#include "core/run/run.hpp"
#include "support/kill_checks.hpp"
#include "support/membrane_checks.hpp"
#include "support/scene_checks.hpp"
#include "support/thread_checks.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace plyform::shear_signs_scene_test {
namespace {

constexpr double side = 100.0; // mm, of the frame

/// A picture frame whose hinge at (50, 50) is pulled, sheared by 40 degrees. Its warp lies along x
/// or, turned by a right angle, along y: then the angle from warp to weft opens. Pairs of elements
/// of 25 mm: squares along the yarns, or free triangles.
Case frame_of(const Fabric& fabric, bool opens, MeshKind mesh) {
  constexpr double most = 40.0 * degree;
  Case data = stack_of({opens ? 0.5 * std::numbers::pi : 0.0}, rectangle(side, side, 25.0, mesh));
  data.fabrics = {fabric};
  HingedFrame frame;
  frame.hinges = {Vec2(-50, -50), Vec2(50, -50), Vec2(50, 50), Vec2(-50, 50)};
  frame.stroke = extension_at(shear_test(FrameSpecimen{side}), most);
  data.boundaries = {{"frame", -1, frame}};
  set_friction(data, 0.0);
  data.solver.element = ElementKind::averaged;
  data.solver.fibre_softening = 10000.0; // large steps; even so the yarns hardly stretch
  data.solver.duration = 40.0;           // s: no inertia
  return data;
}

/// Loads (N) by stroke (mm) at the outputs from 10 degrees on.
std::vector<std::pair<double, double>> loads_of(const Case& data) {
  const ShearTest test = shear_test(FrameSpecimen{side});
  std::vector<std::pair<double, double>> loads;
  RunHooks hooks;
  hooks.frame = [&](const Frame& f) {
    const BoundaryFrame& b = f.boundaries.at(0);
    if (shear_angle(test, b.stroke_mm) > 10.0 * degree) loads.emplace_back(b.stroke_mm, b.force_N);
  };
  const RunResult run = run_case(data, 1, hooks);
  EXPECT_TRUE(ended(run.summary.status)) << run.summary.message;
  EXPECT_LT(std::abs(run.last.energy.balance_error()), 0.01);
  return loads;
}

TEST(ShearSignsScene, FramesBothWaysHaveTheLoadOfEitherSide) {
  const ShearTest test = shear_test(FrameSpecimen{side});
  for (const Fabric& fabric : {two_sided_weave(), two_sided_table()})
    for (const MeshKind mesh : {MeshKind::diagonal, MeshKind::free}) {
      std::vector<std::pair<double, double>> both[2];
      for (const bool opens : {false, true}) {
        both[opens] = loads_of(frame_of(fabric, opens, mesh));
        EXPECT_GE(both[opens].size(), 5u);
        for (const auto& [stroke, load] : both[opens])
          EXPECT_NEAR(load / test_load(test, fabric, stroke, opens), 1.0, 0.01)
              << (opens ? "opens " : "closes ") << stroke;
      }
      for (std::size_t i = 0; i < std::min(both[0].size(), both[1].size()); ++i) {
        const double angle = shear_angle(test, both[0][i].first);
        const ShearLaw& law = fabric.crossings[0].shear;
        const double ratio = -law.at(angle).value / law.at(-angle).value;
        EXPECT_NEAR(both[0][i].second / both[1][i].second / ratio, 1.0, 0.01) << angle;
      }
    }
}

/// A side that does not resist at all has no load, and the run holds.
TEST(ShearSignsScene, SideWithoutTorqueHasNoLoad) {
  const ShearTest test = shear_test(FrameSpecimen{side});
  const Fabric fabric = two_sided_table(true);
  for (const auto& [stroke, load] : loads_of(frame_of(fabric, true, MeshKind::free)))
    EXPECT_LE(std::abs(load), 0.01 * test_load(test, fabric, stroke)) << stroke;
}

/// Over a ball: energy is closed, bits are the same on any number of threads, and a run that is
/// killed ends as one that is not.
TEST(ShearSignsScene, FormOverABall) {
  Case data = coarse_hemisphere({0.0, 0.25 * std::numbers::pi});
  data.fabrics = {two_sided_table(), two_sided_weave()};
  for (Fabric& fabric : data.fabrics)
    stiffen_yarns(fabric);
  data.plies[1].fabric = 1;
  data.tools[0].stroke = 30.0;
  data.solver.duration = 0.02;
  const Energies last = expect_sound_and_repeatable(data, 2);
  EXPECT_GT(last.shear, 0.0);
}

} // namespace
} // namespace plyform::shear_signs_scene_test
