// SPDX-License-Identifier: GPL-3.0-or-later
// Plies act on each other and on nothing else: their contact forces cancel at every step, friction
// only takes energy, and the ledger is closed.
#include "core/solver/step.hpp"
#include "support/stress_scenes.hpp"
#include "support/thread_checks.hpp"

namespace plyform::momentum_test {
namespace {

/// Three plies at three angles, the middle one of finer mesh, pressed by a plate while a ball goes
/// down into them and the floor under them is driven away: all of them slide on each other.
Case sliding_case() {
  Case data = stack_of({0.0, 0.6, -0.3}, rectangle(100.0, 100.0, 12.5));
  data.blanks.push_back(rectangle(90.0, 90.0, 8.0));
  data.plies[1].blank = 1;
  press_by_plate(data);
  data.tools[0].shape = make_profile({{22.0, -60.0, 0.0}, {22.0, 0.0, 6.0}, {200.0, 0.0, 0.0}});
  data.tools[0].motion = Motion::driven;
  data.tools[0].direction = Vec3::UnitX();
  data.tools[0].stroke = 4.0;
  data.tools[1].shape = Annulus{25.0, 90.0, 10.0, 1.0};
  data.tools[1].position.z() = 3 * 0.6;
  Tool ball;
  ball.name = "ball";
  ball.shape = Sphere{15.0};
  ball.position = {1.0, -2.0, 3 * 0.6 + 15.0};
  ball.motion = Motion::driven;
  ball.stroke = 6.0;
  data.tools.push_back(ball);
  set_friction(data, 0.2);
  data.solver.mass_damping = 200.0; // 1/s
  return data;
}

/// Sum of forces (N) and of their moments (N mm) about the origin, and of their sizes.
struct Sums {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  double size = 0.0, lever = 0.0;
  void add(const std::vector<Vec3>& f, const std::vector<Vec3>& x) {
    for (std::size_t n = 0; n < f.size(); ++n) {
      force += f[n];
      moment += x[n].cross(f[n]);
      size += f[n].norm();
      lever += x[n].norm() * f[n].norm();
    }
  }
};

/// Of one pair of plies: what a does to b and b to a, on the nodes of both.
std::vector<Sums> ply_forces(const Scene& s) {
  std::vector<Sums> all;
  const auto add = [&](int a, const std::vector<Vec3>& on_a, int b, const std::vector<Vec3>& on_b) {
    Sums sums;
    sums.add(on_a, s.plies[a].x);
    sums.add(on_b, s.plies[b].x);
    all.push_back(sums);
  };
  for (const PlyPair& pair : s.ply_pairs)
    if (pair.loaded) add(pair.a, pair.force_a, pair.b, pair.force_b);
  return all;
}

/// Worst of a run's steps, each over the size of the same step.
struct Worst {
  double force = 0.0, moment = 0.0, friction_fell = 0.0, friction = 0.0, balance = 0.0;
  long steps = 0, with_forces = 0;
};

Worst follow(const Case& data) {
  Scene s = make_scene(data);
  ThreadPool pool(1);
  start(s, pool);
  Worst worst;
  for (;;) {
    const auto stop = compute_forces(s, pool);
    EXPECT_FALSE(stop) << stop->message;
    if (stop || s.time >= data.solver.duration) break;
    for (const Sums& sums : ply_forces(s)) {
      if (sums.size == 0.0) continue;
      ++worst.with_forces;
      worst.force = std::max(worst.force, sums.force.norm() / sums.size);
      worst.moment = std::max(worst.moment, sums.moment.norm() / sums.lever);
      EXPECT_TRUE(std::isfinite(sums.lever));
    }
    double friction = 0.0;
    each_pass(s, [&](const PlyContact& pass) { friction += pass.contact.sums.friction; });
    for (const ToolState& t : s.tools)
      for (const ToolPlyContact& c : t.contacts)
        friction += c.sums.friction;
    worst.friction_fell = std::max(worst.friction_fell, worst.friction - friction);
    worst.friction = friction;
    if (s.step % 100 == 0)
      worst.balance = std::max(worst.balance, imbalance(current_energies(s, pool)));
    ++worst.steps;
    move_plies(s, pool);
  }
  fmt::print("force {:.1e}, moment {:.1e}, friction {:.3g} N mm, fell {:.1e}, balance {:.1e}, "
             "{} steps\n",
             worst.force, worst.moment, worst.friction, worst.friction_fell, worst.balance,
             worst.steps);
  return worst;
}

/// At every step the forces of each pair and their moments sum to zero, whichever way the contact
/// looks.
TEST(MomentumScene, PlyForcesCancelAndFrictionOnlyTakes) {
  const Worst worst = follow(sliding_case());
  EXPECT_GT(10 * worst.with_forces, 19 * worst.steps); // both pairs at nearly every step
  EXPECT_LE(worst.force, 1e-10);
  EXPECT_LE(worst.moment, 1e-10);
  EXPECT_LE(worst.friction_fell, 1e-12 * worst.friction); // rounding of the sum
  EXPECT_GT(worst.friction, 10.0);                        // N mm
  EXPECT_LE(worst.balance, 0.01);
}

TEST(MomentumScene, IsTheSameOnAnyThreads) {
  const EndedRun run = run_on_any_threads([] { return make_scene(sliding_case()); });
  EXPECT_TRUE(ended(run.result.summary.status)) << run.result.summary.message;
}

} // namespace
} // namespace plyform::momentum_test
