// SPDX-License-Identifier: GPL-3.0-or-later
// Shear of a matrix that flows, relaxation after a stop and friction over the Hersey number, found
// again from curves made of known numbers with noise.
#include "core/identify/fit_pull_out.hpp"
#include "core/identify/fit_rates.hpp"
#include "core/identify/fit_relaxation.hpp"
#include "core/model/temperature.hpp"
#include "support/fit_curves.hpp"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace plyform::fit_rates_test {
namespace {

const std::vector<double> elastic{2.0, 1.5, 3.0}; // N mm
const std::vector<double> viscous{8.0, 30.0};     // N mm s
constexpr double energy = 45e3;                   // J/mol

double polynomial(const std::vector<double>& k, double g, int first) {
  double sum = 0.0;
  for (std::size_t i = 0; i < k.size(); ++i)
    sum += k[i] * std::pow(g, static_cast<double>(2 * i) + first);
  return sum;
}

/// 60 rows up to 45 degrees at a crosshead's speed (mm/s). power: of the rate.
RatedCurve rated_curve(const ShearTest& test, double speed, std::optional<double> temperature = {},
                       double power = 1.0,
                       const TemperatureFactor& flow = ArrheniusFactor{energy, 180.0}) {
  Curve curve{.file = fmt::format("{:g}.csv", speed),
              .x_name = "d",
              .y_name = "F",
              .x = {},
              .y = {},
              .line = {}};
  const Fabric fabric = glass_weave();
  const double factor = temperature ? flow.at(*temperature) : 1.0;
  for (int i = 0; i <= 60; ++i) {
    const double d = extension_at(test, 45.0 * degree) * i / 60.0;
    const TorqueWeights w = torque_weights(test, fabric, d);
    const double rate =
        speed * 2.0 * (1.0 + d / test.diagonal) / (test.diagonal * std::cos(w.angle));
    const auto torque = [&](double g, double r) {
      return polynomial(elastic, g, 1) + factor * polynomial(viscous, g, 0) * std::pow(r, power);
    };
    curve.x.push_back(d);
    curve.y.push_back(w.whole * torque(w.angle, rate) + w.half * torque(0.5 * w.angle, 0.5 * rate));
    curve.line.push_back(i + 1);
  }
  return {curve, speed, temperature};
}

struct RatesOutcome {
  std::optional<RatesFit> fit;
  std::string texts;
};

RatesOutcome found(const std::vector<RatedCurve>& curves, const ShearTest& test, int size = 0,
                   FlowForm form = FlowForm::none) {
  Diagnostics diagnostics;
  FitOptions options;
  options.corrections.compliance = 0.0;
  options.corrections.load_zero = options.corrections.toe = 0.0;
  RatesOutcome outcome;
  outcome.fit = identify_rates(curves, test, glass_weave(), options, {size, form}, diagnostics);
  outcome.texts = texts(diagnostics);
  return outcome;
}

const ShearTest frame = shear_test(FrameSpecimen{200.0}), bias = shear_test(BiasSpecimen{300, 100});

TEST(IdentifyRates, FindsElasticAndViscousTorqueOfExactCurvesOfBothTests) {
  for (const ShearTest& test : {frame, bias}) {
    const RatesOutcome o =
        found({rated_curve(test, 0.5), rated_curve(test, 5.0), rated_curve(test, 50.0)}, test);
    ASSERT_TRUE(o.fit) << o.texts;
    ASSERT_EQ(o.fit->viscous.size(), 2u) << o.fit->why;
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(o.fit->elastic[i], elastic[i], 1e-6);
    for (std::size_t i = 0; i < 2; ++i)
      EXPECT_NEAR(o.fit->viscous[i], viscous[i], 1e-6);
    EXPECT_EQ(o.fit->form, FlowForm::none);
    EXPECT_LT(o.fit->quality.rms, 1e-9);
    EXPECT_NEAR(o.fit->rates[1] / o.fit->rates[0],
                100.0 * std::sqrt(1.0 + std::sin(45.0 * degree)) / std::cos(45.0 * degree), 1e-6);
  }
}

TEST(IdentifyRates, FindsThemWithNoiseWithinItsLimits) {
  int inside = 0, all = 0;
  double worst_elastic = 0.0, worst_viscous = 0.0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::vector<RatedCurve> curves;
    for (const double speed : {0.5, 5.0, 50.0}) {
      curves.push_back(rated_curve(frame, speed));
      curves.back().curve = noisy_curve(curves.back().curve, 0.01, 0.0,
                                        10 * seed + static_cast<unsigned>(curves.size()));
    }
    const RatesOutcome o = found(curves, frame, 2);
    ASSERT_TRUE(o.fit) << o.texts;
    for (const double g : {10.0 * degree, 25.0 * degree, 45.0 * degree}) {
      worst_elastic =
          std::max(worst_elastic,
                   std::abs(polynomial(o.fit->elastic, g, 1) / polynomial(elastic, g, 1) - 1.0));
      worst_viscous =
          std::max(worst_viscous,
                   std::abs(polynomial(o.fit->viscous, g, 0) / polynomial(viscous, g, 0) - 1.0));
    }
    for (std::size_t i = 0; i < 2; ++i, ++all)
      inside += std::abs(o.fit->viscous[i] - viscous[i]) <= o.fit->viscous_limits[i];
  }
  fmt::print("noise of 1 %: elastic torque {:.3f}, viscosity {:.3f} at worst, {} of {} within "
             "limits\n",
             worst_elastic, worst_viscous, inside, all);
  EXPECT_LT(worst_elastic, 0.05);
  EXPECT_LT(worst_viscous, 0.02);
  EXPECT_GE(inside, all * 8 / 10);
}

