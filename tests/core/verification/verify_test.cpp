// SPDX-License-Identifier: GPL-3.0-or-later
// Siblings of a case, and the bands that they give.
#include "core/setup/prepare_case.hpp"
#include "core/verification/bands.hpp"
#include "core/verification/verify.hpp"
#include "support/scene_checks.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace plyform::verify_test {
namespace {

Case shipped(const std::string& name, const std::vector<Override>& overrides = {}) {
  const PreparedCase reading = prepare_case(PLYFORM_CASES "/" + name + "/case.toml", overrides);
  EXPECT_TRUE(reading.value) << name;
  return reading.value.value_or(Case{});
}

std::vector<Cause> causes(const Siblings& siblings) {
  std::vector<Cause> all;
  for (const Sibling& sibling : siblings.runs)
    all.push_back(sibling.cause);
  return all;
}

TEST(Siblings, DifferFromAnotherRunInOneParameter) {
  const Case data = shipped("hemisphere_0");
  const Siblings siblings = siblings_of(data);
  ASSERT_EQ(causes(siblings),
            (std::vector{Cause::mesh, Cause::inertia, Cause::softening, Cause::chance}));
  EXPECT_EQ(siblings.coarsening, 1.4);
  const auto part = [&](int i) -> const Case& { return siblings.runs[i].data; };
  for (int i = 0; i < 4; ++i)
    EXPECT_DOUBLE_EQ(part(i).blanks[0].element_size, 1.4 * data.blanks[0].element_size);
  EXPECT_EQ(part(0).solver.duration, data.solver.duration);
  EXPECT_EQ(part(1).solver.duration, 0.5 * data.solver.duration);
  EXPECT_EQ(part(2).solver.duration, part(1).solver.duration);
  EXPECT_EQ(part(1).solver.fibre_softening, data.solver.fibre_softening);
  EXPECT_EQ(part(2).solver.fibre_softening, 2.0 * data.solver.fibre_softening);
  EXPECT_NEAR(part(3).plies[0].angle - data.plies[0].angle, 1e-6 * M_PI / 180.0, 1e-14);
}

TEST(Siblings, LeaveOutWhatWouldShowNothing) {
  // compression limits the softening of a stack of real cloth: twice as much changes nothing
  EXPECT_EQ(causes(siblings_of(shipped("hemisphere_five_ply"))),
            (std::vector{Cause::mesh, Cause::inertia, Cause::chance}));
  // 1.2 times as large, 11.9 mm, they would have 1.7 elements in a zone of 20 mm
  const Siblings coarse =
      siblings_of(shipped("hemisphere_five_ply", {{"blanks.square.element_size", "9.9"}}));
  EXPECT_EQ(causes(coarse), (std::vector{Cause::inertia, Cause::chance}));
  EXPECT_EQ(coarse.left_out.size(), 1u);
  EXPECT_EQ(coarse.coarsening, 1.0);
}

/// A run of `plies` flat plies with this shear everywhere and this force of the punch.
RunEnd end_with(int plies, double shear_deg, double draw_in, double force) {
  RunEnd end;
  for (int p = 0; p < plies; ++p) {
    PlyFrame ply;
    ply.name = "ply" + std::to_string(p + 1);
    ply.x0 = ply.x = {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}};
    ply.triangles = {{0, 1, 2}, {0, 2, 3}};
    ply.shear_deg = {shear_deg, shear_deg};
    end.last.plies.push_back(ply);
    PlyReport report;
    report.draw_in.yarns.fill(draw_in * (p + 1));
    report.draw_in.bisectors.fill(draw_in * (p + 1));
    end.plies.push_back(report);
  }
  ToolFrame punch;
  punch.name = "punch", punch.force_N = force;
  end.last.tools = {punch};
  return end;
}

const VerifiedFigure& named(const std::vector<VerifiedFigure>& all, const std::string& name) {
  for (const VerifiedFigure& f : all)
    if (f.name == name) return f;
  throw std::runtime_error("no figure " + name);
}

/// Ends of siblings whose figures are exact + a h^1.6 + b v^2 (the force: v^3) + c softening, in
/// units of the run's own element size, speed and softening.
std::map<Cause, RunEnd> of_known_orders(int plies, double a, double b, double c) {
  const auto at = [&](double h, double v, double s) {
    const double error = a * std::pow(h, 1.6) + b * v * v + c * s;
    return end_with(plies, 30.0 + error, 20.0 + error, 100.0 + error + b * v * v * (v - 1.0));
  };
  return {{Cause::mesh, at(1.4, 1, 1)},
          {Cause::inertia, at(1.4, 2, 1)},
          {Cause::softening, at(1.4, 2, 2)},
          {Cause::chance, at(1.4, 2, 1)}};
}

