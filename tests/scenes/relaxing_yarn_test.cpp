// SPDX-License-Identifier: GPL-3.0-or-later
// Yarns that relax, in a whole scene: a strip along its yarns is drawn and held while it cools. Its
// load follows from the strain e(t) of the grips by quadrature of
//
//   F = n (K e + q),   q' + q / (f(T) theta) = k e',   n yarns across the strip
#include "support/boundary_scenes.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace plyform::relaxing_yarn_test {
namespace {

constexpr double stiffness = 4000.0, branch = 8000.0, relaxation = 4.0; // K, k, N; theta, s
constexpr double process = 20.0, drawn = 0.25;               // s; its part of the process
constexpr double stroke = 1.0, length = 100.0, width = 20.0; // mm
constexpr double hot = 200.0, room = 20.0, cool_down = 30.0; // degC, s

Case held_strip(bool cooling, double duration) {
  Case data = strip(0.0, Vec3::UnitX(), stroke);
  std::get<Grip>(data.boundaries[1].kind).programme = {{drawn, stroke}, {1.0 - drawn, stroke}};
  Fabric& fabric = data.fabrics[0];
  for (YarnFamily& family : fabric.families) {
    family.tension.stiffness = stiffness;
    family.relaxation = MaxwellBranch{branch, relaxation};
  }
  data.solver.fibre_softening = 1.0, data.solver.duration = duration, data.solver.outputs = 20;
  data.process.duration = process;
  if (!cooling) return data;
  fabric.flow = ArrheniusFactor{20000.0, 180.0};
  fabric.heat_capacity = 1.0e9; // N mm/(t K)
  const double to_air = 0.5 * fabric.surface_density * *fabric.heat_capacity / cool_down;
  data.process.temperature = hot;
  data.process.cooling = Cooling{0.0, 0.0, to_air, {{0.0, room}}};
  return data;
}

/// N, of the closed form at a time of the process.
double load(const Case& data, double time) {
  const auto strain = [&](double t) {
    return stroke / length * std::clamp(smooth_step(1.0, t / (drawn * process), 1.0), 0.0, 1.0);
  };
  const int n = 4000;
  double q = 0.0;
  for (int i = 0; i < n; ++i) {
    const double dt = time / n, t = i * dt;
    const double celsius =
        data.process.cooling ? room + (hot - room) * std::exp(-(t + 0.5 * dt) / cool_down) : 180.0;
    const MaxwellStep step =
        maxwell_step({branch, relaxation * data.fabrics[0].flow.at(celsius)}, dt);
    q = step.keep * q + step.rise * (strain(t + dt) - strain(t));
  }
  return width * data.fabrics[0].families[0].density * (stiffness * strain(time) + q);
}

/// Holds the load on the grip against the closed form, and that its tension and energy follow.
void expect_load(const Case& data) {
  double off = 0.0, most = 0.0, last = 0.0, tension = 0.0;
  RunHooks hooks;
  hooks.frame = [&](const Frame& frame) {
    if (frame.time <= 0.0) return;
    last = load(data, frame.time * data.process_time());
    most = std::max(most, last);
    off = std::max(off, std::abs(frame.boundaries[1].force_N - last));
    const std::vector<double>& n = frame.plies[0].families[0].tension;
    tension = std::accumulate(n.begin(), n.end(), 0.0) / static_cast<double>(n.size());
  };
  const RunResult run = run_case(data, 1, hooks);
  EXPECT_TRUE(ended(run.summary.status)) << run.summary.message;
  fmt::print("[ load     ] {:.3f} N at most, {:.3f} N at the end; off by {:.2g} % of it at most\n",
             most, last, 100.0 * off / most);
  EXPECT_LT(last, 0.8 * most); // it has relaxed
  EXPECT_LT(off, 0.01 * most);
  EXPECT_NEAR(tension * width * data.fabrics[0].families[0].density, last, 0.01 * most);
  EXPECT_LT(std::abs(run.last.energy.balance_error()), 0.002);
  EXPECT_GT(run.last.energy.viscous, 0.2 * run.last.energy.external);
  EXPECT_LT(run.last.energy.damping, 0.02 * run.last.energy.external);
}

TEST(RelaxingYarnScene, AStripThatIsHeldHasTheLoadOfTheClosedForm) {
  expect_load(held_strip(false, 0.02));
  expect_load(held_strip(false, 0.04)); // the same process, simulated in twice the time
}

TEST(RelaxingYarnScene, AStripThatCoolsRelaxesSlowerAndSlower) {
  expect_load(held_strip(true, 0.02));
}

TEST(RelaxingYarnScene, HasTheSameBitsWithAnyNumberOfThreads) {
  const Case data = held_strip(true, 0.002);
  const RunResult one = run_case(data, 1, {}), two = run_case(data, 2, {});
  EXPECT_EQ(one.last.plies[0].families[0].tension, two.last.plies[0].families[0].tension);
  EXPECT_EQ(one.last.energy.viscous, two.last.energy.viscous);
}

} // namespace
} // namespace plyform::relaxing_yarn_test
