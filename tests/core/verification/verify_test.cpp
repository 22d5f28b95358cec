// SPDX-License-Identifier: GPL-3.0-or-later
// Siblings of a case, and the bands that they give.
#include "core/setup/prepare_case.hpp"
#include "core/verification/bands.hpp"
#include "core/verification/verify.hpp"
#include "support/run_ends.hpp"
#include "support/scene_checks.hpp"

#include <algorithm>
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
  const Case data = shipped("hemisphere_0", {{"blanks.square.mesh_from", "element_size"},
                                             {"blanks.square.element_size", "6.8"}});
  const Siblings siblings = siblings_of(data);
  ASSERT_EQ(causes(siblings),
            (std::vector{Cause::mesh, Cause::inertia, Cause::softening, Cause::chance,
                         Cause::late_chance, Cause::later_chance}));
  EXPECT_EQ(siblings.coarsening, 1.4);
  const auto part = [&](int i) -> const Case& { return siblings.runs[i].data; };
  for (int i = 0; i < 4; ++i)
    EXPECT_DOUBLE_EQ(part(i).blanks[0].element_size, 1.4 * data.blanks[0].element_size);
  EXPECT_EQ(part(0).solver.duration, data.solver.duration);
  EXPECT_EQ(part(1).solver.duration, 0.5 * data.solver.duration);
  EXPECT_EQ(part(2).solver.duration, part(1).solver.duration);
  EXPECT_EQ(part(1).solver.fibre_softening, data.solver.fibre_softening);
  EXPECT_EQ(part(2).solver.fibre_softening, 2.0 * data.solver.fibre_softening);
  EXPECT_NEAR(part(3).plies[0].angle - data.plies[0].angle, 1e-3 * degree, 1e-14);
  for (int i = 4; i < 6; ++i) { // of the run itself
    EXPECT_EQ(part(i).blanks[0].element_size, data.blanks[0].element_size);
    EXPECT_EQ(part(i).solver.duration, data.solver.duration);
    EXPECT_GT(siblings.runs[i].from, 0.5);
    EXPECT_NEAR(siblings.runs[i].move.norm(), 1e-3 * data.blanks[0].element_size, 1e-9);
  }
}

TEST(Siblings, AreStifferWhereTwiceTheSofteningDoesNothing) {
  // compression limits the softening of a stack of real cloth: half of what acts shows its error
  const Case data = shipped("hemisphere_five_ply", {{"blanks.square.element_size", "6.8"}});
  const Siblings siblings = siblings_of(data);
  ASSERT_EQ(siblings.runs[2].cause, Cause::softening);
  EXPECT_LT(siblings.runs[2].data.solver.fibre_softening, 0.6 * data.solver.fibre_softening);
  EXPECT_NEAR(siblings.softening, -2.0, 1e-9);
  Case stiff = data;
  stiff.solver.fibre_softening = 1.0;
  EXPECT_EQ(siblings_of(stiff).softening, 0.0); // nothing is softened
}

/// Whether there is a sibling of the mesh, finer, against one as fast.
void expect_finer(const Siblings& siblings, double least) {
  ASSERT_EQ(siblings.runs[0].cause, Cause::inertia);
  ASSERT_EQ(siblings.runs[1].cause, Cause::mesh);
  EXPECT_LT(siblings.coarsening, 1.0);
  EXPECT_GT(siblings.coarsening, least);
  EXPECT_EQ(siblings.left_out.size(), 1u);
  const Sibling &fast = siblings.runs[0], &fine = siblings.runs[1];
  EXPECT_EQ(fast.data.solver.duration, fine.data.solver.duration);
  EXPECT_GT(fine.meshes[0].triangles.size(), fast.meshes[0].triangles.size());
}

