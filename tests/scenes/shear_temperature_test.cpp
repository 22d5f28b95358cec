// SPDX-License-Identifier: GPL-3.0-or-later
// Elastic shear that follows the temperature, in whole scenes: picture frames at two temperatures
// and of a ply that cools.
#include "core/model/reachable_temperature.hpp"
#include "support/kill_checks.hpp"
#include "support/picture_frames.hpp"

#include <cstdio>
#include <gtest/gtest.h>

namespace plyform::shear_temperature_test {
namespace {

constexpr double pi = std::numbers::pi;

/// A frame of 100 mm that shears to 50 degrees; torque over temperature is as given.
Case frame_at(double celsius) {
  Case data = picture_frame();
  data.fabrics[0].shear_over_temperature =
      TableFactor{{20.0, 100.0, 160.0, 180.0, 220.0}, {9.0, 5.0, 1.4, 1.0, 0.7}, 180.0};
  data.process.temperature = celsius;
  return data;
}

/// The same of a ply that cools from 200 degC in air, in 10 s of the process.
Case cooling_frame() {
  Case data = frame_at(200.0);
  data.fabrics[0].heat_capacity = 1.2e9; // N mm/(t K)
  data.process.duration = 10.0;
  data.process.cooling = Cooling{0.0, 0.0, 0.04, {{0.0, 20.0}}};
  return data;
}

double factor_of(const Case& data, double celsius) {
  return data.fabrics[0].shear_over_temperature.at(celsius);
}

TEST(ShearTemperature, FramesHaveLoadsInTheRatioOfTheirFactors) {
  const std::vector<Frame> at_reference = outputs_of(frame_at(180.0));
  for (const double celsius : {120.0, 205.0}) {
    const Case data = frame_at(celsius);
    const double f = factor_of(data, celsius);
    EXPECT_GT(std::abs(std::log(f)), 0.1);
    Case by_law = frame_at(180.0); // its law multiplied in place of its temperature
    for (double& k : by_law.fabrics[0].crossings[0].shear.k)
      k *= f;
    const double soft = make_scene(by_law).plies[0].bound.soft; // 1/s^2, in the stable step
    EXPECT_NEAR(make_scene(data).plies[0].bound.soft, soft, 1e-9 * soft);
    const std::vector<Frame> found = outputs_of(data), wanted = outputs_of(by_law);
    ASSERT_EQ(found.size(), wanted.size());
    const double last = wanted.back().boundaries[0].force_N;
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_NEAR(found[i].boundaries[0].force_N, wanted[i].boundaries[0].force_N, 1e-6 * last);
    const double ratio = last / at_reference.back().boundaries[0].force_N / f;
    std::printf("[ shear    ] %g degC: ratio of loads over that of factors - 1: %.2g\n", celsius,
                ratio - 1.0);
    EXPECT_NEAR(ratio, 1.0, 1e-6);
    EXPECT_NEAR(found.back().energy.shear / at_reference.back().energy.shear, f, 1e-6 * f);
  }
}

/// Sheared while it cools and held then: its load and its energy are those of its present
/// temperature, and what cooling gives to the energy of shear closes the balance.
TEST(ShearTemperature, OfAPlyThatCoolsIsThatOfItsTemperature) {
  Case data = cooling_frame();
  data.solver.dwell = 0.5;
  double largest = 0.0;
  int judged = 0;
  const std::vector<Frame> frames = outputs_of(data);
  for (const Frame& frame : frames) {
    const double gamma = frame_angle(data, frame.time);
    const double f = factor_of(data, frame.plies[0].temperature[0]);
    EXPECT_LT(std::abs(frame.energy.balance_error()), 0.01) << frame.time;
    if (gamma < 10.0 * pi / 180.0) continue;
    ++judged;
    const double off =
        frame.boundaries[0].force_N /
            frame_load(data, gamma, f * data.fabrics[0].crossings[0].shear.at(gamma).value) -
        1.0;
    EXPECT_NEAR(off, 0.0, 0.01) << frame.time;
    largest = std::max(largest, std::abs(off));
    const double stored =
        frame_cells(data) * f * data.fabrics[0].crossings[0].shear.at(gamma).energy;
    EXPECT_NEAR(frame.energy.shear, stored, 0.01 * stored) << frame.time;
  }
  EXPECT_GE(judged, 6);
  EXPECT_GT(factor_of(data, frames.back().plies[0].temperature[0]), 1.3);
  std::printf("[ shear    ] of a ply that cools: load off by %.2g %% at most, balance %.2g %%\n",
              100.0 * largest, 100.0 * frames.back().energy.balance_error());
}

/// What is counted as heat is the integral of W df, and large: without it no balance would close.
TEST(ShearTemperature, HeatIsTheIntegralOfEnergyOverTheFactor) {
  Case data = cooling_frame();
  data.solver.outputs = 200;
  double heat = 0.0;
  const std::vector<Frame> frames = outputs_of(data);
  const auto state_of = [&](const Frame& frame) {
    const double w = data.fabrics[0].crossings[0].shear.at(frame_angle(data, frame.time)).energy;
    return std::pair(frame_cells(data) * w, factor_of(data, frame.plies[0].temperature[0]));
  };
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const auto [w0, f0] = state_of(frames[i - 1]);
    const auto [w1, f1] = state_of(frames[i]);
    heat += 0.5 * (w0 + w1) * (f1 - f0);
  }
  Scene scene = make_scene(data);
  const double coldest = reachable_temperatures(data, data.plies[0])->least;
  EXPECT_EQ(scene.plies[0].membrane.crossings[0].stiffest, factor_of(data, coldest));
  EXPECT_GE(factor_of(data, coldest), factor_of(data, frames.back().plies[0].temperature[0]));
  const RunResult run = run_scene(scene, 1, {});
  EXPECT_NEAR(scene.plies[0].law_work, heat, 0.01 * heat);
  EXPECT_GT(heat, 0.05 * run.last.energy.external);
}

TEST(ShearTemperature, HasTheSameBitsAfterKillsAndOnTwoThreads) {
  Case data = cooling_frame();
  data.solver.duration = 0.1;
  const Energies last = expect_sound_and_repeatable(data, 2);
  EXPECT_GT(last.shear, 0.0);
}

/// A run that goes back to an earlier state takes the heat of then, and comes to the same again.
TEST(ShearTemperature, GoesBackAndComesToTheSame) {
  Case data = cooling_frame();
  data.solver.duration = 0.1;
  ThreadPool pool(1);
  Scene scene = make_scene(data);
  start(scene, pool);
  const auto step_to = [&](double time) {
    while (scene.time < time) {
      EXPECT_FALSE(compute_forces(scene, pool));
      move_plies(scene, pool);
    }
    return scene.plies[0].law_work;
  };
  const double then = step_to(0.05);
  Snapshot good;
  keep(scene, current_energies(scene, pool), good);
  const double later = step_to(0.08);
  EXPECT_GT(then, 0.0);
  EXPECT_GT(later, 1.5 * then);
  restore(scene, good);
  EXPECT_EQ(scene.plies[0].law_work, then);
  EXPECT_NEAR(step_to(0.08), later, 1e-3 * later); // bounds of the step may be renewed elsewhere
}

/// Two plies that cool while a ball forms them.
TEST(ShearTemperature, FormsOverABall) {
  Case data = coarse_hemisphere({0.0, 0.25 * pi});
  for (Fabric& fabric : data.fabrics) {
    fabric.shear_over_temperature = frame_at(20.0).fabrics[0].shear_over_temperature;
    fabric.heat_capacity = 1.2e9;
  }
  data.tools[0].stroke = 30.0;
  data.solver.duration = 0.02;
  data.process.duration = 10.0;
  data.process.temperature = 200.0;
  data.process.cooling = Cooling{0.0, 0.5, 0.04, {{0.0, 20.0}}};
  expect_sound_and_repeatable(data, 2);
}

} // namespace
} // namespace plyform::shear_temperature_test
