// SPDX-License-Identifier: GPL-3.0-or-later
// Boundaries and gravity in whole scenes: paths, forces, momentum, energy, symmetry.
#include "core/model/motion.hpp"
#include "core/run/run.hpp"
#include "core/solver/scene.hpp"
#include "core/solver/step.hpp"
#include "support/boundary_scenes.hpp"
#include "support/picture_frames.hpp"
#include "support/thread_checks.hpp"

#include <cstring>
#include <gtest/gtest.h>
#include <limits>

namespace plyform::boundary_test {
namespace {

constexpr double pi = std::numbers::pi;

Vec3 momentum(const PlyBody& ply) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t n = 0; n < ply.x.size(); ++n)
    sum += ply.membrane.node_mass[n] * ply.velocity[n];
  return sum;
}

double mass_of(const PlyBody& ply) {
  double sum = 0.0;
  for (const double m : ply.membrane.node_mass)
    sum += m;
  return sum;
}

/// The largest way of a held node from where its boundary has it, along what that one holds.
double largest_slip(const Scene& s) {
  double largest = 0.0;
  for (const PrescribedNode& held : s.held) {
    const PlyBody& ply = s.plies[held.ply];
    const auto n = static_cast<std::size_t>(held.node);
    for (std::size_t i = 0; i < static_cast<std::size_t>(held.count); ++i) {
      const Boundary& b = s.data.boundaries[held.boundary[i]];
      const double d = smooth_step(stroke_of(b), s.time, s.data.solver.duration);
      const double slip =
          std::abs(held.axis[i].dot(ply.x[n] - prescribed_position(b, ply.x0[n], d)));
      if (!(slip <= largest) && !std::isnan(largest)) largest = slip;
    }
  }
  return largest;
}

TEST(BoundaryScene, HeldNodesFollowTheirPathsAtEveryStep) {
  Case pulled = strip(0.4, Vec3(0.6, 0.0, 0.8), 3.0); // lifts the end as it pulls
  pulled.gravity = {100.0, -200.0, -9810.0};
  Case half = strip(0.4, Vec3::UnitY(), 3.0);
  half.boundaries[1].as<Grip>().held = {false, true, false}; // free to come nearer
  Case sheared = stack_of({0.2}, rectangle(100.0, 100.0, 25.0));
  sheared.boundaries = {square_frame(100.0, 30.0)};
  set_friction(sheared, 0.0);
  for (Case data : {pulled, half, sheared}) {
    data.solver.fibre_softening = 1000.0;
    data.solver.duration = 0.02;
    Scene s = make_scene(data);
    ThreadPool pool(1);
    start(s, pool);
    double slip = 0.0;
    while (s.time < data.solver.duration) {
      ASSERT_FALSE(compute_forces(s, pool));
      move_plies(s, pool);
      slip = std::max(slip, largest_slip(s));
      ASSERT_FALSE(std::isnan(largest_slip(s)));
    }
    EXPECT_LT(slip, 1e-9); // mm
    EXPECT_GT(s.step, 100);
    ASSERT_FALSE(compute_forces(s, pool));
    EXPECT_EQ(s.boundaries.back().displacement, stroke_of(data.boundaries.back()));
  }
}

TEST(BoundaryScene, HangingPlyPullsWithItsWeight) {
  Case data = strip(0.0, Vec3::UnitX(), 0.0);
  data.boundaries = {grip("top", {50, -10}, {50, 10}, Vec3(0.8, 0.0, 0.6), 0.0)};
  data.gravity = {-9810.0, 0.0, 0.0};
  data.solver.mass_damping = 4000.0; // 1/s; the slowest motion along the yarns has 7000 rad/s
  data.solver.duration = 0.02;
  const RunResult run = run_case(data, 1, {});
  ASSERT_TRUE(ended(run.summary.status)) << run.summary.message;
  const double weight = 6e-10 * 100.0 * 20.0 * 9810.0; // N
  const BoundaryFrame& top = run.last.boundaries.at(0);
  EXPECT_NEAR(top.force.x(), weight, 0.005 * weight);
  EXPECT_NEAR(top.force_N, 0.8 * weight, 0.005 * weight); // along its direction
  EXPECT_LE(top.force.tail<2>().norm(), 1e-4 * weight);   // one diagonal a cell: some shear, slow
  EXPECT_EQ(top.stroke_mm, 0.0);
  Vec3 sum = Vec3::Zero(); // the same, node by node
  for (std::size_t n = 0; n < run.last.plies[0].x.size(); ++n) {
    const Vec3& r = run.last.plies[0].reaction[n];
    EXPECT_EQ(r.isZero(0.0), run.last.plies[0].x0[n].x() < 49.0) << n; // held nodes only
    sum += run.last.plies[0].reaction[n];
  }
  EXPECT_LE((sum - top.force).norm(), 1e-12 * weight);
}

