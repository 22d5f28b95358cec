// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes that leave over the other ply's rim and come back: the force is continuous, and nothing
// chatters.
#include "core/solver/step.hpp"
#include "support/stress_scenes.hpp"
#include "support/thread_checks.hpp"

namespace plyform::rim_test {
namespace {

/// A large coarse ply and a small fine one under a plate of 30 N, the small one gripped at its left
/// side, so that it goes out over the right rim of the large one. (Or the other way about: the
/// large one's coarse nodes go over the small one's rim.)
Case over_the_rim(bool fine_above, double stroke) {
  Case data = stack_of({0.0, 0.0}, rectangle(60.0, 60.0, 12.0));
  data.blanks.push_back(rectangle(50.0, 45.0, 5.0));
  data.plies[fine_above ? 1 : 0].blank = 1;
  press_by_plate(data);
  Boundary stays = hold("stays", {-30.0, -30.0}, {-24.0, 30.0}, Vec3::UnitX(), 0.0);
  Boundary goes = hold("goes", {-30.0, -30.0}, {-24.0, 30.0}, Vec3::UnitX(), stroke);
  stays.ply = 0;
  goes.ply = 1;
  stays.as<Grip>().held = goes.as<Grip>().held = {true, true, false};
  data.boundaries = {stays, goes};
  data.solver.mass_damping = 500.0; // 1/s
  data.solver.duration = 0.03;
  return data;
}

/// What one way out or back showed.
struct Way {
  double jump = 0.0;     ///< N, largest change of one node's contact force in one step
  double force = 0.0;    ///< N, largest of one node
  int most_changes = 0;  ///< of one node between touching the other ply and not, on the way
  int nodes_changed = 0; ///< that touched at some time and not at some other
};

/// Sum of what the other ply does to each node of ply 0, then of ply 1.
std::vector<Vec3> contact_forces(const Scene& s) {
  std::vector<Vec3> f[2] = {std::vector<Vec3>(s.plies[0].x.size(), Vec3::Zero()),
                            std::vector<Vec3>(s.plies[1].x.size(), Vec3::Zero())};
  for (const PlyPair& pair : s.ply_pairs) {
    if (pair.a == pair.b) continue; // a ply with itself
    for (std::size_t n = 0; n < f[pair.a].size(); ++n)
      f[pair.a][n] += pair.force_a[n];
    for (std::size_t n = 0; n < f[pair.b].size(); ++n)
      f[pair.b][n] += pair.force_b[n];
  }
  f[0].insert(f[0].end(), f[1].begin(), f[1].end());
  return f[0];
}

Way follow(Scene& s) {
  ThreadPool pool(1);
  start(s, pool);
  Way way;
  std::vector<Vec3> last;
  std::vector<int> changes;
  for (;;) {
    const auto stop = compute_forces(s, pool);
    EXPECT_FALSE(stop) << stop->message;
    if (stop || s.time >= s.data.solver.duration) break;
    const std::vector<Vec3> now = contact_forces(s);
    changes.resize(now.size(), 0);
    const bool pressed = s.time > 0.1 * s.data.solver.duration; // the plate has its force
    for (std::size_t n = 0; pressed && n < now.size() && !last.empty(); ++n) {
      const double jump = (now[n] - last[n]).norm();
      if (!(jump <= way.jump)) way.jump = jump; // NaN too
      way.force = std::max(way.force, now[n].norm());
      changes[n] += (now[n].norm() > 0.0) != (last[n].norm() > 0.0);
    }
    last = now;
    move_plies(s, pool);
  }
  for (const int c : changes) {
    way.most_changes = std::max(way.most_changes, c);
    way.nodes_changed += c > 0;
  }
  return way;
}

/// The end of `from` as the start of another run.
Scene continued(const Case& data, const Scene& from) {
  Scene s = make_scene(data);
  for (std::size_t p = 0; p < s.plies.size(); ++p) {
    s.plies[p].x = s.plies[p].x0 = s.plies[p].x_search = from.plies[p].x;
    s.plies[p].velocity = from.plies[p].velocity;
  }
  return s;
}

/// Out by 14 mm and home again by a second run from the first one's end: contact forces of each
/// node change by little from step to step, and no node flickers.
TEST(RimScene, NodesLeaveAndComeBackWithoutJumpOrChatter) {
  for (const bool fine_above : {true, false}) {
    Scene out = make_scene(over_the_rim(fine_above, 14.0));
    const Way there = follow(out);
    Scene back = continued(over_the_rim(fine_above, -14.0), out);
    const Way home = follow(back);
    for (const Way& w : {there, home}) {
      fmt::print("fine {}: largest nodal force {:.3g} N, jump {:.3g} N, {} nodes changed, {} times "
                 "at most\n",
                 fine_above ? "above" : "below", w.force, w.jump, w.nodes_changed, w.most_changes);
      EXPECT_GE(w.nodes_changed, 5);
      EXPECT_LE(w.jump, 0.05 * w.force); // of 2000 steps: the way takes 20 at the very least
      EXPECT_LE(w.most_changes, 10);     // neighbours take load over now and then
    }
    if (fine_above) continue;
    const EndedRun run =
        run_on_any_threads([&] { return continued(over_the_rim(false, -14.0), out); });
    EXPECT_TRUE(ended(run.result.summary.status)) << run.result.summary.message;
    EXPECT_EQ(run.result.summary.contact.intersections_between_plies, 0);
    EXPECT_LE(imbalance(run.result.last.energy), 0.01);
  }
}

} // namespace
} // namespace plyform::rim_test