TEST(Bands, FindErrorsOfKnownOrders) {
  constexpr double a = 0.7, b = 0.3, c = 0.2;
  const RunEnd run = end_with(1, 30.0 + a + b + c, 20.0 + a + b + c, 100.0 + a + b + c);
  Siblings made;
  made.coarsening = 1.4;
  const auto figures = verified_figures(run, of_known_orders(1, a, b, c), made, {});
  ASSERT_EQ(figures.size(), 3u); // no yarns, no compression
  for (const VerifiedFigure& f : figures) {
    EXPECT_NEAR(f.mesh, a, 1e-9) << f.name;
    EXPECT_NEAR(f.inertia, b, 1e-9) << f.name;
    EXPECT_NEAR(f.softening, c, 1e-9) << f.name;
    EXPECT_EQ(f.chance, 0.0) << f.name;
  }
  const double all = std::sqrt(a * a + b * b + c * c);
  EXPECT_NEAR(named(figures, "shear of ply1").value, 31.2, 1e-9);
  EXPECT_NEAR(named(figures, "shear of ply1").band, safety * all, 1e-9);
  EXPECT_NEAR(named(figures, "force of punch").band, safety * (a + b + c), 1e-9);
}

TEST(Bands, OfForcesAddUpWithTheirSigns) {
  VerifiedFigure f;
  f.force = true;
  f.mesh = 3.0, f.inertia = 4.0;
  set_band(f);
  EXPECT_NEAR(f.band, safety * 7.0, 1e-12);
  f.inertia = -4.0; // what cancels may do so by accident
  set_band(f);
  EXPECT_NEAR(f.band, safety * 5.0, 1e-12);
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
  EXPECT_NEAR(named(figures, "force of punch").mesh, both, 1e-9); // coarse: by 1, and by 7
  EXPECT_NEAR(named(figures, "force of die").mesh, -both, 1e-9);
  EXPECT_NEAR(named(figures, "force of holder").mesh, 0.0, 1e-12);
  data.boundaries.resize(1);
  EXPECT_TRUE(forces_by_balance(data, run.last).empty());
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
  const auto figures = verified_figures(run, {}, {}, {});
  EXPECT_NEAR(named(figures, "force of punch").band, safety_of_jitter * 0.5, 1e-12);
}

TEST(Bands, OfPliesTakeTheMeanSquareOfTheirKind) {
  const RunEnd run = end_with(2, 30.0, 20.0, 100.0);
  Siblings made;
  made.coarsening = 1.4;
  const auto figures =
      verified_figures(run, {{Cause::mesh, end_with(2, 31.0, 21.0, 99.0)}}, made, {});
  const double expected = 1.0 / (std::pow(1.4, 1.6) - 1.0);
  EXPECT_NEAR(named(figures, "shear of ply2").mesh, expected, 1e-9);
  EXPECT_NEAR(named(figures, "force of punch").mesh, -expected, 1e-9); // too small
  // draw-ins of 1 and 2 mm apart: the mean square counts
  for (const char* name : {"draw-in of ply1", "draw-in of ply2"})
    EXPECT_NEAR(named(figures, name).mesh, expected * std::sqrt(2.5), 1e-9);
}

TEST(Bands, AreNotBelowWhatChanceDoes) {
  const RunEnd run = end_with(1, 30.0, 20.0, 100.0);
  Siblings made;
  made.coarsening = 1.0;
  const std::map<Cause, RunEnd> siblings{{Cause::inertia, run},
                                         {Cause::chance, end_with(1, 30.4, 20.0, 107.0)}};
  const auto figures = verified_figures(run, siblings, made, {0.7, 0.6, 0.5});
  EXPECT_NEAR(named(figures, "shear of ply1").mesh, 0.5, 1e-12);      // as predicted
  EXPECT_NEAR(named(figures, "shear of ply1").softening, 0.6, 1e-12); // likewise
  EXPECT_NEAR(named(figures, "force of punch").band, 14.0, 1e-9);
}

TEST(Verify, RunsTheSiblingsAndEndsWhenInterrupted) {
  Case data = coarse_hemisphere({0.0});
  data.tools[0].stroke = 20.0;
  data.solver.duration = 0.02;
  const RunResult run = run_case(data, 1, {});
  ASSERT_TRUE(ended(run.summary.status)) << run.summary.message;
  std::vector<std::string> begun;
  VerifyHooks hooks;
  hooks.begins = [&](const std::string& name, std::size_t, std::size_t) { begun.push_back(name); };
  const auto verification = verify(data, run, 1, hooks);
  ASSERT_TRUE(verification);
  EXPECT_EQ(begun.size(), siblings_of(data).runs.size());
  EXPECT_GT(verification->cost, 0.0);
  EXPECT_GE(verification->figures.size(), 5u); // shear, draw-in, punch, die, holder
  for (const VerifiedFigure& f : verification->figures)
    EXPECT_TRUE(std::isfinite(f.band) && f.band >= 0.0) << f.name;
  std::atomic<bool> interrupt{true};
  hooks.interrupt = &interrupt;
  EXPECT_FALSE(verify(data, run, 1, hooks));
}

} // namespace
} // namespace plyform::verify_test