TEST(IdentifyRates, FindsTheActivationEnergyOfSeveralTemperatures) {
  std::vector<RatedCurve> curves;
  for (const double t : {180.0, 200.0, 220.0})
    for (const double speed : {1.0, 10.0}) {
      curves.push_back(rated_curve(frame, speed, t));
      curves.back().curve =
          noisy_curve(curves.back().curve, 0.01, 0.0, static_cast<unsigned>(t + speed));
    }
  const RatesOutcome o = found(curves, frame);
  ASSERT_TRUE(o.fit) << o.texts;
  ASSERT_EQ(o.fit->form, FlowForm::arrhenius) << o.fit->flow_why;
  EXPECT_EQ(o.fit->reference, 180.0);
  EXPECT_NEAR(o.fit->flow[0], energy, 0.03 * energy);
  EXPECT_LT(std::abs(o.fit->flow[0] - energy), 2.0 * o.fit->flow_limits[0]);
  EXPECT_EQ(o.fit->temperatures, (std::array<double, 2>{180.0, 220.0}));
}

/// Tests of two speeds at some temperatures, the first of which is the reference.
std::vector<RatedCurve> warm_curves(const std::vector<double>& temperatures,
                                    const TemperatureFactor& flow, double noise, unsigned seed) {
  std::vector<RatedCurve> curves;
  for (const double t : temperatures)
    for (const double speed : {2.0, 50.0}) {
      curves.push_back(rated_curve(frame, speed, t, 1.0, flow));
      if (noise > 0.0) curves.back().curve = noisy_curve(curves.back().curve, noise, 0.0, seed++);
    }
  return curves;
}

constexpr double c1 = 4.0, c2 = 120.0; // -, K, at 150 degC
const TemperatureFactor wlf = WlfFactor{c1, c2, 150.0};

TEST(IdentifyRates, FindsWlfOfExactCurvesAndTellsWhatArrheniusLeaves) {
  const RatesOutcome o = found(warm_curves({150.0, 135.0, 170.0, 190.0}, wlf, 0.0, 0), frame);
  ASSERT_TRUE(o.fit) << o.texts;
  ASSERT_EQ(o.fit->form, FlowForm::wlf) << o.fit->flow_why;
  EXPECT_EQ(o.fit->reference, 150.0);
  EXPECT_NEAR(o.fit->flow[0], c1, 1e-4 * c1);
  EXPECT_NEAR(o.fit->flow[1], c2, 1e-4 * c2);
  ASSERT_EQ(o.fit->tried.size(), 3u);
  EXPECT_LT(o.fit->tried[0].rms, 1e-6); // each temperature by itself
  EXPECT_GT(o.fit->tried[1].rms, 0.01); // Arrhenius
  EXPECT_LT(o.fit->tried[2].rms, 1e-6); // WLF
  for (const FlowPoint& point : o.fit->factors)
    EXPECT_NEAR(point.factor / wlf.at(point.celsius), 1.0, 1e-5);
}