TEST(Siblings, HaveAFinerMeshWhereNoneCanBeCoarser) {
  // bending: 1.2 times as large, 11.9 mm, they would have 1.7 elements in a zone of 20 mm
  expect_finer(siblings_of(shipped("hemisphere_five_ply", {{"blanks.square.element_size", "9.9"}})),
               0.7);
  // a rim of 2 mm, rounder than elements of 6.8 mm
  const PreparedCase rim =
      prepare_case(PLYFORM_CASES "/verify/hemisphere_small.toml", {{"tool.2.edge_radius", "2"}});
  expect_finer(siblings_of(*rim.value), 0.7);
  const PreparedCase file = prepare_case(PLYFORM_CASES "/verify/slipping_corner.toml", {});
  const Siblings of_file = siblings_of(*file.value, file.meshes);
  expect_finer(of_file, 0.49);
  const double before = static_cast<double>(file.meshes[0].triangles.size());
  EXPECT_NEAR(of_file.coarsening,
              std::sqrt(before / static_cast<double>(of_file.runs[1].meshes[0].triangles.size())),
              1e-12);
}

TEST(Siblings, MayBeCoarserWhereBoundariesHoldAsMuch) {
  const Override grip{"boundary", "[{name='west', kind='grip', edge=[[-68, -68], [-68, 68]]}]"};
  const PreparedCase edge = prepare_case(PLYFORM_CASES "/verify/hemisphere_small.toml", {grip});
  ASSERT_TRUE(edge.value);
  EXPECT_GT(siblings_of(*edge.value).coarsening, 1.0);
}

/// Ends of siblings whose figures are exact + a h^1.6 + b v^2 (the force: v^3) + c softening, in
/// units of the run's own element size, speed and softening.
Ends of_known_orders(int plies, double a, double b, double c) {
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
    EXPECT_NEAR(f.mesh.value(), a, 1e-9) << f.name;
    EXPECT_NEAR(f.inertia.value(), b, 1e-9) << f.name;
    EXPECT_NEAR(f.softening.value(), c, 1e-9) << f.name;
    EXPECT_EQ(f.chance.value(), 0.0) << f.name;
  }
  const double all = std::sqrt(a * a + b * b + c * c);
  EXPECT_NEAR(named(figures, "shear of ply1").value, 31.2, 1e-9);
  EXPECT_NEAR(named(figures, "shear of ply1").band.value(), safety * all, 1e-9);
  EXPECT_NEAR(named(figures, "force of punch").band.value(), safety * (a + b + c), 1e-9);
}

TEST(Bands, OfPliesTakeTheMeanSquareOfTheirKind) {
  const RunEnd run = end_with(2, 30.0, 20.0, 100.0);
  Siblings made;
  made.coarsening = 1.4;
  const auto figures =
      verified_figures(run, {{Cause::mesh, end_with(2, 31.0, 21.0, 99.0)}}, made, {});
  const double expected = 1.0 / (std::pow(1.4, 1.6) - 1.0);
  EXPECT_NEAR(named(figures, "shear of ply2").mesh.value(), expected, 1e-9);
  EXPECT_NEAR(named(figures, "force of punch").mesh.value(), -expected, 1e-9); // too small
  // draw-ins of 1 and 2 mm apart: the mean square counts
  for (const char* name : {"draw-in of ply1", "draw-in of ply2"})
    EXPECT_NEAR(named(figures, name).mesh.value(), expected * std::sqrt(2.5), 1e-9);
}

TEST(Bands, AreNotBelowWhatChanceDoes) {
  Siblings made;
  made.coarsening = 1.4;
  const RunEnd run = end_with(1, 30.0, 20.0, 100.0);
  const Ends siblings{
      {Cause::mesh, run},        {Cause::inertia, run},
      {Cause::softening, run},   {Cause::chance, end_with(1, 30.4, 20.0, 100.1)},
      {Cause::late_chance, run}, {Cause::later_chance, end_with(1, 30.0, 20.0, 107.0)}};
  const auto figures = verified_figures(run, siblings, made, {});
  EXPECT_NEAR(named(figures, "shear of ply1").band.value(), 0.8, 1e-9);
  EXPECT_NEAR(named(figures, "force of punch").band.value(), 14.0, 1e-9); // the largest of all
}