TEST(BoundaryScene, FreePlyFallsByGravityAlone) {
  Case data = stack_of({0.4}, rectangle(40.0, 40.0, 10.0));
  data.gravity = {0.0, 300.0, -9810.0};
  set_friction(data, 0.0);
  data.solver.duration = 0.01;
  data.solver.fibre_softening = 100.0;
  const RunResult run = run_case(data, 1, {});
  ASSERT_TRUE(ended(run.summary.status)) << run.summary.message;
  const PlyFrame& ply = run.last.plies[0];
  EXPECT_TRUE(ply.reaction.empty());
  EXPECT_TRUE(run.last.boundaries.empty());
  // Central differences from rest: x = g t^2/2 but for a half step, since v_(1/2) = g dt/2 is
  // exact.
  const Vec3 way = 0.5 * run.last.time * run.last.time * data.gravity;
  for (std::size_t n = 0; n < ply.x.size(); ++n)
    EXPECT_LE((ply.x[n] - ply.x0[n] - way).norm(), 1e-9 * way.norm());
  // The kinetic energy of the half steps about t: t^2 - dt^2/4 in the place of t^2.
  const Energies& e = run.last.energy;
  EXPECT_GT(e.external, 0.0);
  EXPECT_NEAR(e.kinetic, e.external,
              0.3 * std::pow(run.summary.max_step_s / run.last.time, 2) * e.external);
}

TEST(BoundaryScene, ImpulseOfReactionsAndGravityIsTheGainOfMomentum) {
  Case data = strip(0.4, Vec3(0.6, 0.0, 0.8), 3.0);
  data.boundaries[0].as<Grip>().held = {true, false, true};
  data.gravity = {0.0, 500.0, -9810.0};
  Scene s = make_scene(data);
  ThreadPool pool(1);
  start(s, pool);
  const PlyBody& ply = s.plies[0];
  Vec3 impulse = Vec3::Zero();
  double scale = 0.0;
  while (s.time < 0.6 * data.solver.duration) { // in the middle of the motion
    ASSERT_FALSE(compute_forces(s, pool));
    const double span = 0.5 * (s.dt + s.next_dt);
    Vec3 force = mass_of(ply) * data.gravity;
    for (const BoundaryState& b : s.boundaries)
      force += b.force;
    impulse += span * force;
    scale += span * force.norm();
    move_plies(s, pool);
  }
  const Vec3 gain = momentum(ply);
  EXPECT_GT(gain.norm(), 1e-3 * scale);
  EXPECT_LE((gain - impulse).norm(), 1e-11 * scale); // rounding of some 1000 steps
}

TEST(BoundaryScene, PullAlongTheYarnsClosesTheEnergyBalance) {
  for (const double mass_damping : {0.0, 200.0}) { // 1/s
    Case data = strip(0.0, Vec3::UnitX(), 0.5);
    data.gravity = {2000.0, 0.0, -9810.0};
    data.solver.mass_damping = mass_damping;
    const RunResult run = run_case(data, 1, {});
    ASSERT_TRUE(ended(run.summary.status)) << run.summary.message;
    const Energies& e = run.last.energy;
    // 115 N/mm times the width; 0.5 % strain
    EXPECT_NEAR(e.fibre, 0.5 * 115.0 * 20.0 * 100.0 * 0.005 * 0.005, 0.01 * e.fibre);
    EXPECT_GT(e.damping, 0.0);
    EXPECT_LE(std::abs(e.balance_error()), 1e-6) << mass_damping;
  }
}

TEST(BoundaryScene, StripAlongTheYarnsPullsWithItsStiffness) {
  const double strain = 0.001;
  for (const double angle : {0.0, 0.5 * pi}) {                           // along warp, along weft
    const double stiffness = (angle == 0.0 ? 46000.0 : 48000.0) / 100.0; // softened
    const RunResult run = run_case(strip(angle, Vec3::UnitX(), 100.0 * strain, 5.0), 1, {});
    ASSERT_TRUE(ended(run.summary.status)) << run.summary.message;
    const double wanted = 0.25 * 20.0 * stiffness * strain; // N
    const BoundaryFrame &left = run.last.boundaries.at(0), &right = run.last.boundaries.at(1);
    EXPECT_NEAR(right.force_N, wanted, 0.01 * wanted);
    EXPECT_NEAR(left.force_N, -wanted, 0.01 * wanted);
    EXPECT_NEAR(right.stroke_mm, 100.0 * strain, 1e-12);
    EXPECT_EQ(run.last.stroke_mm, right.stroke_mm); // of the boundary, where no tool is driven
  }
}

// ---- picture frame ----