TEST(IdentifyRates, FindsWlfWithNoiseWithinItsLimits) {
  int inside = 0;
  double worst = 0.0, worst_c1 = 0.0, worst_c2 = 0.0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const RatesOutcome o =
        found(warm_curves({150.0, 135.0, 170.0, 190.0}, wlf, 0.01, 100 * seed), frame, 2);
    ASSERT_TRUE(o.fit) << o.texts;
    ASSERT_EQ(o.fit->form, FlowForm::wlf) << o.fit->flow_why;
    worst_c1 = std::max(worst_c1, std::abs(o.fit->flow[0] / c1 - 1.0));
    worst_c2 = std::max(worst_c2, std::abs(o.fit->flow[1] / c2 - 1.0));
    inside += std::abs(o.fit->flow[0] - c1) <= o.fit->flow_limits[0];
    inside += std::abs(o.fit->flow[1] - c2) <= o.fit->flow_limits[1];
    const TemperatureFactor law = WlfFactor{o.fit->flow[0], o.fit->flow[1], 150.0};
    for (const double t : {135.0, 142.0, 160.0, 170.0, 180.0, 190.0})
      worst = std::max(worst, std::abs(law.at(t) / wlf.at(t) - 1.0));
  }
  fmt::print("noise of 1 %: C1 {:.3f}, C2 {:.3f}, f {:.3f} at worst, {} of 40 within limits\n",
             worst_c1, worst_c2, worst, inside);
  EXPECT_LT(worst, 0.02);
  EXPECT_GE(inside, 32);
}

TEST(IdentifyRates, TakesTheFormOverTemperatureThatIsAskedFor) {
  const std::vector<RatedCurve> curves = warm_curves({150.0, 135.0, 170.0, 190.0}, wlf, 0.0, 0);
  const RatesOutcome table = found(curves, frame, 2, FlowForm::table);
  ASSERT_TRUE(table.fit) << table.texts;
  ASSERT_EQ(table.fit->factors.size(), 4u);
  EXPECT_EQ(table.fit->factors[0].celsius, 135.0);
  for (const FlowPoint& point : table.fit->factors)
    EXPECT_NEAR(point.factor / wlf.at(point.celsius), 1.0, 1e-5);
  const RatesOutcome arrhenius = found(curves, frame, 2, FlowForm::arrhenius);
  EXPECT_TRUE(!arrhenius.fit || arrhenius.fit->form == FlowForm::arrhenius) << arrhenius.texts;
  const RatesOutcome few = found(warm_curves({150.0, 180.0}, wlf, 0.0, 0), frame, 2, FlowForm::wlf);
  EXPECT_FALSE(few.fit);
  EXPECT_NE(few.texts.find("needs tests at 3 temperatures that are 3 K apart"), std::string::npos)
      << few.texts;
  const RatesOutcome two = found(warm_curves({150.0, 180.0}, wlf, 0.0, 0), frame, 2);
  ASSERT_TRUE(two.fit) << two.texts;
  EXPECT_EQ(two.fit->form, FlowForm::arrhenius);
}

TEST(IdentifyRates, RefusesWhatTellsNothingOfRates) {
  const RatesOutcome one = found({rated_curve(frame, 1.0), rated_curve(frame, 1.5)}, frame);
  EXPECT_FALSE(one.fit);
  EXPECT_NE(one.texts.find("must differ by a factor of 2"), std::string::npos) << one.texts;
  // speeds in the wrong order: the faster has the smaller load
  std::vector<RatedCurve> swapped{rated_curve(frame, 1.0), rated_curve(frame, 10.0)};
  std::swap(swapped[0].speed, swapped[1].speed);
  const RatesOutcome wrong = found(swapped, frame);
  EXPECT_FALSE(wrong.fit);
  EXPECT_NE(wrong.texts.find("comes out negative"), std::string::npos) << wrong.texts;
}

TEST(IdentifyRates, TellsOfATorqueThatDoesNotRiseInProportion) {
  const RatesOutcome o = found({rated_curve(frame, 0.5, {}, 0.6), rated_curve(frame, 5.0, {}, 0.6),
                                rated_curve(frame, 50.0, {}, 0.6)},
                               frame);
  EXPECT_NE(o.texts.find("does not rise in proportion to the rate"), std::string::npos) << o.texts;
  if (o.fit) {
    EXPECT_GT(o.fit->specimens[0].viscous_ratio, 1.5 * o.fit->specimens[2].viscous_ratio);
  }
}

