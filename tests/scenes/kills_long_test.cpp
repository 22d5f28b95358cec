// SPDX-License-Identifier: GPL-3.0-or-later
// Fifty kills of a run, by the hash of its last state. Processes that are killed for good, and the
// files that they leave: tests/cli/resume_test.sh.
#include "support/boundary_scenes.hpp"
#include "support/kill_checks.hpp"

namespace plyform::kills_test {
namespace {

TEST(Kills, OfAStackInToolsLeaveNoTrace) {
  Case data = coarse_hemisphere({0.0, 0.25 * std::numbers::pi});
  data.tools[0].stroke = 30.0;
  data.solver.duration = 0.03;
  data.solver.fibre_damping = 0.1;
  data.solver.mass_damping = 100.0;
  expect_the_same_after_kills(data, 50);
}

TEST(Kills, OfAHeldPlyLeaveNoTrace) {
  expect_the_same_after_kills(pushed_square(0.25 * std::numbers::pi, MeshKind::alternating, true),
                              50);
}

} // namespace
} // namespace plyform::kills_test
