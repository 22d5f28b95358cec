// SPDX-License-Identifier: GPL-3.0-or-later
// Element sizes that a state of the scout asks for, against the sagitta of a chord.
#include "core/setup/chord_sizes.hpp"
#include "core/solver/scene.hpp"
#include "support/scene_checks.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace plyform::chord_sizes_test {
namespace {

constexpr double largest = 20.0; // mm

/// Plies of `cell` mm wrapped round a sphere of `radius` below them, as they would lie.
Frame wrapped(const Case& data, double radius, double cell) {
  Frame frame;
  frame.tools.resize(data.tools.size());
  double above = radius;
  for (std::size_t p = 0; p < data.plies.size(); ++p) {
    const double thickness = data.fabrics[0].thickness;
    PlyFrame& ply = frame.plies.emplace_back();
    const BlankMesh mesh = mesh_blank(rectangle(4.0 * cell, 4.0 * cell, cell), 0.0, 0.0);
    for (const Vec2& x : mesh.x) {
      ply.x0.emplace_back(x.x(), x.y(), 0.0);
      ply.x.emplace_back((above + 0.5 * thickness) *
                         Vec3(x.x() / radius, x.y() / radius, 1.0).normalized());
    }
    ply.triangles = mesh.triangles;
    above += thickness;
  }
  return frame;
}

Case over_sphere(std::size_t plies, double radius) {
  Case data = stack_of(std::vector<double>(plies, 0.0), rectangle(10.0, 10.0, 10.0));
  Tool tool;
  tool.shape = Sphere{radius};
  tool.motion = Motion::driven, tool.direction = Vec3::UnitZ(), tool.stroke = 1.0;
  Tool far;
  far.shape = Plane{};
  far.position.z() = -1e3;
  data.tools = {tool, far};
  return data;
}

std::vector<AskedSizes> asked(const Case& data, const Frame& state,
                              const ChordLimits& limits = {}) {
  std::vector<AskedSizes> sizes;
  for (const PlyFrame& ply : state.plies) {
    sizes.emplace_back(ply.triangles.size());
    for (auto& places : sizes.back())
      places.fill(largest);
  }
  ChordSizes(data, limits).lower(state, sizes);
  return sizes;
}

// h from (1): a chord of L cuts L^2 / 8R deep at first order, the next one is (L/4R)^2 of that;
// sizes are found to 5 %.
TEST(ChordSizes, AreThoseOfAChordOverASphere) {
  for (const double radius : {10.0, 25.0, 80.0}) {
    const Case data = over_sphere(1, radius);
    const double thickness = data.fabrics[0].thickness;
    const Frame state = wrapped(data, radius, 1.0);
    const double expected =
        std::min(largest, std::sqrt(8.0 * (radius + 0.5 * thickness) * 0.7 * thickness) / 1.7);
    const std::vector<AskedSizes> sizes = asked(data, state);
    for (const auto& places : sizes[0])
      for (const double size : places)
        EXPECT_NEAR(size, expected, 0.06 * expected) << radius;
  }
}

TEST(ChordSizes, OfPliesBetweenMayCutDeeper) {
  const Case data = over_sphere(3, 15.0);
  const auto sizes = asked(data, wrapped(data, 15.0, 1.0));
  const double on_tool = sizes[0][0][0], between = sizes[1][0][0];
  EXPECT_NEAR(between / on_tool, std::sqrt(5.0 / 3.0 / 0.7), 0.15);
}

TEST(ChordSizes, StayWherePliesDoNotTouch) {
  const Case data = over_sphere(1, 10.0);
  Frame state = wrapped(data, 10.0, 1.0);
  for (Vec3& x : state.plies[0].x)
    x *= 1.3; // 3 mm off
  const std::vector<AskedSizes> sizes = asked(data, state);
  for (const auto& places : sizes[0])
    for (const double size : places)
      EXPECT_EQ(size, largest);
}

TEST(ChordSizes, AreNoSmallerThanAFewThicknessesOverAnEdge) {
  const Case data = over_sphere(1, 0.05);
  const auto sizes = asked(data, wrapped(data, 0.05, 0.05));
  EXPECT_DOUBLE_EQ(sizes[0][0][0], 3.0 * data.fabrics[0].thickness);
}

// What is known from states before spares work and changes no size: plies that slide and turn over
// the sphere, by steps of which many are too short for another look.
TEST(ChordSizes, AreThoseOfEachStateAlone) {
  const double radius = 25.0;
  const Case data = over_sphere(2, radius);
  Frame state = wrapped(data, radius, 3.0);
  std::vector<AskedSizes> together = asked(data, state), alone = together;
  ChordSizes chords(data);
  for (int step = 0; step < 60; ++step) {
    const double turn = step % 7 == 0 ? 0.05 : 0.002; // rad
    const Eigen::AngleAxisd by(turn, Vec3(1.0, 0.1 * step, 0.3).normalized());
    for (PlyFrame& ply : state.plies)
      for (Vec3& x : ply.x)
        x = by * x * (step % 11 == 0 ? 1.003 : 1.0);
    chords.lower(state, together);
    ChordSizes(data).lower(state, alone);
    ASSERT_EQ(together, alone) << step;
  }
}

} // namespace
} // namespace plyform::chord_sizes_test
