// SPDX-License-Identifier: GPL-3.0-or-later
// Bending by rates in whole scenes: a strip that creeps beyond its clamp under its weight. While it
// is flat each section bears M = w (L - x)^2 / 2 = B kappa + f eta kappa' at any time, and so
//
//   sag(t) = w L^4 / (8 B) (1 - e^(-s)),  s = integral of B dt / (f(T) eta)
#include "support/boundary_scenes.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace plyform::viscous_bending_scene_test {
namespace {

constexpr double stiffness = 10.0, viscosity = 50.0; // B, N mm; eta, N mm s
constexpr double process = 10.0;                     // s: twice eta / B
constexpr double gravity = 98100.0;                  // mm/s^2, so that it sags by 0.8 mm
// 30 mm beyond the clamp, and half a cell: bending_long_test.cpp says why.
constexpr double length = 32.5; // mm

constexpr double cool_down = 8.0, room = 20.0; // s, degC

Case creeping_strip(double element, double duration) {
  Case data = stack_of({0.0}, rectangle(40.0, 20.0, element));
  Fabric& fabric = data.fabrics[0];
  for (YarnFamily& family : fabric.families)
    family.bending.stiffness = stiffness, family.bending_viscosity = viscosity,
    family.tension.compression = 0.1 * family.tension.stiffness;
  fabric.twist = stiffness;
  Grip clamp;
  clamp.place.ends = {Vec2(-20.0, -10.0), Vec2(-10.0, 10.0)};
  data.boundaries = {{"clamp", -1, clamp}};
  data.gravity = {0.0, 0.0, -gravity};
  set_friction(data, 0.0);
  data.solver.duration = duration; // s: overdamped, of a first mode of 430 rad/s
  data.solver.outputs = 10;
  data.process.duration = process;
  return data;
}

/// Of f(T), by which the strip's viscosity is multiplied; cooling: from 200 degC in air.
void heat(Case& data, double celsius, bool cooling) {
  Fabric& fabric = data.fabrics[0];
  fabric.flow = ArrheniusFactor{41000.0, 180.0};
  data.process.temperature = celsius;
  if (!cooling) return;
  fabric.heat_capacity = 1.0e9; // N mm/(t K)
  const double to_air = 0.5 * fabric.surface_density * *fabric.heat_capacity / cool_down;
  data.process.cooling = Cooling{0.0, 0.0, to_air, {{0.0, room}}};
}

/// s of the formula at a time of the process.
double crept(const Case& data, double time) {
  const double hot = data.process.temperature.value_or(180.0);
  const int n = 1000;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    const double t = time * (i + 0.5) / n;
    const double celsius =
        data.process.cooling ? room + (hot - room) * std::exp(-t / cool_down) : hot;
    sum += time / n * stiffness / (viscosity * data.fabrics[0].flow.at(celsius));
  }
  return sum;
}

/// How far the sag is off at most, over that of the end: with the length of the closed form, and
/// with one that is right at the end.
void expect_creep(const Case& data) {
  std::vector<double> sags, wanted;
  RunHooks hooks;
  hooks.frame = [&](const Frame& frame) {
    const PlyFrame& ply = frame.plies[0];
    double sag = 0.0;
    int ends = 0;
    for (std::size_t n = 0; n < ply.x0.size(); ++n)
      if (ply.x0[n].x() > 19.9) sag += ply.x0[n].z() - ply.x[n].z(), ++ends;
    sags.push_back(sag / ends);
    const double rest = data.fabrics[0].surface_density * gravity * std::pow(length, 4);
    wanted.push_back(rest / (8.0 * stiffness) *
                     -std::expm1(-crept(data, frame.time * data.process_time())));
  };
  const RunResult run = run_case(data, 1, hooks);
  EXPECT_TRUE(ended(run.summary.status)) << run.summary.message;
  EXPECT_LT(std::abs(run.last.energy.balance_error()), 0.01);
  EXPECT_GT(run.last.energy.viscous, 0.4 * run.last.energy.external);
  ASSERT_GE(sags.size(), 10u);
  double largest = 0.0;
  for (std::size_t i = 0; i < sags.size(); ++i)
    largest = std::max(largest, std::abs(sags[i] / sags.back() - wanted[i] / wanted.back()));
  fmt::print("[ creep    ] {:.4f} mm, {:.4f} of the closed form; off by {:.2g} % on the way\n",
             sags.back(), sags.back() / wanted.back(), 100.0 * largest);
  EXPECT_NEAR(sags.back() / wanted.back(), 1.0, 0.03); // six elements along the strip
  EXPECT_LT(largest, 0.01);
}

TEST(ViscousBendingScene, StripCreepsBeyondItsClamp) {
  expect_creep(creeping_strip(5.0, 0.1));
  expect_creep(creeping_strip(5.0, 0.05)); // the same process, simulated in half the time
}

TEST(ViscousBendingScene, WarmStripCreepsFaster) {
  Case data = creeping_strip(5.0, 0.1);
  heat(data, 200.0, false);
  expect_creep(data);
}

TEST(ViscousBendingScene, StripThatCoolsCreepsSlowerAndSlower) {
  Case data = creeping_strip(5.0, 0.1);
  heat(data, 200.0, true);
  expect_creep(data);
}

} // namespace
} // namespace plyform::viscous_bending_scene_test