// Relaxation.

constexpr double angle = 30.0 * degree, ramp = 2.0;
const std::vector<RelaxationBranch> branches{{6.0, 0.8}, {3.0, 25.0}}; // N mm, s

Curve relaxation_curve(double noise) {
  Curve curve{.file = "stop.csv", .x_name = "t", .y_name = "F", .x = {}, .y = {}, .line = {}};
  const Fabric fabric = glass_weave();
  const TorqueWeights w = torque_weights(frame, fabric, extension_at(frame, angle));
  for (int i = 0; i <= 120; ++i) {
    const double t = i == 0 ? 0.0 : 0.05 * std::pow(10.0, (i - 1) * 3.6 / 119.0);
    double torque = fabric.crossings[0].shear.at(angle).value;
    for (const RelaxationBranch& b : branches)
      torque += b.modulus * b.time * (1.0 - std::exp(-ramp / b.time)) * angle / ramp *
                std::exp(-t / b.time);
    curve.x.push_back(t), curve.y.push_back(w.whole * torque), curve.line.push_back(i + 1);
  }
  return noise > 0.0 ? noisy_curve(curve, noise, 0.0, 7) : curve;
}

TEST(IdentifyRelaxation, FindsTheBranchesAndTheRest) {
  for (const double noise : {0.0, 0.002}) {
    Diagnostics diagnostics;
    const auto fit = identify_relaxation(relaxation_curve(noise), {frame, angle, ramp},
                                         glass_weave(), diagnostics);
    ASSERT_TRUE(fit) << texts(diagnostics);
    ASSERT_EQ(fit->branches.size(), 2u);
    const double within = noise > 0.0 ? 0.05 : 1e-3;
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_NEAR(fit->branches[k].modulus / branches[k].modulus, 1.0, within);
      EXPECT_NEAR(fit->branches[k].time / branches[k].time, 1.0, within);
    }
    EXPECT_NEAR(fit->rest_torque / fit->elastic_torque, 1.0, within);
    EXPECT_LT(fit->quality.rms, 2.0 * noise + 1e-4);
  }
}

TEST(IdentifyRelaxation, TakesGivenTimes) {
  Diagnostics diagnostics;
  const auto fit = identify_relaxation(relaxation_curve(0.0), {frame, angle, ramp, {0.8, 25.0}},
                                       glass_weave(), diagnostics);
  ASSERT_TRUE(fit) << texts(diagnostics);
  ASSERT_EQ(fit->branches.size(), 2u);
  EXPECT_NEAR(fit->branches[0].modulus, 6.0, 1e-6);
  EXPECT_NEAR(fit->branches[1].modulus, 3.0, 1e-6);
}

TEST(IdentifyRelaxation, RefusesWhatIsNone) {
  const auto refused = [](Curve curve) {
    Diagnostics diagnostics;
    EXPECT_FALSE(
        identify_relaxation(std::move(curve), {frame, angle, ramp}, glass_weave(), diagnostics));
    return texts(diagnostics);
  };
  Curve rising = relaxation_curve(0.0);
  std::reverse(rising.y.begin(), rising.y.end());
  EXPECT_NE(refused(rising).find("the load does not fall"), std::string::npos);
  Curve back = relaxation_curve(0.0);
  back.x[4] = back.x[3];
  EXPECT_NE(refused(back).find("the time does not rise"), std::string::npos);
}

TEST(IdentifyRelaxation, SeesRowsOfTheRampAndTimeFromItsStart) {
  Curve late = relaxation_curve(0.0);
  late.x.erase(late.x.begin()), late.y.erase(late.y.begin()), late.line.erase(late.line.begin());
  for (double& t : late.x)
    t += ramp;
  Diagnostics told;
  EXPECT_TRUE(identify_relaxation(late, {frame, angle, ramp}, glass_weave(), told));
  EXPECT_NE(texts(told).find("take 2 s off all times"), std::string::npos) << texts(told);
  Curve whole = late; // ten rows of the ramp before
  for (int i = 9; i >= 0; --i) {
    whole.x.insert(whole.x.begin(), 0.19 * (i + 1));
    whole.y.insert(whole.y.begin(), 0.1 * (i + 0.5) * late.y.front());
    whole.line.push_back(static_cast<int>(whole.line.size()) + 2);
  }
  Diagnostics refused;
  EXPECT_FALSE(identify_relaxation(whole, {frame, angle, ramp}, glass_weave(), refused));
  EXPECT_NE(texts(refused).find("the rows before are of the ramp"), std::string::npos);
  Diagnostics none; // at once after the stop, with close rows
  EXPECT_TRUE(
      identify_relaxation(relaxation_curve(0.002), {frame, angle, ramp}, glass_weave(), none));
  EXPECT_EQ(texts(none).find("off all times"), std::string::npos);
}

