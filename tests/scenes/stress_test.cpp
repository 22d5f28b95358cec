// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of the stress table (stress_test.cpp) that take whole scenes: pulled, pressed together,
// plies of unlike meshes on each other.
#include "core/model/motion.hpp"
#include "core/solver/scene.hpp"
#include "support/stress_scenes.hpp"

namespace plyform::stress_test {
namespace {

TEST(Stress, PulledObliquelyEveryFabricKeepsItsLedger) {
  for (const NamedFabric& f : extreme_fabrics())
    for (const ElementKind element : {ElementKind::plain, ElementKind::averaged}) {
      Case data = stack_of({0.6}, rectangle(100.0, 40.0, 8.0, MeshKind::free));
      data.fabrics = {f.fabric};
      data.boundaries = {hold("left", {-50, -20}, {-50, 20}, Vec3::UnitX(), 0.0),
                         hold("right", {50, -20}, {50, 20}, Vec3(0.8, 0.36, 0.48), 8.0)};
      data.solver.element = element;
      data.solver.fibre_softening = 100.0;
      data.solver.duration = 0.02;
      set_friction(data, 0.0);
      const RunResult run = run_case(data, 1, {});
      const std::string what =
          f.name + (element == ElementKind::averaged ? ", averaged" : ", plain");
      EXPECT_TRUE(ended(run.summary.status)) << what << ": " << run.summary.message;
      EXPECT_LE(imbalance(run.last.energy), 0.01) << what;
      if (f.fabric.crossings[0].shear.k[0] == 0.0) {
        EXPECT_LT(std::abs(run.last.boundaries[1].force_N), 0.02) << what; // inertia
      }
      fmt::print("{}: load {:.4g} N, balance {:.1e}, {} steps, {:.2f} s\n", what,
                 run.last.boundaries[1].force_N, imbalance(run.last.energy), run.summary.steps,
                 run.summary.wall_time_s);
    }
}

/// Twice the area of a triangle in the plane z = 0, mm^2: negative when turned over.
double twice_area(const PlyFrame& ply, const Triangle& t) {
  const auto at = [&](std::size_t k) { return ply.x[t[k]]; };
  return (at(1) - at(0)).cross(at(2) - at(0)).z();
}

/// Strip of 100 x 20 mm along its warp, pushed together.
Case pressed_strip(double stroke, double duration, const Fabric& fabric) {
  Case data = stack_of({0.0}, rectangle(100.0, 20.0, 10.0));
  data.fabrics = {fabric};
  data.boundaries = {hold("left", {-50, -10}, {-50, 10}, Vec3::UnitX(), 0.0),
                     hold("right", {50, -10}, {50, 10}, -Vec3::UnitX(), stroke)};
  data.solver.fibre_softening = 100.0;
  data.solver.mass_damping = 1000.0; // 1/s
  data.solver.duration = duration;
  set_friction(data, 0.0);
  return data;
}

/// Final push (N) of a run that has to be done, with no triangle turned over.
double final_push(const Case& data) {
  const RunResult run = run_case(data, 1, {});
  EXPECT_TRUE(ended(run.summary.status)) << run.summary.message;
  EXPECT_LE(imbalance(run.last.energy), 0.01);
  const PlyFrame& ply = run.last.plies.at(0);
  double least = 1.0;
  for (std::size_t e = 0; e < ply.triangles.size(); ++e) {
    EXPECT_GT(twice_area(ply, ply.triangles[e]), 0.0) << e;
    least = std::min(least, 1.0 + ply.families[0].strain[e]);
  }
  fmt::print("push {:.5g} N, balance {:.1e}, least stretch {:.3g}\n",
             run.last.boundaries.at(1).force_N, imbalance(run.last.energy), least);
  return run.last.boundaries.at(1).force_N;
}

TEST(Stress, PressedYarnsGiveWayAndTheGuardHolds) {
  EXPECT_NEAR(final_push(pressed_strip(30.0, 0.1, glass_weave())), 0.0, 0.01);
  Fabric stiff = glass_weave();
  stiff.crossings[0].shear.k = {37.0}; // N mm: the strip does not buckle sideways
  // all of it at a stretch of 0.4: five yarns with the guard, 1e-3 of 46000 N, 0.1 below one half
  EXPECT_NEAR(final_push(pressed_strip(60.0, 0.1, stiff)), 5 * 46.0 * 0.1, 0.01 * 23.0);
  EXPECT_GT(final_push(pressed_strip(60.0, 0.1, glass_weave())), 0.0); // this one may
  const RunResult run = run_case(pressed_strip(95.0, 0.1, glass_weave()), 1, {});
  expect_collapse(run, "pushed to a twentieth");
}

TEST(Stress, PressedYarnsThatBearCompressionPushWithIt) {
  Fabric f = glass_weave();
  f.families[0].tension.compression = 460.0;
  f.crossings[0].shear.k = {37.0}; // N mm: no buckling sideways, n_c Cs' > d_1 N
  EXPECT_NEAR(final_push(pressed_strip(1.0, 0.1, f)), 5 * 460.0 * 0.01, 0.01 * 23.0);
  f.crossings[0].shear = glass_weave().crossings[0].shear;
  final_push(pressed_strip(20.0, 0.1, f)); // buckles; whatever it does, the ledger is closed
}

/// Two plies of 100 x 100 mm, cells of 20 mm and of 5 mm, between a floor and a plate of 30 N.
Case fine_and_coarse(bool fine_above) {
  Case data = stack_of({0.0, 0.0}, rectangle(100.0, 100.0, 20.0));
  data.blanks.push_back(rectangle(100.0, 100.0, 5.0));
  data.plies[fine_above ? 1 : 0].blank = 1;
  press_by_plate(data);
  return data;
}

TEST(Stress, FineAndCoarsePlyCarryThePressure) {
  for (const bool fine_above : {true, false}) {
    const Case data = fine_and_coarse(fine_above);
    const RunResult run = run_case(data, 1, {});
    ASSERT_TRUE(ended(run.summary.status)) << run.summary.message;
    EXPECT_LT(run.last.energy.kinetic, 1e-6); // N mm: at rest, so the plies pass the force on whole
    EXPECT_NEAR(run.last.tools[0].force.z(), -30.0, 0.02 * 30.0);
    EXPECT_EQ(run.summary.contact.intersections_between_plies, 0);
    for (const std::size_t p : {0, 1}) {
      const PlyFrame& ply = run.last.plies[p];
      double low = 1e9, high = 0.0;
      for (std::size_t n = 0; n < ply.x.size(); ++n) {
        if (ply.x0[n].head<2>().lpNorm<Eigen::Infinity>() > 31.0) continue;
        const double share = ply.contact_pressure[n] / (30.0 / 1e4);
        low = std::min(low, share);
        high = std::max(high, share);
      }
      const bool fine = (p == 1) == fine_above;
      fmt::print("{} ply: pressure {:.3f} to {:.3f}\n", fine ? "fine" : "coarse", low, high);
      EXPECT_GT(low, fine ? 0.90 : 0.98);
      EXPECT_LT(high, fine ? 2.0 : 1.02); // a fine node may bear a whole coarse one's force
    }
    // N/mm^3, each way
    const double k = make_scene(data).ply_pairs[0].passes[0].contact.law.stiffness;
    const double even = 30.0 / 1e4 / (2.0 * k), depth = run.summary.contact.max_ply_penetration_mm;
    fmt::print("floor {:.5f} N, deepest {:.4f} mm, {:.4f} if even\n", run.last.tools[0].force.z(),
               depth, even);
    EXPECT_LT(depth, 2.0 * even);
  }
}

TEST(Stress, FinePlyDrawnOverCoarseOneFeelsItsFriction) {
  for (const bool fine_above : {true, false}) {
    Case data = fine_and_coarse(fine_above);
    data.boundaries = {hold("left", {-50, -50}, {-50, 50}, Vec3::UnitX(), 0.0),
                       hold("right", {50, -50}, {50, 50}, Vec3::UnitX(), 4.0)};
    data.boundaries[0].ply = 0;
    data.boundaries[1].ply = 1;
    for (Boundary& b : data.boundaries)
      b.as<Grip>().held = {true, true, false};
    data.solver.mass_damping = 100.0;
    data.solver.duration = 0.06; // s: the shake of the pull's start has died down at 1 mm
    double least = 1e9, most = 0.0;
    RunHooks hooks;
    hooks.frame = [&](const Frame& f) {
      const BoundaryFrame& b = f.boundaries.at(1);
      if (b.stroke_mm < 1.0 || b.stroke_mm > 3.5) return; // slides
      // less what moves the ply's mass and overcomes its damping: 0.2 N
      const double mass = 6e-10 * 1e4, h = 1e-5; // t, s
      const auto at = [&](double t) { return smooth_step(4.0, t, data.solver.duration); };
      const double before = at(f.time - h), now = at(f.time), after = at(f.time + h);
      const double force = b.force_N - mass * ((after - 2.0 * now + before) / (h * h) +
                                               100.0 * (after - before) / (2.0 * h));
      least = std::min(least, force);
      most = std::max(most, force);
    };
    const RunResult run = run_case(data, 1, hooks);
    EXPECT_TRUE(ended(run.summary.status)) << run.summary.message;
    EXPECT_LE(imbalance(run.last.energy), 0.01);
    const double wanted = 2.0 * 0.2 * 30.0; // of the plate and of the other ply
    EXPECT_NEAR(least, wanted, 0.02 * wanted);
    EXPECT_NEAR(most, wanted, 0.02 * wanted);
    fmt::print("{:.3f} to {:.3f} N of {} N, penetration {:.2e} mm, {:.1f} s\n", least, most, wanted,
               run.summary.contact.max_ply_penetration_mm, run.summary.wall_time_s);
  }
}

} // namespace
} // namespace plyform::stress_test
