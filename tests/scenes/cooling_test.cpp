// SPDX-License-Identifier: GPL-3.0-or-later
// Plies that cool in air, half on a tool, and against each other, beside closed forms.
//
//   one lump   T = T_e + (T_0 - T_e) e^(-t/tau),  tau = rho_A c / sum h                        (L)
//   two lumps  their mean stays, their difference falls by e^(-h t (1/C_a + 1/C_b))             (D)
#include "core/run/run.hpp"
#include "core/solver/step.hpp"
#include "support/kill_checks.hpp"
#include "support/scene_checks.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace plyform::cooling_test {
namespace {

constexpr double hot = 190.0, room = 20.0, bed = 60.0;          // degC
constexpr double to_air = 0.02, to_tools = 0.4, to_plies = 0.5; // N/(mm s K)
constexpr double capacity = 1.0e-9 * 1.2e9;                     // N mm/(mm^2 K)
constexpr double process = 10.0;                                // s

/// Sheets of prepreg of 1000 g/m^2 and 1.2 J/(g K), hot.
Case hot_plies(std::size_t plies, double element = 10.0) {
  Case data = stack_of(std::vector<double>(plies, 0.0), rectangle(60.0, 60.0, element));
  Fabric& fabric = data.fabrics[0];
  fabric.surface_density = 1.0e-9;
  fabric.heat_capacity = 1.2e9;
  data.process.duration = process;
  data.process.temperature = hot;
  data.process.cooling = Cooling{to_tools, to_plies, to_air, {{0.0, room}}};
  data.solver.duration = 0.02;
  data.solver.outputs = 10;
  set_friction(data, 0.2);
  return data;
}

/// The largest error of the temperatures that `form` gives, over how far they fell, over a run.
template <class Form>
double worst(const Case& data, const Form& form) {
  double error = 0.0;
  RunHooks hooks;
  hooks.frame = [&](const Frame& frame) {
    const double t = frame.time * data.process_time();
    for (std::size_t p = 0; p < frame.plies.size(); ++p)
      for (std::size_t n = 0; n < frame.plies[p].x0.size(); ++n)
        if (const std::optional<double> wanted = form(p, frame.plies[p].x0[n], t))
          error = std::max(error, std::abs(frame.plies[p].temperature[n] - *wanted) /
                                      std::max(1.0, hot - *wanted));
  };
  const RunResult run = run_case(data, 1, hooks);
  EXPECT_TRUE(ended(run.summary.status)) << run.summary.message;
  return error;
}

double lump(double from, double target, double h, double t) {
  return target + (from - target) * std::exp(-t * h / capacity);
}

TEST(Cooling, InAirFallsAsOneLumpDoesWhateverIsSimulatedOfIt) {
  for (const double duration : {0.02, 0.005}) {
    Case data = hot_plies(1);
    data.solver.duration = duration;
    const double error = worst(data, [](std::size_t, const Vec3&, double t) {
      return std::optional(lump(hot, room, 2.0 * to_air, t));
    });
    fmt::print("in air, {:g} s simulated: {:.5f}\n", duration, error);
    EXPECT_LT(error, 0.01);
  }
}

/// A block under the half of the ply where x < 0, which lies on it.
Case half_on_a_block() {
  Case data = hot_plies(1);
  Tool block;
  block.name = "block";
  block.shape = Box{{200.0, 200.0, 10.0}};
  block.position = {-100.0, 0.0, -5.0};
  block.temperature = {{0.0, bed}};
  data.tools = {block};
  set_friction(data, 0.2);
  return data;
}

TEST(Cooling, OnHalfATool) {
  const double h = to_tools + to_air, target = (to_tools * bed + to_air * room) / h;
  const double error =
      worst(half_on_a_block(), [&](std::size_t, const Vec3& x, double t) -> std::optional<double> {
        if (std::abs(x.x()) < 1e-9) return std::nullopt; // on the block's edge
        return x.x() < 0.0 ? lump(hot, target, h, t) : lump(hot, room, 2.0 * to_air, t);
      });
  fmt::print("half on a tool: {:.5f}\n", error);
  EXPECT_LT(error, 0.01);
}

TEST(Cooling, FollowsTheToolsAndTheAirOverTheTimeOfTheProcess) {
  // dT/dt = -(T - a - b t)/tau: a + b (t - tau) + (T_0 - a + b tau) e^(-t/tau)
  Case data = half_on_a_block();
  data.process.cooling->to_air = 0.0;
  data.tools[0].temperature = {{0.0, bed}, {process, bed + 50.0}};
  const double tau = capacity / to_tools, slope = 5.0;
  const double error = worst(data, [&](std::size_t, const Vec3& x, double t) {
    if (x.x() > -1e-9) return x.x() > 1e-9 ? std::optional(hot) : std::nullopt;
    return std::optional(bed + slope * (t - tau) + (hot - bed + slope * tau) * std::exp(-t / tau));
  });
  fmt::print("on a tool that warms up: {:.5f}\n", error);
  EXPECT_LT(error, 0.01);
}

TEST(Cooling, OfTwoPliesGoesToTheirMean) {
  Case data = hot_plies(2);
  const double cold = 90.0, mean = 0.5 * (hot + cold);
  data.plies[1].temperature = cold;
  data.process.cooling->to_air = 0.0;
  const double error = worst(data, [&](std::size_t p, const Vec3&, double t) {
    const double half = 0.5 * (hot - cold) * std::exp(-2.0 * to_plies * t / capacity);
    return std::optional(mean + (p == 0 ? half : -half));
  });
  fmt::print("two plies: {:.5f}\n", error);
  EXPECT_LT(error, 0.01);
}

TEST(Cooling, GoesThroughLessTheWiderAFilmOfAirIs) {
  // 0.1 mm of air of 0.03 W/(m K) bears 300 W/(m2 K), with 400 of touching in line 171
  Case data = half_on_a_block();
  data.plies[0].z += 0.1;
  const double h = 1.0 / (1.0 / to_tools + 1.0 / 0.3) + to_air;
  const double target = ((h - to_air) * bed + to_air * room) / h;
  const double error =
      worst(data, [&](std::size_t, const Vec3& x, double t) -> std::optional<double> {
        if (x.x() > -1e-9) return std::nullopt;
        return lump(hot, target, h, t);
      });
  fmt::print("a tenth of a millimetre above it: {:.5f}\n", error);
  EXPECT_LT(error, 0.01);
}

TEST(Cooling, HasTheSameBitsOnAnyThreadsAndAfterKills) {
  Case data = hot_plies(2);
  press_by_plate(data);
  for (Tool& tool : data.tools)
    tool.temperature = {{0.0, bed}};
  data.plies[1].temperature = 150.0;
  expect_sound_and_repeatable(data, 3);
}

TEST(Cooling, ChangesNothingElse) {
  Case warm = hot_plies(2), plain = warm;
  press_by_plate(warm), press_by_plate(plain);
  warm.tools[0].temperature = {{0.0, bed}};
  plain.process = {};
  const RunResult with = run_case(warm, 1, {}), without = run_case(plain, 1, {});
  EXPECT_TRUE(without.last.plies[0].temperature.empty());
  EXPECT_LT(with.last.plies[0].temperature[0], hot);
  for (std::size_t p = 0; p < 2; ++p)
    EXPECT_EQ(with.last.plies[p].x, without.last.plies[p].x);
}

} // namespace
} // namespace plyform::cooling_test
