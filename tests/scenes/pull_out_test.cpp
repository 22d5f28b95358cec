// SPDX-License-Identifier: GPL-3.0-or-later
// A ply drawn out along its warp from between what presses on it, against Coulomb's law on its two
// faces: pull = 2 mu N.
//   The middle one of three plies under a plate of constant force F: all of it goes through that
//   ply, however small the area that is left, N = F (Amontons).
//   A ply between plates a given distance apart, each contact c deep with the stiffness k per area:
//   N = p w (l - d), p = k c, falls with what is left of length l and width w after a way d. Nodes
//   leave column by column, the first one, which stands for half a cell, at once: N falls in steps,
//   which meet the line in the middle of each cell of the way.
#include "support/stress_scenes.hpp"
#include "support/thread_checks.hpp"

namespace plyform::pull_out_test {
namespace {

constexpr double mu = 0.2;
constexpr double length = 60.0, width = 30.0, cell = 7.5; // mm
const Vec2 low(-0.5 * length, -0.5 * width), high(0.5 * length, 0.5 * width);

Case plies_of(std::size_t count) {
  Case data = stack_of(std::vector<double>(count, 0.0), rectangle(length, width, cell));
  press_by_plate(data);
  data.contact.stiffness = 0.5; // little is stored that columns set free as they leave
  data.solver.outputs = 80;
  return data;
}

/// Holds the edge of a ply at the front or the back in its plane; it may be pressed together.
Boundary grip(int ply, bool front, double stroke) {
  Boundary b = front ? hold("front", {high.x(), low.y()}, high, Vec3::UnitX(), stroke)
                     : hold("back", low, {low.x(), high.y()}, Vec3::UnitX(), stroke);
  b.name += std::to_string(ply);
  b.ply = ply;
  b.as<Grip>().held = {true, true, false};
  return b;
}

/// Mass damping keeps a ply from swinging along its yarns when a column leaves; it also brakes the
/// one that is drawn, by m c v: half a percent of the pull or so.
struct Braking {
  double way = 0.0, time = 0.0; ///< mm, s: at the output before
  /// N, the mean since then.
  double next(const Frame& f, const Case& data) {
    const double mass = data.fabrics[0].surface_density * length * width;
    const double speed = f.time > time ? (f.stroke_mm - way) / (f.time - time) : 0.0;
    way = f.stroke_mm, time = f.time;
    return data.solver.mass_damping * mass * speed;
  }
};

TEST(PullOutScene, PullUnderConstantForceDoesNotFallWithTheArea) {
  Case data = plies_of(3);
  data.tools[1].force = 50.0;
  for (std::size_t tool : {3u, 4u}) // without friction: grips alone hold the outer plies
    for (std::size_t body = 0; body < 5; ++body)
      data.friction.mu[5 * tool + body] = data.friction.mu[5 * body + tool] = 0.0;
  data.boundaries = {grip(1, true, 12.0), grip(0, false, 0.0), grip(2, false, 0.0)};
  data.solver.mass_damping = 200.0; // 1/s
  data.solver.fibre_damping = 0.5;  // of the swing along its yarns when a column has left
  data.solver.duration = 0.06;
  Braking braking;
  const double wanted = 2.0 * mu * data.tools[1].force;
  double least = 1e9, most = 0.0;
  RunHooks hooks;
  hooks.frame = [&](const Frame& f) {
    const double pull = f.boundaries.at(0).force_N - braking.next(f, data);
    if (f.stroke_mm < 1.0) return; // not all of it slides yet
    ASSERT_FALSE(std::isnan(pull));
    least = std::min(least, pull);
    most = std::max(most, pull);
  };
  const EndedRun run = run_on_any_threads([&] { return make_scene(data); }, hooks);
  ASSERT_TRUE(ended(run.result.summary.status)) << run.result.summary.message;
  EXPECT_LE(imbalance(run.result.last.energy), 0.01);
  EXPECT_NEAR(least, wanted, 0.02 * wanted);
  EXPECT_NEAR(most, wanted, 0.02 * wanted);
  fmt::print("{:.3f} to {:.3f} N of {} N\n", least, most, wanted);
}

/// Between plates that end where the ply does at the front, and reach further elsewhere.
Case between_fixed_plates(double depth) {
  Case data = plies_of(1);
  data.plies[0].z -= depth;
  Tool& plate = data.tools[1];
  plate.shape = Box{{3.0 * length, 3.0 * width, 10.0}};
  plate.position += Vec3(-length, 0.0, -2.0 * depth);
  plate.motion = Motion::fixed;
  data.tools[0] = plate;
  data.tools[0].name = "floor";
  data.tools[0].position.z() = -5.0;
  data.boundaries = {grip(0, true, 4.0 * cell)};
  data.solver.mass_damping = 500.0; // 1/s
  data.solver.duration = 0.08;
  data.solver.max_balance_error = 2.0; // the ledger knows nothing of a squeezed start: see below
  return data;
}

double stored_and_lost(const Energies& e) {
  return e.kinetic + e.fibre + e.shear + e.contact + e.friction + e.damping;
}

TEST(PullOutScene, PullAtConstantPressureFallsWithTheArea) {
  const double depth = 0.02; // mm
  const Case data = between_fixed_plates(depth);
  const double p = make_scene(data).tools[0].contacts[0].law.pressure(depth); // N/mm^2
  std::array<double, 4> pull{}, normal{}; // N, sums over each cell of the way
  std::array<int, 4> count{};
  double at_start = 0.0; // N mm
  RunHooks hooks;
  Braking braking;
  hooks.frame = [&](const Frame& f) {
    const double brake = braking.next(f, data);
    if (f.step == 0) at_start = stored_and_lost(f.energy);
    const auto i = static_cast<std::size_t>(f.stroke_mm / cell);
    if (i > 3 || f.stroke_mm - static_cast<double>(i) * cell < 1.0) return; // a column is leaving
    pull[i] += f.boundaries.at(0).force_N - brake;
    normal[i] -= f.tools.at(0).force.z();
    ++count[i];
  };
  const EndedRun run = run_on_any_threads([&] { return make_scene(data); }, hooks);
  ASSERT_TRUE(ended(run.result.summary.status)) << run.result.summary.message;
  const Energies& e = run.result.last.energy;
  EXPECT_NEAR(stored_and_lost(e) - at_start, e.external, 0.01 * e.external);
  for (std::size_t i = 0; i < 4; ++i) {
    ASSERT_GT(count[i], 10);
    const double wanted = p * width * (length - (static_cast<double>(i) + 0.5) * cell);
    const double found = normal[i] / count[i], mean = pull[i] / count[i];
    EXPECT_NEAR(found, wanted, 0.02 * wanted) << i;
    EXPECT_NEAR(mean, 2.0 * mu * wanted, 0.02 * 2.0 * mu * wanted) << i;
    fmt::print("{:.2f} mm: pull {:+.4f}, normal {:+.4f} off {:.3f} N\n",
               (static_cast<double>(i) + 0.5) * cell, mean / (2.0 * mu * wanted) - 1.0,
               found / wanted - 1.0, 2.0 * mu * wanted);
  }
}

} // namespace
} // namespace plyform::pull_out_test
