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
static_assert(YarnLaw<ViscousYarn> && YarnLaw<RelaxingYarn> && YarnLaw<MaxwellYarn>);

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
    EXPECT_EQ(answer.flowed, again.flowed);
    sum.work += 0.5 * (last.value + answer.value) * (in.strain - strain_at(i - 1, steps));
    sum.lost += answer.lost + answer.flowed;
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

/// N, of a relaxing yarn after each of some steps of a strain over time (s).
template <class Strain>
std::vector<double> relaxing(const RelaxingYarn& law, const Strain& strain, double end, int steps,
                             double time_factor = 1.0) {
  std::array<double, 2> now{}, next{};
  law.start(now.data());
  std::vector<double> tension;
  for (int i = 0; i <= steps; ++i) {
    LawInput in{strain(end * i / steps)};
    in.per_process_dt = i > 0 ? steps / end : 0.0, in.time_factor = time_factor;
    tension.push_back(law.at(in, now.data(), next.data()).value);
    now = next;
  }
  return tension;
}

/// A yarn of 400 N with a branch of 200 N and 5 s.
struct Relaxing {
  TensionLaw elastic;
  MaxwellBranch branch{200.0, 5.0};
  RelaxingYarn law{elastic, branch};
  Relaxing() { elastic.stiffness = 400.0, elastic.compression = 4.0; }
};

TEST(YarnLaw, ARelaxingYarnHasTheClosedFormOfARampAndAHold) {
  const Relaxing yarn;
  const double rate = 0.002, ramp = 5.0;
  const auto strain = [&](double t) { return rate * std::min(t, ramp); };
  for (const double factor : {1.0, 0.25}) {
    const double theta = factor * yarn.branch.time;
    const std::vector<double> n = relaxing(yarn.law, strain, 20.0, 400, factor);
    const auto exact = [&](double t) {
      const double s = std::min(t, ramp);
      const double q = yarn.branch.modulus * theta * rate * (1.0 - std::exp(-s / theta));
      return yarn.elastic.stiffness * strain(t) + q * std::exp(-(t - s) / theta);
    };
    for (const int i : {20, 100, 150, 400})
      EXPECT_NEAR(n[static_cast<std::size_t>(i)], exact(20.0 * i / 400), 1e-12) << factor;
  }
}

TEST(YarnLaw, ARelaxedYarnIsSlackWhenItIsLetGoOfAndGoesBackInItsTime) {
  const Relaxing yarn;
  const double held = 0.01;
  std::array<double, 2> now{}, next{};
  yarn.law.start(now.data());
  const auto go_on = [&](double to, double time) {
    LawInput in{to};
    in.per_process_dt = time > 0.0 ? 1.0 / time : 0.0;
    const LawAnswer answer = yarn.law.at(in, now.data(), next.data());
    now = next;
    return answer;
  };
  go_on(held, 0.0);
  EXPECT_NEAR(go_on(held, 100.0).value, 4.0, 1e-7); // relaxed: 400 * 0.01 N are left
  const double pressed = go_on(0.002, 0.0).value;   // at once: as long as (R) has none
  EXPECT_NEAR(pressed, -4.0 * (now[0] - 1.002), 1e-12);
  const double slack = now[0] - 1.0;
  EXPECT_NEAR(slack, 0.01 * 200.0 / 600.0, 1e-9); // 400 e + 200 (e - 0.01) = 0
  // q' + q/theta = k e' with 400 e + q = 0: e falls with the time theta (1 + 200/400)
  for (int i = 0; i < 1000; ++i)
    go_on(0.0, 0.015);
  EXPECT_NEAR(now[0] - 1.0, slack * std::exp(-15.0 / 7.5), 1e-4 * slack);
  EXPECT_NEAR(go_on(now[0] - 1.0 + 1e-3, 0.0).value, 600.0 * 1e-3,
              1e-9); // taut where it has come to
}

TEST(YarnLaw, WhatIsDoneOnARelaxingYarnIsStoredOrLost) {
  Relaxing yarn;
  yarn.elastic.stiffness = 0.0;
  yarn.elastic.strain = {0.0, 0.004, 0.02}, yarn.elastic.tension = {0.0, 1.0, 9.0};
  yarn.branch.time = 3e-4;
  const auto error = [&](int steps) {
    const Balance sum = follow(yarn.law, steps);
    EXPECT_GT(sum.lost, 0.05 * sum.work);
    return std::abs(sum.stored + sum.lost - sum.work) / sum.work;
  };
  EXPECT_LT(error(4000), 2e-3);
  EXPECT_LT(error(4000), 0.6 * error(1000));
}

TEST(YarnLaw, SaysWhetherItHasRates) {
  Fabric woven = woven_fabric(), foil, creeping = woven_fabric();
  foil.sheet = IsotropicLaw{};
  creeping.families[1].relaxation = MaxwellBranch{100.0, 1.0};
  EXPECT_TRUE(has_rates(creeping));
  EXPECT_FALSE(has_rates(woven));
  EXPECT_FALSE(has_rates(foil));
  using Laws = std::variant<ViscousYarn, MaxwellYarn>;
  EXPECT_TRUE(has_rates(Laws(MaxwellYarn{1.0, 1.0})));
  EXPECT_FALSE(has_rates(Laws(ViscousYarn{woven.families[0].tension, 1.0})));
}

} // namespace
} // namespace plyform::yarn_law_test