// Pull-out.

/// 80 mm of pull with a peak at the start, at speeds, pressures and a viscosity of a melt.
std::vector<PullOutTest> pull_outs(double noise) {
  std::vector<PullOutTest> tests;
  for (const double speed : {0.2, 1.0, 5.0})
    for (const double pressure : {0.01, 0.05, 0.2}) {
      PullOutTest test{{.file = fmt::format("{:g}_{:g}.csv", speed, pressure),
                        .x_name = "d",
                        .y_name = "F",
                        .x = {},
                        .y = {},
                        .line = {}},
                       speed,
                       pressure,
                       400e-6};
      const double hersey = test.viscosity * speed / pressure;
      const double mu = 0.1 * std::exp(-hersey / 1e-3) + 1.1 * std::pow(hersey, 0.3);
      for (int i = 0; i <= 40; ++i) {
        test.curve.x.push_back(2.0 * i);
        test.curve.y.push_back(2.0 * 4000.0 * pressure * mu * (i < 3 ? 0.5 * i : 1.0));
        if (i == 2) test.curve.y.back() *= 1.4;
        test.curve.line.push_back(i + 1);
      }
      if (noise > 0.0)
        test.curve = noisy_curve(test.curve, noise, 0.0, static_cast<unsigned>(tests.size()));
      tests.push_back(std::move(test));
    }
  return tests;
}

TEST(IdentifyPullOut, FindsTheCurveOverTheHerseyNumber) {
  Diagnostics diagnostics;
  const auto fit = identify_pull_out(pull_outs(0.01), 4000.0, 20.0, 80.0, 0, diagnostics);
  ASSERT_TRUE(fit) << texts(diagnostics);
  EXPECT_GE(fit->hersey.size(), 2u);
  for (const PullOutPoint& point : fit->tests) {
    const double h = point.hersey;
    EXPECT_NEAR(point.friction, 0.1 * std::exp(-h / 1e-3) + 1.1 * std::pow(h, 0.3),
                0.01 * point.friction);
    EXPECT_NEAR(point.fitted, point.friction, 0.06 * point.friction) << h;
    EXPECT_NEAR(point.peak, 1.4, 0.05);
  }
  EXPECT_NEAR(fit->hersey.front(), 400e-6 * 0.2 / 0.2, 1e-9);
  EXPECT_NEAR(fit->hersey.back(), 400e-6 * 5.0 / 0.01, 1e-9);
}

TEST(IdentifyPullOut, OfAPowerLawTakesTwoPoints) {
  std::vector<PullOutTest> tests = pull_outs(0.0);
  for (PullOutTest& test : tests)
    for (double& y : test.curve.y)
      y = 2.0 * 4000.0 * test.pressure * 1.1 *
          std::pow(test.viscosity * test.speed / test.pressure, 0.3);
  Diagnostics diagnostics;
  const auto fit = identify_pull_out(tests, 4000.0, 20.0, 80.0, 0, diagnostics);
  ASSERT_TRUE(fit) << texts(diagnostics);
  ASSERT_EQ(fit->hersey.size(), 2u);
  EXPECT_NEAR(fit->friction[1] / fit->friction[0], std::pow(fit->hersey[1] / fit->hersey[0], 0.3),
              1e-9);
}

TEST(IdentifyPullOut, RefusesWhatIsNoCurve) {
  Diagnostics few, empty;
  std::vector<PullOutTest> tests = pull_outs(0.0);
  EXPECT_FALSE(identify_pull_out(tests, 4000.0, 200.0, 300.0, 0, empty));
  EXPECT_NE(texts(empty).find("rows between 200 and 300 mm"), std::string::npos) << texts(empty);
  tests.resize(2);
  EXPECT_FALSE(identify_pull_out(tests, 4000.0, 20.0, 80.0, 0, few));
  EXPECT_NE(texts(few).find("three tests"), std::string::npos) << texts(few);
}

} // namespace
} // namespace plyform::fit_rates_test