TEST(Bands, OfWhatWasNotMeasuredAreNone) {
  const RunEnd run = end_with(1, 30.0, 20.0, 100.0);
  Siblings made;
  made.coarsening = 1.4; // whose coarser sibling was stopped: nothing to hold the faster against
  const Ends siblings{{Cause::inertia, end_with(1, 31.0, 20.0, 90.0)},
                      {Cause::softening, end_with(1, 31.0, 20.0, 90.0)},
                      {Cause::chance, end_with(1, 31.0, 20.0, 90.0)}};
  const auto figures = verified_figures(run, siblings, made, {0.7, 0.6, 0.5});
  for (const char* name : {"draw-in of ply1", "force of punch"}) {
    EXPECT_FALSE(named(figures, name).band) << name;
    EXPECT_EQ(unmeasured(named(figures, name)), (std::vector<std::string>{"mesh", "inertia"}));
  }
  EXPECT_EQ(named(figures, "shear of ply1").mesh, 0.5); // as predicted
  EXPECT_FALSE(named(figures, "shear of ply1").band);
}

TEST(Bands, TakeTheMeshFromAFinerSibling) {
  constexpr double a = 0.7, b = 0.05;
  Siblings made;
  made.coarsening = 0.7, made.speed = 3.0, made.softening = 0.0;
  const auto at = [&](double h, double v) {
    return end_with(1, 30.0 + a * std::pow(h, 1.6) + b * v * v, 20.0,
                    100.0 + a * std::pow(h, 1.6) + b * v * v * v);
  };
  const Ends siblings{{Cause::inertia, at(1.0, 3.0)},
                      {Cause::mesh, at(0.7, 3.0)},
                      {Cause::late_chance, at(1.0, 1.0)}};
  for (const VerifiedFigure& f : verified_figures(at(1.0, 1.0), siblings, made, {}))
    if (f.unit != "mm") {
      const double r = std::pow(0.7, 1.6); // of fields half alike: bands.hpp
      const double alike = f.force ? 1.0 : std::sqrt((1.0 - r) / std::hypot(1.0, r));
      EXPECT_NEAR(f.mesh.value(), alike * a, 1e-9) << f.name;
      EXPECT_NEAR(f.inertia.value(), b, 1e-9) << f.name;
      EXPECT_EQ(f.softening.value(), 0.0) << f.name;
      EXPECT_TRUE(f.band) << f.name;
    }
}

TEST(Bands, TakeNoOrderOfTheSpeedWherePliesFly) {
  Siblings made;
  made.softening = 0.0;
  RunEnd run = end_with(1, 30.0, 20.0, 100.0);
  const auto inertia_of = [&](const RunEnd& fast, const char* name) {
    return named(verified_figures(run, {{Cause::inertia, fast}}, made, {}), name).inertia.value();
  };
  EXPECT_NEAR(inertia_of(end_with(1, 36.0, 20.0, 93.0), "shear of ply1"), 2.0, 1e-9);
  RunEnd flying = end_with(1, 36.0, 20.0, 93.0);
  flying.flies = true;
  EXPECT_NEAR(inertia_of(flying, "force of punch"), -7.0, 1e-9);
  run.flies = true;
  EXPECT_NEAR(inertia_of(end_with(1, 36.0, 20.0, 93.0), "shear of ply1"), 6.0, 1e-9);
  // of the run itself all may be lost already: it and a faster one agree, and both are wrong
  const Ends fast{{Cause::inertia, end_with(1, 36.0, 20.0, 99.0)}};
  EXPECT_FALSE(named(verified_figures(run, fast, made, {}), "force of punch").inertia);
  EXPECT_FALSE(named(verified_figures(run, fast, made, {}), "draw-in of ply1").inertia);
}

