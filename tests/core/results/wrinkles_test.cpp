// SPDX-License-Identifier: GPL-3.0-or-later
// Heights of wrinkles against closed forms, and shapes of tools that are none. Elements of 6.8 mm.
#include "contact/forces/tool_ply.hpp"
#include "core/results/wrinkles.hpp"
#include "support/ply_sheets.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace plyform::wrinkles_test {
namespace {

using sheets::sheet;

constexpr double h = 6.8, pi = std::numbers::pi;

Wrinkle highest(double angle_deg, const std::function<Vec3(const Vec2&)>& shape,
                const std::vector<const ToolBody*>& tools = {}) {
  return wrinkles_of(sheet(40, 40, h, angle_deg, shape), tools).highest;
}

/// A sheet along a profile in x that starts flat, turns down by `turn` (rad) on a radius, and goes
/// on straight; places of the unformed sheet keep their distances.
Vec3 over_fillet(const Vec2& p, double radius, double turn) {
  const double arc = radius * turn, s = p.x() + 0.5 * arc;
  const double angle = std::clamp(s / radius, 0.0, turn), beyond = std::max(s - arc, 0.0);
  return {std::min(s, 0.0) + radius * std::sin(angle) + beyond * std::cos(turn), p.y(),
          radius * (std::cos(angle) - 1.0) - beyond * std::sin(turn)};
}

TEST(Wrinkles, WavesHaveTheirHeightWhicheverWayTheyRun) {
  for (const double elements : {4.0, 6.0, 8.0})
    for (const double direction_deg : {0.0, 22.5, 45.0, 70.0, 90.0}) {
      const double angle = direction_deg * pi / 180.0, length = elements * h;
      const Vec2 u(std::cos(angle), std::sin(angle));
      const Wrinkle w = highest(0.0, [&](const Vec2& p) {
        return Vec3(p.x(), p.y(), 1.5 * std::cos(2.0 * pi * p.dot(u) / length));
      });
      fmt::print("wave of {:g} elements at {:g} deg: {:.3f} of 3 mm, {:.1f} of {:.1f} mm long\n",
                 elements, direction_deg, w.height, w.wavelength, length);
      // Four elements to a wave carry it to a tenth; from six on the grid of places decides.
      EXPECT_NEAR(w.height, 3.0, elements < 5.0 ? 0.45 : 0.25);
      EXPECT_NEAR(w.wavelength, length, (elements < 5.0 ? 0.5 : 0.1) * length);
    }
}

TEST(Wrinkles, ALoneBumpHasItsHeightAndPlace) {
  const Vec2 middle(20.0, -30.0);
  const Wrinkle w = highest(30.0, [&](const Vec2& p) {
    const double r = std::min((p - middle).norm(), 20.0);
    return Vec3(p.x(), p.y(), 1.0 + std::cos(pi * r / 20.0));
  });
  EXPECT_NEAR(w.height, 2.0, 0.3); // facets cut its top
  EXPECT_LT((w.at.head<2>() - middle).norm(), h);
  EXPECT_NEAR(w.wavelength, 40.0, 10.0);
}

TEST(Wrinkles, ShapesOfToolsAreNone) {
  constexpr double radius = 75.0;
  for (const double angle_deg : {0.0, 10.0, 22.5, 30.0, 45.0}) {
    EXPECT_LT(highest(angle_deg, sheets::flat).height, 1e-9);
    const PlyFrame ball = sheet(20, 20, h, angle_deg, [](const Vec2& p) {
      const double r = std::max(p.norm(), 1e-9), a = r / radius; // distances from the pole stay
      return Vec3(p.x() / r * radius * std::sin(a), p.y() / r * radius * std::sin(a),
                  radius * std::cos(a));
    });
    const Wrinkle on_ball = wrinkles_of(ball, {}).highest;
    const Wrinkle at_fillet =
        highest(angle_deg, [](const Vec2& p) { return over_fillet(p, 10.0, 0.5 * pi); });
    const Wrinkle in_s = highest(angle_deg, [](const Vec2& p) {
      return Vec3(p.x(), p.y(), 10.0 * std::tanh(p.x() / 15.0)); // once up and once down
    });
    fmt::print("at {:g} deg: ball {:.3f} mm, fillet {:.3f} mm, S {:.3f} mm\n", angle_deg,
               on_ball.height, at_fillet.height, in_s.height);
    EXPECT_LT(on_ball.height, 0.01);  // its facets sag by 0.08 mm
    EXPECT_LT(at_fillet.height, 0.2); // by 0.6 mm: the head of core/results/wrinkles.hpp
    EXPECT_LT(in_s.height, 0.1);
  }
}

/// A wave that a tool has as well is none; on the same tool a wave of the ply's own is one.
TEST(Wrinkles, APlyThatFollowsAToolHasNone) {
  RevolvedProfile rings; // waves of 3 mm round z, 40 mm long
  for (int i = 0; i < 200; ++i) {
    const auto point = [](int k) -> Vec2 { return {k, 1.5 * std::cos(2.0 * pi * k / 40.0)}; };
    rings.segments.push_back({ProfileSegment::Kind::line, point(i), point(i + 1)});
  }
  for (ProfileSegment& s : rings.segments) // material on the right of the way: below
    ASSERT_LT(s.a.x(), s.b.x());
  ToolBody tool;
  tool.shape = rings;
  const auto on_tool = [](const Vec2& p) {
    return Vec3(p.x(), p.y(), 0.3 + 1.5 * std::cos(2.0 * pi * p.norm() / 40.0));
  };
  EXPECT_GT(highest(0.0, on_tool).height, 2.7);
  EXPECT_LT(highest(0.0, on_tool, {&tool}).height, 0.6); // facets against a smooth tool
  const auto off_tool = [&](const Vec2& p) -> Vec3 {
    return on_tool(p) + Vec3(0.0, 0.0, 1.0 + std::cos(2.0 * pi * p.y() / 40.0));
  };
  EXPECT_GT(highest(0.0, off_tool, {&tool}).height, 1.4);
}

/// Waves round z of this height (mm, valley to crest), 40 mm long, about z = `level`: the surface
/// of a tool with its material below, or above.
ToolBody rings(double height, double level, bool above) {
  const auto point = [&](int k) -> Vec2 {
    return {k, level + 0.5 * height * std::cos(2.0 * pi * k / 40.0)};
  };
  RevolvedProfile profile;
  for (int i = 0; i < 100; ++i) {
    const int k = above ? 200 - 2 * i : 2 * i,
              next = above ? k - 2 : k + 2; // material on the right
    profile.segments.push_back({ProfileSegment::Kind::line, point(k), point(next)});
  }
  ToolBody tool;
  tool.shape = profile;
  return tool;
}

/// Between wavy tools that are not closed yet a ply bends over the crests of both, less than they.
TEST(Wrinkles, APlyOnItsWayIntoToolsHasNone) {
  for (const double share : {0.25, 0.5, 0.75}) // of the tools' waves
    for (const double gap : {0.0, 2.0, 6.0}) { // mm, more than they need
      const double waves = 6.0, room = waves * (1.0 - share);
      const ToolBody die = rings(waves, -0.5 * room - 0.5 * gap, false),
                     punch = rings(waves, 0.5 * room + 0.5 * gap, true);
      const auto shape = [&](const Vec2& p) {
        return Vec3(p.x(), p.y(), 0.5 * share * waves * std::cos(2.0 * pi * p.norm() / 40.0));
      };
      const double free = highest(0.0, shape).height, on_die = highest(0.0, shape, {&die}).height,
                   between = highest(0.0, shape, {&die, &punch}).height;
      fmt::print(
          "{:g} of 6 mm, {:g} mm to spare: {:.2f} free, {:.2f} over the die, {:.2f} between\n",
          share, gap, free, on_die, between);
      EXPECT_GT(free, 0.9 * share * waves);
      EXPECT_LT(on_die, 0.15 * share * waves + 0.2);
      EXPECT_LT(between, 0.15 * share * waves + 0.2);
    }
}

/// Wrinkles between flat tools, over a ball, and waves of a ply that tools have elsewhere or turned
/// round are still found.
TEST(Wrinkles, WavesThatToolsDoNotHaveAreFound) {
  ToolBody floor, lid;
  floor.shape = Plane{};
  floor.position.z() = -2.0;
  lid.shape = Plane{};
  lid.position.z() = 2.0;
  lid.rotation = Eigen::AngleAxisd(pi, Vec3::UnitX()).toRotationMatrix();
  const auto wave = [](const Vec2& p) {
    return Vec3(p.x(), p.y(), 1.5 * std::cos(2.0 * pi * p.x() / 40.0));
  };
  EXPECT_NEAR(highest(0.0, wave, {&floor, &lid}).height, 3.0, 0.3);
  const auto rounds = [](const Vec2& p) {
    return Vec3(p.x(), p.y(), 1.5 * std::cos(2.0 * pi * p.norm() / 40.0));
  };
  const ToolBody flat_rings = rings(1.0, -3.0, false); // a third of it
  EXPECT_GT(highest(0.0, rounds, {&flat_rings}).height, 1.2);
  const auto opposite = [](const Vec2& p) {
    return Vec3(p.x(), p.y(), 4.0 - 1.5 * std::cos(2.0 * pi * p.norm() / 40.0));
  };
  const ToolBody die = rings(3.0, 0.0, false);
  EXPECT_GT(highest(0.0, opposite, {&die}).height, 2.7);
  ToolBody ball;
  ball.shape = Sphere{150.0};
  ball.position.z() = -152.0;
  const auto over_ball = [](const Vec2& p) {
    const double r = std::max(p.norm(), 1e-9), a = r / 150.0;
    const double high = 150.0 + 1.5 * std::cos(2.0 * pi * p.x() / 40.0);
    return Vec3(p.x() / r * high * std::sin(a), p.y() / r * high * std::sin(a),
                high * std::cos(a) - 152.0);
  };
  EXPECT_GT(highest(0.0, over_ball, {&ball}).height, 2.5);
}

} // namespace
} // namespace plyform::wrinkles_test
