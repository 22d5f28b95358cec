// SPDX-License-Identifier: GPL-3.0-or-later
// The laws know no place and no direction: a scene carried elsewhere and turned forms the same way.
#include "support/stress_scenes.hpp"
#include "support/thread_checks.hpp"

namespace plyform::moved_test {
namespace {

/// x -> turn x + way (mm).
struct Placement {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Vec3 way = Vec3::Zero();
};

/// Everything that has a place or a direction, carried along. Boundaries hold along x, y and z, so
/// only those that hold all three can be: their axes then do not matter.
void carry(Scene& s, const Placement& to) {
  for (PlyBody& ply : s.plies) {
    for (std::vector<Vec3>* x : {&ply.x0, &ply.x, &ply.x_search})
      for (Vec3& p : *x)
        p = to.turn * p + to.way;
    for (Vec3& v : ply.velocity)
      v = to.turn * v;
  }
  for (ToolState& t : s.tools) {
    t.body.position = to.turn * t.body.position + to.way;
    t.body.rotation = to.turn * t.body.rotation;
    t.body.direction = to.turn * t.body.direction;
  }
  for (Boundary& b : s.data.boundaries)
    b.as<Grip>().direction = to.turn * b.as<Grip>().direction;
  s.data.gravity = to.turn * s.data.gravity;
}

/// Two plies on a floor that is driven 3 mm along x, the upper one held at its left side, a plate
/// of 30 N on both, friction everywhere: floor and lower ply slide under the upper one. Gravity, of
/// ten times the earth's, goes along no axis. Bending stiffness, since limp sheets buckle from
/// rounding, too.
Case busy_case() {
  Case data = stack_of({0.0, 0.35}, rectangle(100.0, 100.0, 10.0));
  data.fabrics[0].families[0].bending.stiffness = data.fabrics[0].families[1].bending.stiffness =
      20.0; // N mm
  data.fabrics[0].twist = 5.0;
  press_by_plate(data);
  data.tools[0].motion = Motion::driven;
  data.tools[0].direction = Vec3::UnitX();
  data.tools[0].stroke = 3.0;
  data.boundaries = {hold("grip", {-50.0, -50.0}, {-50.0, 50.0}, Vec3::UnitX(), 0.0)};
  data.boundaries[0].ply = 1;
  data.gravity = {2e4, -3e4, -1e5};  // mm/s^2
  data.solver.mass_damping = 2000.0; // 1/s
  return data;
}

/// Any turn and 10 m: the same to 4e-6 mm. Coordinates of 1e4 mm have a rounding of 2e-12 mm, which
/// 2 500 steps of plies that slide on each other with friction make larger by some 1e6 (5e4 to 7e5
/// seen), but no more: forces of contact are continuous, though all nodes start just touching.
TEST(MovedScene, FormsTheSameWay) {
  const Case data = busy_case();
  const EndedRun here = run_on_any_threads([&] { return make_scene(data); });
  ASSERT_TRUE(ended(here.result.summary.status)) << here.result.summary.message;
  EXPECT_GT(here.result.last.energy.friction, 1.0); // N mm: it does slide
  Random random(7);
  for (const double far : {0.0, 1e4}) {
    Placement to{random_rotation(random), far * random_vector(random).normalized()};
    const EndedRun there = run_on_any_threads([&] {
      Scene s = make_scene(data);
      carry(s, to);
      return s;
    });
    ASSERT_TRUE(ended(there.result.summary.status)) << there.result.summary.message;
    EXPECT_EQ(there.result.summary.steps, here.result.summary.steps);
    double off = 0.0, force_off = 0.0;
    for (std::size_t p = 0; p < data.plies.size(); ++p)
      for (std::size_t n = 0; n < here.scene.plies[p].x.size(); ++n) {
        const Vec3 back = to.turn.transpose() * (there.result.last.plies[p].x[n] - to.way);
        const double d = (back - here.result.last.plies[p].x[n]).norm();
        if (!(d <= off)) off = d; // NaN too
      }
    for (std::size_t t = 0; t < data.tools.size(); ++t) {
      const Vec3 back = to.turn.transpose() * there.result.last.tools[t].force;
      force_off = std::max(force_off, (back - here.result.last.tools[t].force).norm());
      EXPECT_NEAR(there.result.last.tools[t].stroke_mm, here.result.last.tools[t].stroke_mm, 1e-6);
    }
    fmt::print("moved by {:g} mm: nodes {:.1e} mm, tool forces {:.1e} N, {} steps, {:.2f} s\n", far,
               off, force_off, there.result.summary.steps, there.result.summary.wall_time_s);
    EXPECT_LE(off, 4e-6);
    EXPECT_LE(force_off, 1e-3);
  }
}

} // namespace
} // namespace plyform::moved_test