TEST(Verify, RunsTheSiblingsAndEndsWhenInterrupted) {
  Case data = coarse_hemisphere({0.0});
  data.tools[0].stroke = 20.0;
  data.solver.duration = 0.06; // in 0.02 s the ply flies
  Trace trace;
  RunHooks run_hooks;
  watch(run_hooks, trace, true);
  const RunResult run = run_case(data, 1, run_hooks);
  ASSERT_TRUE(ended(run.summary.status)) << run.summary.message;
  std::vector<std::string> begun;
  VerifyHooks hooks;
  hooks.begins = [&](const std::string& name, std::size_t, std::size_t) { begun.push_back(name); };
  std::vector<double> done{0.0}; // of the work of all
  hooks.progress = [&](const Progress&, double fraction) { done.push_back(fraction); };
  const auto verification = verify(data, run, trace, 1, hooks);
  ASSERT_TRUE(verification);
  EXPECT_TRUE(std::is_sorted(done.begin(), done.end()));
  EXPECT_TRUE(std::any_of(done.begin(), done.end(), [](double f) { return f > 0.1 && f < 0.7; }));
  EXPECT_GT(done.back(), 0.8); // unless there was no time for the last one
  EXPECT_LE(done.back(), 1.0);
  EXPECT_GE(begun.size(), siblings_of(data).runs.size() - 1); // the last if there is time
  EXPECT_GT(verification->cost, 0.0);
  EXPECT_LE(verification->work, 1.5);
  EXPECT_FALSE(run.summary.flies);
  EXPECT_GE(verification->figures.size(), 5u); // shear, draw-in, punch, die, holder
  std::size_t banded = 0;
  for (const VerifiedFigure& f : verification->figures) {
    EXPECT_NE(f.band.has_value(), !f.no_band.empty()) << f.name;
    if (!f.band) continue;
    ++banded;
    EXPECT_TRUE(*f.band >= 0.0 && *f.band <= std::abs(f.value)) << f.name;
    EXPECT_TRUE(unmeasured(f).empty()) << f.name;
  }
  EXPECT_GE(banded, 4u); // shear, draw-in, punch, die; the holder's force is given
  EXPECT_EQ(named(verification->figures, "force of " + data.tools[2].name).no_band.substr(0, 5),
            "given");
  std::atomic<bool> interrupt{true};
  hooks.interrupt = &interrupt;
  EXPECT_FALSE(verify(data, run, trace, 1, hooks));
}

TEST(Trace, OfARunIsWhereItsPliesWereAndDoesNotChangeIt) {
  Case data = coarse_hemisphere({0.0});
  data.tools[0].stroke = 10.0;
  data.solver.duration = 0.01;
  Trace trace;
  RunHooks hooks;
  watch(hooks, trace, true);
  const RunResult watched = run_case(data, 1, hooks), alone = run_case(data, 1, {});
  EXPECT_EQ(watched.last.plies[0].x, alone.last.plies[0].x);
  ASSERT_EQ(trace.size(), static_cast<std::size_t>(trace_marks));
  for (std::size_t i = 0; i < trace.size(); ++i) {
    ASSERT_EQ(trace[i].x.size(), 1u) << i;
    EXPECT_GE(trace[i].time, data.solver.duration * static_cast<double>(i + 1) / 20.0 - 1e-12);
  }
  EXPECT_FALSE(moment_at(trace, 0.6)->state.empty());
  // a run that goes on from there ends in the same place
  Resume resume{moment_at(trace, 0.6)->state, watched.last};
  resume.last.step = moment_at(trace, 0.6)->step;
  RunHooks on;
  on.resume = &resume;
  EXPECT_EQ(run_case(data, 1, on).last.plies[0].x, watched.last.plies[0].x);
}

TEST(Trace, TellsWhereTwinsPart) {
  RunEnd one = end_with(2, 30.0, 20.0, 100.0), other = end_with(2, 30.0, 20.0, 100.0);
  other.last.plies[1].shear_deg = {32.0, 32.0};
  Trace a(3), b(3);
  for (std::size_t i = 0; i < 3; ++i) {
    a[i].time = b[i].time = 0.1 * static_cast<double>(i + 1), a[i].stroke_mm = 10.0 * a[i].time;
    a[i].x = b[i].x = {one.last.plies[0].x, one.last.plies[1].x};
  }
  EXPECT_FALSE(parting_of(a, one.last, b, one.last));
  b[1].x[1][2].x() += 1.1, b[2].x[0][0].x() += 5.0; // a tenth of an element: 1 mm
  const auto parting = parting_of(a, one.last, b, other.last);
  ASSERT_TRUE(parting);
  EXPECT_EQ(parting->ply, "ply2");
  EXPECT_NEAR(parting->time_s, 0.2, 1e-12);
  EXPECT_NEAR(parting->apart_mm, 1.1, 1e-12);
  EXPECT_EQ(parting->at_mm, a[1].x[1][2]);
  EXPECT_NEAR(parting->shear_deg, 2.0, 1e-9);
}

} // namespace
} // namespace plyform::verify_test
