// SPDX-License-Identifier: GPL-3.0-or-later
// Bands of the forces of tools.
#include "support/run_ends.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace plyform::verify_test {
namespace {

TEST(Bands, OfForcesAddUpWithTheirSigns) {
  VerifiedFigure f;
  f.force = true;
  f.mesh = 3.0, f.inertia = 4.0, f.softening = 0.0, f.chance = 0.0;
  EXPECT_NEAR(width_of_band(f).value(), safety * 7.0, 1e-12);
  f.inertia = -4.0; // what cancels may do so by accident
  EXPECT_NEAR(width_of_band(f).value(), safety * 5.0, 1e-12);
}

TEST(Bands, OfForcesTakeTheirOwnErrorAndThatOfAllOthers) {
  Case data;
  data.tools.resize(3);
  data.tools[2].motion = Motion::force; // a holder, pushed by 300 N
  for (Tool& tool : data.tools)
    tool.direction = -Vec3::UnitZ();
  const auto end = [&](double punch, double die) {
    RunEnd e = end_with(1, 30.0, 20.0, punch);
    e.last.tools.resize(3);
    e.last.tools[1].name = "die", e.last.tools[1].force_N = die;
    e.last.tools[2].name = "holder", e.last.tools[2].force_N = 300.0;
    for (ToolFrame& tool : e.last.tools)
      tool.force = tool.force_N * Vec3::UnitZ();
    e.balance_N = forces_by_balance(data, e.last);
    return e;
  };
  const RunEnd run = end(100.0, -400.0);
  EXPECT_NEAR(run.balance_N[0], 100.0, 1e-12); // in balance
  EXPECT_NEAR(run.balance_N[1], -400.0, 1e-12);
  EXPECT_NEAR(run.balance_N[2], 300.0, 1e-12);
  Siblings made;
  made.coarsening = 1.4;
  const auto figures = verified_figures(run, {{Cause::mesh, end(101.0, -407.0)}}, made, {});
  const double per_N = 1.0 / (std::pow(1.4, 1.6) - 1.0), both = per_N * std::sqrt(0.5 * (1 + 49));
  EXPECT_NEAR(named(figures, "force of punch").mesh.value(), both, 1e-9); // coarse: by 1, and by 7
  EXPECT_NEAR(named(figures, "force of die").mesh.value(), -both, 1e-9);
  EXPECT_NEAR(named(figures, "force of holder").mesh.value(), 0.0, 1e-12);
  data.boundaries.resize(1);
  EXPECT_TRUE(forces_by_balance(data, run.last).empty());
}

TEST(Bands, OfForcesThatBothRunsComparedHaveLostHaveNoPart) {
  Siblings made;
  made.coarsening = 1.4;
  const RunEnd run = end_with(1, 30.0, 20.0, 100.0);
  for (const double left :
       {0.0, 40.0}) { // N, of the faster stroke on the coarser mesh, and of more
    const Ends siblings{{Cause::inertia, end_with(1, 30.0, 20.0, left)},
                        {Cause::softening, end_with(1, 30.0, 20.0, 0.9 * left)},
                        {Cause::mesh, end_with(1, 30.0, 20.0, 95.0)}};
    const VerifiedFigure f = named(verified_figures(run, siblings, made, {}), "force of punch");
    EXPECT_EQ(f.softening.has_value(), left > 0.0) << left;
    EXPECT_TRUE(f.mesh.has_value());
  }
}

TEST(Bands, OfForcesAreNotBelowTheJitterOfAPushedTool) {
  Case data;
  data.tools.resize(2);
  data.tools[1].motion = Motion::force;
  data.tools[1].force = 300.0;
  RunEnd run = end_with(1, 30.0, 20.0, 100.0);
  run.last.tools.push_back({});
  run.last.tools[1].name = "holder", run.last.tools[1].force_N = 299.5;
  EXPECT_NEAR(force_jitter(data, run.last), 0.5, 1e-12);
  data.tools[1].programme = {{0.5, 100.0}, {1.0, 299.0}};
  run.jitter_N = force_jitter(data, run.last);
  EXPECT_NEAR(run.jitter_N, 0.5, 1e-12);
  VerifiedFigure f;
  f.force = true, f.jitter = run.jitter_N;
  f.mesh = f.inertia = f.softening = f.chance = 0.0;
  EXPECT_NEAR(width_of_band(f).value(), safety_of_jitter * 0.5, 1e-12);
}

/// The part of inertia in the force of a punch, 100 N, which is `fast` in half of the time, beside
/// another of -400 N that becomes `other`.
double inertia_of_punch(double fast, double other = -400.0) {
  Siblings made;
  made.softening = 0.0;
  const auto end = [](double punch, double die) {
    RunEnd e = end_with(1, 30.0, 20.0, punch);
    e.last.tools.resize(2);
    e.last.tools[1].name = "die", e.last.tools[1].force_N = die;
    return e;
  };
  return named(verified_figures(end(100.0, -400.0), {{Cause::inertia, end(fast, other)}}, made, {}),
               "force of punch")
      .inertia.value();
}

TEST(Bands, FindWhatAForceHasLostThatFallsWithTheCubeOfTheSpeedToNothing) {
  for (const double c : {0.001, 0.05, 0.3}) { // F = F0 exp(-c v^3), at v = 1 and 2
    const double whole = 100.0 * std::exp(c);
    EXPECT_NEAR(inertia_of_punch(whole * std::exp(-8.0 * c)), 100.0 - whole, 1e-9) << c;
  }
  EXPECT_NEAR(inertia_of_punch(100.7), 0.1, 1e-9); // more, not less: Richardson's
  EXPECT_EQ(inertia_of_punch(100.0), 0.0);
}

TEST(Bands, AreNoSurerOfAForceThatIsWhollyLostThanOfOneInProportionToTheSpeed) {
  for (const double fast : {0.1, 0.0, -5.0}) // q - 1 = 1
    EXPECT_NEAR(inertia_of_punch(fast), fast - 100.0, 1e-9) << fast;
  EXPECT_NEAR(inertia_of_punch(160.0), 60.0, 1e-9); // thrown against the punch
  double before = 0.0;
  for (double fast = 99.0; fast > -3.0; fast -= 1.0) { // no jump, and never less for a larger loss
    const double error = -inertia_of_punch(fast);
    EXPECT_GT(error, before) << fast;
    EXPECT_LT(error - before, 40.0) << fast;
    before = error;
  }
}

TEST(Bands, TakeTheLossOfOneForceForThatOfAll) {
  // the die has lost half of its force: what the punch has lost is extrapolated likewise
  const double factor = (std::pow(0.5, -1.0 / 7.0) - 1.0) / 0.5;
  EXPECT_NEAR(inertia_of_punch(90.0, -200.0), -10.0 * factor, 1e-9);
}

TEST(Bands, OfForcesAddUpSignsWithinOneEstimate) {
  VerifiedFigure f;
  f.force = true;
  f.mesh = 3.0, f.inertia = 3.0, f.softening = 0.0, f.chance = 0.0;
  f.estimates = {{3.0, -3.0, 0.0}, {3.0, 3.0, 0.0}}; // 0 and 6
  EXPECT_NEAR(width_of_band(f).value(), safety * std::sqrt(18.0), 1e-12);
  f.estimates = {{3.0, 3.0, 0.0}, {-3.0, -3.0, 0.0}}; // 6 and -6
  EXPECT_NEAR(width_of_band(f).value(), safety * 6.0, 1e-12);
}

} // namespace
} // namespace plyform::verify_test
