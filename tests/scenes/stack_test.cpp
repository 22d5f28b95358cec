// SPDX-License-Identifier: GPL-3.0-or-later
// Stacks at rest between a floor and a plate of constant force: what lies on each other passes all
// of it on (equilibrium of each ply), whatever the number of plies and their thickness.
//
// Contacts along the height are springs in series on masses: the slowest of n plies' motions has
// about pi / (2 n) of a single contact's frequency, and mass damping ends it.
#include "support/stress_scenes.hpp"
#include "support/thread_checks.hpp"

namespace plyform::stack_test {
namespace {

constexpr double force = 300.0; // N

Case pressed_stack(std::size_t plies, double thickness) {
  Case data = stack_of(std::vector<double>(plies, 0.0), rectangle(100.0, 100.0, 20.0));
  data.fabrics[0].thickness = thickness;
  for (std::size_t p = 0; p < plies; ++p)
    data.plies[p].z = thickness * (static_cast<double>(p) + 0.5);
  press_by_plate(data);
  data.tools[1].position.z() = thickness * static_cast<double>(plies) + 5.0;
  data.tools[1].force = force;
  data.solver.fibre_softening = 10.0; // contact is that much softer too: 0.03 mm deep
  data.solver.duration = 0.01;
  data.contact.skin = 0.25 * thickness; // neighbours only
  return data;
}

class StackScene : public ::testing::TestWithParam<std::tuple<std::size_t, double>> {};

TEST_P(StackScene, PassesTheWholeForceThroughEveryInterface) {
  const auto [plies, thickness] = GetParam();
  const Case data = pressed_stack(plies, thickness);
  double rest_since = 0.0; // s
  RunHooks hooks;
  hooks.frame = [&](const Frame& f) {
    if (!(f.energy.kinetic < 1e-6)) rest_since = f.time; // N mm: 6e-6 t a ply at 0.6 mm/s
  };
  const EndedRun run = run_on_any_threads([&] { return make_scene(data); }, hooks);
  ASSERT_TRUE(ended(run.result.summary.status)) << run.result.summary.message;
  EXPECT_LT(rest_since, 0.9 * data.solver.duration);
  const Scene& s = run.scene;
  EXPECT_NEAR(s.tools[1].force.z(), force, 1e-8 * force); // solved for
  EXPECT_NEAR(s.tools[0].force.z(), -force, 0.005 * force);
  double off = std::abs(s.tools[0].force.z() + force);
  for (int lower = 0; lower + 1 < static_cast<int>(plies); ++lower) {
    const double f = force_from_above(s, lower);
    EXPECT_NEAR(f, -force, 0.005 * force) << lower;
    off = std::max(off, std::abs(f + force));
  }
  fmt::print("{} plies of {} mm: {:.1e} of the force off, at rest after {:.4f} s, {:.3f} mm deep\n",
             plies, thickness, off / force, rest_since,
             run.result.summary.contact.max_ply_penetration_mm);
}

INSTANTIATE_TEST_SUITE_P(OfPliesAndThickness, StackScene,
                         ::testing::Combine(::testing::Values(1, 2, 5, 16),
                                            ::testing::Values(0.2, 0.6, 2.0)));

} // namespace
} // namespace plyform::stack_test
