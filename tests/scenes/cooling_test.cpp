// SPDX-License-Identifier: GPL-3.0-or-later
// Plies that cool in air, half on a tool, and against each other, beside closed forms.
//
//   one lump   T = T_e + (T_0 - T_e) e^(-t/tau),  tau = rho_A c / sum h                        (L)
//   two lumps  their mean stays, their difference falls by e^(-h t (1/C_a + 1/C_b))             (D)
//   a stack    C dT_i/dt = h_i (T_i-1 - T_i) + h_i+1 (T_i+1 - T_i), whose ends are tools or the
//              air: by Runge and Kutta's rule in steps that take nothing                       (S)
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

/// Conductances from the bottom up, one more than plies, and temperatures (degC) at both ends.
struct StackEnds {
  std::vector<double> h;
  double below, above;
};

/// (S), degC, of plies that begin so, after t (s).
std::vector<double> stack_after(std::vector<double> celsius, const StackEnds& ends, double t) {
  constexpr int steps = 400;
  const auto rates = [&](const std::vector<double>& now) {
    std::vector<double> rate(now.size());
    for (std::size_t i = 0; i < now.size(); ++i) {
      const double below = i > 0 ? now[i - 1] : ends.below;
      const double above = i + 1 < now.size() ? now[i + 1] : ends.above;
      rate[i] = (ends.h[i] * (below - now[i]) + ends.h[i + 1] * (above - now[i])) / capacity;
    }
    return rate;
  };
  const auto moved = [](std::vector<double> from, const std::vector<double>& rate, double dt) {
    for (std::size_t i = 0; i < from.size(); ++i)
      from[i] += dt * rate[i];
    return from;
  };
  const double dt = t / steps;
  for (int i = 0; i < steps; ++i) {
    const auto a = rates(celsius), b = rates(moved(celsius, a, 0.5 * dt)),
               c = rates(moved(celsius, b, 0.5 * dt)), d = rates(moved(celsius, c, dt));
    for (std::size_t k = 0; k < celsius.size(); ++k)
      celsius[k] += dt / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]);
  }
  return celsius;
}

/// Plies between a cold floor and a warm plate, with these temperatures and conductances of tools
/// and plies, against (S), on two meshes and two durations.
void expect_stack(const std::vector<double>& from, double tools, double plies) {
  for (const double element : {10.0, 7.5})
    for (const double duration : {0.02, 0.01}) {
      Case data = hot_plies(from.size(), element);
      press_by_plate(data);
      data.solver.duration = duration;
      data.tools[0].temperature = {{0.0, 40.0}}, data.tools[1].temperature = {{0.0, 120.0}};
      data.process.cooling = Cooling{tools, plies, 0.0, {{0.0, room}}};
      for (std::size_t p = 0; p < from.size(); ++p)
        data.plies[p].temperature = from[p];
      StackEnds ends{std::vector<double>(from.size() + 1, plies), 40.0, 120.0};
      ends.h.front() = ends.h.back() = tools;
      double most = 0.0, error = 0.0;
      RunHooks hooks;
      hooks.frame = [&](const Frame& frame) {
        const std::vector<double> wanted =
            stack_after(from, ends, frame.time * data.process_time());
        for (std::size_t p = 0; p < from.size(); ++p)
          for (const double celsius : frame.plies[p].temperature) {
            most = std::max(most, std::abs(wanted[p] - from[p]));
            error = std::max(error, std::abs(celsius - wanted[p]));
          }
      };
      const RunResult run = run_case(data, 1, hooks);
      EXPECT_TRUE(ended(run.summary.status)) << run.summary.message;
      fmt::print("{} plies, tools {:g}, plies {:g}, elements of {:g} mm, {:g} s: {:.3f} of {:.1f} "
                 "K off\n",
                 from.size(), tools, plies, element, duration, error, most);
      EXPECT_LT(error, 0.01 * most);
    }
}

TEST(Cooling, OfTwoPliesBetweenPlatesIsTheirsAloneIfPlatesTakeNothing) {
  expect_stack({200.0, 100.0}, 0.0, 0.45);
}

TEST(Cooling, OfPliesThatGiveNothingToEachOtherIsToTheNextPlateAlone) {
  expect_stack({200.0, 100.0}, 0.3, 0.0);
}

TEST(Cooling, OfThreePliesGoesThroughTheMiddleOne) {
  expect_stack({200.0, 150.0, 100.0}, 0.3, 0.45);
  expect_stack({200.0, 150.0, 100.0}, 0.3, 0.0);
}

/// Heat (N mm) of a ply in a frame.
double heat_of(const PlyFrame& ply) {
  const std::vector<double> areas = areas_before(ply);
  double heat = 0.0;
  for (std::size_t e = 0; e < areas.size(); ++e)
    for (const std::int32_t n : ply.triangles[e])
      heat += areas[e] / 3.0 * capacity * ply.temperature[at(n)];
  return heat;
}

TEST(Cooling, OfASmallPlyOnALargeOneGoesThroughWhatItCovers) {
  constexpr double small = 36.0, cold = 90.0, share = 0.02; // mm, degC, of h t / C
  for (const double element : {10.0, 6.0})
    for (const double duration : {0.02, 0.01}) {
      Case data = hot_plies(2, element);
      data.blanks.push_back(rectangle(small, small, 6.0));
      data.plies[1].blank = 1;
      data.plies[1].temperature = cold;
      data.process.cooling->to_air = 0.0;
      data.process.duration = share * capacity / to_plies;
      data.solver.duration = duration;
      std::array<double, 2> before{}, after{};
      RunHooks hooks;
      hooks.frame = [&](const Frame& frame) {
        for (std::size_t p = 0; p < 2; ++p)
          (frame.step == 0 ? before : after)[p] = heat_of(frame.plies[p]);
      };
      const RunResult run = run_case(data, 1, hooks);
      EXPECT_TRUE(ended(run.summary.status)) << run.summary.message;
      const double wanted =
          small * small * capacity * 0.5 * (hot - cold) * (1.0 - std::exp(-2.0 * share));
      fmt::print("elements of {:g} mm, {:g} s: {:+.4f} from the large, {:+.4f} to the small one\n",
                 element, duration, (before[0] - after[0]) / wanted - 1.0,
                 (after[1] - before[1]) / wanted - 1.0);
      EXPECT_NEAR((before[0] - after[0]) / wanted, 1.0, 0.01);
      EXPECT_NEAR((after[1] - before[1]) / wanted, 1.0, 0.01);
    }
}

TEST(Cooling, UnderTheRimOfAPlyGoesToWhatLiesThere) {
  // a small ply on a large one, both in the air: what is covered gives to the ply, what is not to
  // the air
  Case data = hot_plies(2);
  data.blanks.push_back(rectangle(40.0, 40.0, 10.0));
  data.plies[1].blank = 1;
  data.plies[1].temperature = 90.0;
  data.process.duration = 2.0;
  const double far = 25.0, near = 15.0; // mm
  const StackEnds covered{{to_air, to_plies, to_air}, room, room};
  const double error =
      worst(data, [&](std::size_t p, const Vec3& x, double t) -> std::optional<double> {
        const double out = std::max(std::abs(x.x()), std::abs(x.y()));
        if (out < near) return stack_after({hot, 90.0}, covered, t)[p];
        if (p == 0 && out > far) return lump(hot, room, 2.0 * to_air, t);
        return std::nullopt; // under the rim
      });
  fmt::print("covered and not: {:.5f}\n", error);
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