TEST(BoundaryScene, PictureFrameHasTheLoadOfTheCellsAndNoStrain) {
  Case data = stack_of({0.0}, rectangle(frame_side, frame_side, 25.0));
  data.boundaries = {square_frame(frame_side, frame_stroke(frame_end))};
  set_friction(data, 0.0);
  data.solver.fibre_softening = 10000.0; // large steps; even so the yarns hardly stretch
  data.solver.duration = 40.0;           // s: no inertia
  std::vector<Frame> frames;
  RunHooks hooks;
  hooks.frame = [&](const Frame& f) { frames.push_back(f); };
  const RunResult run = run_case(data, 1, hooks);
  ASSERT_TRUE(ended(run.summary.status)) << run.summary.message;
  int judged = 0;
  for (const Frame& frame : frames) {
    const PlyFrame& ply = frame.plies[0];
    for (std::size_t e = 0; e < ply.triangles.size(); ++e) {
      EXPECT_LT(std::abs(ply.families[0].strain[e]), 1e-4);
      EXPECT_LT(std::abs(ply.families[1].strain[e]), 1e-4);
    }
    const double gamma = frame_angle_at(frame.boundaries.at(0).stroke_mm);
    if (gamma < 10.0 * pi / 180.0) continue;
    ++judged;
    EXPECT_NEAR(ply.shear_deg[0] * pi / 180.0, gamma, 1e-4);
    const double wanted =
        frame_load(data, gamma, data.fabrics[0].crossings[0].shear.at(gamma).value);
    EXPECT_NEAR(frame.boundaries[0].force_N, wanted, 0.005 * wanted) << gamma;
    for (std::size_t n = 0; n < ply.x.size(); ++n) {
      const bool across_x = std::abs(ply.x0[n].x()) > 49.0,
                 across_y = std::abs(ply.x0[n].y()) > 49.0;
      if (across_x == across_y) continue;                               // inside, or a hinge
      const Vec3& ending = ply.families[across_x ? 0 : 1].direction[0]; // uniform
      EXPECT_GT(ply.reaction[n].norm(), 1e-3);
      EXPECT_LE(std::abs(ply.reaction[n].dot(ending)), 1e-6 * ply.reaction[n].norm()) << gamma;
    }
  }
  EXPECT_GE(judged, 5);
}

// ---- symmetry ----

// ---- runs ----

TEST(BoundaryScene, GivesTheSameBitsForAnyNumberOfThreads) {
  Case data = pushed_square(0.0, MeshKind::alternating, true);
  data.blanks[0].element_size = 1.25; // several blocks of nodes and triangles
  data.boundaries.back().as<Grip>().direction = Vec3(0.0, 0.6, 0.8);
  data.boundaries.back().as<Grip>().stroke = 1.0;
  data.boundaries[2].as<Grip>().held = {true, false, true}; // not drawn apart in the corner
  data.boundaries[2].as<Grip>().place.ends[1].y() = 35.0;
  data.solver.duration = 1e-3;
  data.solver.fibre_softening = 1000.0;
  const RunResult one = run_case(data, 1, {});
  ASSERT_TRUE(ended(one.summary.status)) << one.summary.message;
  ASSERT_GT(one.last.plies[0].x.size(), 1000u);
  EXPECT_GT(one.last.boundaries.back().force.norm(), 0.0);
  const RunResult two = run_case(data, 2, {});
  EXPECT_TRUE(same_bits(one.last.plies[0].x, two.last.plies[0].x));
  EXPECT_TRUE(same_bits(one.last.plies[0].reaction, two.last.plies[0].reaction));
  for (std::size_t b = 0; b < one.last.boundaries.size(); ++b) {
    EXPECT_TRUE(same_bits({one.last.boundaries[b].force}, {two.last.boundaries[b].force}));
    EXPECT_EQ(one.last.boundaries[b].force_N, two.last.boundaries[b].force_N);
  }
  EXPECT_EQ(std::memcmp(&one.last.energy, &two.last.energy, sizeof(Energies)), 0);
}

TEST(BoundaryScene, StoppedRunGoesBackToBoundariesOfItsLastGoodState) {
  Case data = strip(0.4, Vec3::UnitX(), 20.0);
  data.solver.max_balance_error = 1e-13; // passed before long
  const RunResult run = run_case(data, 1, {});
  ASSERT_EQ(run.summary.status, "stopped");
  const PlyFrame& ply = run.last.plies[0];
  const BoundaryFrame& right = run.last.boundaries.at(1);
  ASSERT_GT(run.last.step, 0);
  Vec3 sum = Vec3::Zero();
  for (std::size_t n = 0; n < ply.x.size(); ++n) {
    if (ply.x0[n].x() < 49.0) continue;
    EXPECT_NEAR(ply.x[n].x() - ply.x0[n].x(), right.stroke_mm, 1e-9);
    sum += ply.reaction[n];
  }
  EXPECT_LE((sum - right.force).norm(), 1e-12 * right.force.norm());
}

} // namespace
} // namespace plyform::boundary_test
