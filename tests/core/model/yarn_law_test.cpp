// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/model/case.hpp"
#include "core/model/yarn_law.hpp"
#include "core/ply/membrane.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>

namespace plyform::yarn_law_test {
namespace {

/// A spring and a damper in a row, of one state: the stretch of the damper. A law that no file has.
struct MaxwellYarn {
  static constexpr int states = 1;
  static constexpr bool has_rates = true;
  double stiffness, time; ///< N, s

  static void start(double* state) { state[0] = 0.0; }
  LawAnswer at(const LawInput& in, const double* now, double* next) const {
    const double per_dt = in.per_process_dt;
    const double share = per_dt > 0.0 ? 1.0 / (1.0 + time * per_dt) : 0.0; // implicit
    const double gone = share * (in.strain - now[0]), left = in.strain - now[0] - gone;
    next[0] = now[0] + gone;
    return {stiffness * left, stiffness * (1.0 - share), 0.0, 0.5 * stiffness * left * left,
            stiffness * left * gone};
  }
  LawBound bound() const { return {stiffness, 0.0}; }
};
static_assert(YarnLaw<ViscousYarn> && YarnLaw<MaxwellYarn>);

/// Strain at step i of n: drawn, let go of to a half, drawn again.
double strain_at(int i, int n) {
  return 0.01 * (1.0 - 0.5 * std::cos(6.0 * M_PI * i / n)) - 0.005;
}

/// Work done on a law along the way, and what it says that it stores and has lost.
struct Balance {
  double work = 0.0, stored = 0.0, lost = 0.0;
};
template <YarnLaw Law>
Balance follow(const Law& law, int steps) {
  std::array<double, 2> now{}, next{};
  law.start(now.data());
  LawAnswer last = law.at({strain_at(0, steps), 0.0}, now.data(), next.data());
  now = next;
  Balance sum{0.0, -last.stored, 0.0};
  for (int i = 1; i <= steps; ++i) {
    const LawInput in{strain_at(i, steps), 1e3 * steps, 1e3 * steps};
    const LawAnswer answer = law.at(in, now.data(), next.data());
    const LawAnswer again = law.at(in, now.data(), next.data()); // no step
    EXPECT_EQ(answer.value, again.value);
    EXPECT_EQ(answer.lost, again.lost);
    sum.work += 0.5 * (last.value + answer.value) * (in.strain - strain_at(i - 1, steps));
    sum.lost += answer.lost;
    last = answer, now = next;
  }
  sum.stored += last.stored;
  return sum;
}

TEST(YarnLaw, WhatIsDoneOnAViscousYarnIsStoredOrLost) {
  TensionLaw elastic;
  elastic.stiffness = 460.0;
  const Balance sum = follow(ViscousYarn{elastic, 0.02}, 200);
  EXPECT_GT(sum.lost, 0.1 * sum.work);
  EXPECT_NEAR(sum.stored + sum.lost, sum.work, 1e-12 * sum.work); // the trapezoidal rule is exact
}

TEST(YarnLaw, AnotherLawWithAHistoryKeepsItsBalance) {
  const MaxwellYarn law{460.0, 2e-4};
  const auto error = [&](int steps) {
    const Balance sum = follow(law, steps);
    EXPECT_GT(sum.lost, 0.1 * sum.work);
    return std::abs(sum.stored + sum.lost - sum.work) / sum.work;
  };
  EXPECT_LT(error(4000), 0.005);
  EXPECT_LT(error(4000), 0.6 * error(2000)); // implicit: first order
}

TEST(YarnLaw, AnswersHaveTheirSlopeAndDamping) {
  TensionLaw elastic;
  elastic.strain = {0.0, 0.004, 0.02}, elastic.tension = {0.0, 1.0, 9.0};
  const ViscousYarn law{elastic, 0.02};
  const std::array<double, 2> now{1.002, 0.3};
  std::array<double, 2> next{};
  const double h = 1e-7, per_dt = 1e4;
  const auto tension = [&](double strain) {
    return law.at({strain, per_dt}, now.data(), next.data()).value;
  };
  const LawAnswer at = law.at({0.009, per_dt}, now.data(), next.data());
  EXPECT_NEAR((tension(0.009 + h) - tension(0.009 - h)) / (2.0 * h), at.slope + at.damping * per_dt,
              1e-4);
  EXPECT_EQ(law.at({-0.001, per_dt}, now.data(), next.data()).damping, 0.0); // slack
  EXPECT_EQ(next[1], 0.0);
  EXPECT_EQ(law.bound().slope, elastic.largest_slope());
}

/// N, tension of a yarn drawn to 1 % by a constant rate, simulated in so many seconds.
template <YarnLaw Law>
double tension_after(const Law& law, double simulated, double process) {
  constexpr int steps = 1000;
  Membrane membrane;
  Case data;
  data.solver.duration = simulated, data.process.duration = process;
  membrane.process_time = data.process_time();
  std::array<double, 2> now{}, next{};
  law.start(now.data());
  double tension = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const double per_dt = i > 0 ? steps / simulated : 0.0;
    tension = law.at(membrane.input(0.01 * i / steps, per_dt), now.data(), next.data()).value;
    now = next;
  }
  return tension;
}

TEST(YarnLaw, RatesAreThoseOfTheProcessWhateverIsSimulated) {
  const MaxwellYarn law{460.0, 2.0};
  const double slow = tension_after(law, 0.1, 10.0), fast = tension_after(law, 0.02, 10.0);
  EXPECT_NEAR(fast, slow, 1e-9 * slow);
  const double rate = 0.01 / 10.0; // k theta rate (1 - exp(-t / theta))
  EXPECT_NEAR(slow, 460.0 * 2.0 * rate * (1.0 - std::exp(-5.0)), 1e-3 * slow);
  EXPECT_GT(tension_after(law, 0.1, 1.0), 2.0 * slow);
}

TEST(YarnLaw, DampingOfTheSimulationDoesNotSeeTheProcess) {
  TensionLaw elastic;
  elastic.stiffness = 460.0;
  const ViscousYarn law{elastic, 0.02};
  EXPECT_EQ(tension_after(law, 0.1, 10.0), tension_after(law, 0.1, 1000.0));
  EXPECT_GT(tension_after(law, 0.001, 10.0), tension_after(law, 0.1, 10.0));
}

TEST(YarnLaw, SaysWhetherItHasRates) {
  Fabric woven = woven_fabric(), foil;
  foil.sheet = IsotropicLaw{};
  EXPECT_FALSE(has_rates(woven));
  EXPECT_FALSE(has_rates(foil));
  using Laws = std::variant<ViscousYarn, MaxwellYarn>;
  EXPECT_TRUE(has_rates(Laws(MaxwellYarn{1.0, 1.0})));
  EXPECT_FALSE(has_rates(Laws(ViscousYarn{woven.families[0].tension, 1.0})));
}

} // namespace
} // namespace plyform::yarn_law_test
