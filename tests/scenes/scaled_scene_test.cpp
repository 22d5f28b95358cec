// SPDX-License-Identifier: GPL-3.0-or-later
// A scene with all lengths multiplied by s, and forces by s^3, so that times stay: it has the same
// steps, as no length of the solver stands in millimetres. With s = 1/8 every number of it is
// scaled without rounding, and so are the results.
#include "core/run/run.hpp"
#include "support/scene_checks.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace plyform::scaled_scene_test {
namespace {

Case scaled_hemisphere(double s, const std::vector<double>& angles, bool holder) {
  Case data = coarse_hemisphere(angles);
  Fabric& f = data.fabrics[0];
  for (TensionLaw* yarn : {&f.families[0].tension, &f.families[1].tension})
    yarn->stiffness *= s * s * s; // N per yarn
  f.families[0].density /= s, f.families[1].density /= s, f.thickness *= s;
  for (double& k : f.crossings[0].shear.k)
    k *= s * s * s * s; // N mm
  data.blanks[0] = rectangle(340.0 * s, 340.0 * s, 20.0 * s);
  for (Ply& ply : data.plies)
    ply.z *= s;
  for (Tool& tool : data.tools)
    tool.position *= s, tool.stroke *= s, tool.force *= s * s * s;
  data.tools[0].shape = Sphere{75.0 * s};
  data.tools[1].shape =
      make_profile({{80.0 * s, -120.0 * s, 0.0}, {80.0 * s, 0.0, 10.0 * s}, {400.0 * s, 0.0, 0.0}});
  data.tools[2].shape = Annulus{92.0 * s, 300.0 * s, 10.0 * s, 0.0};
  if (!holder) data.tools.pop_back();
  set_friction(data, 0.2);
  data.solver.duration = 0.03;
  return data;
}

TEST(ScaledScene, HasTheSameSteps) {
  constexpr double s = 0.125;
  for (const std::vector<double>& angles : {std::vector{0.0}, std::vector{0.0, 0.5}}) {
    const RunResult whole = run_case(scaled_hemisphere(1.0, angles, false), 1, {}),
                    small = run_case(scaled_hemisphere(s, angles, false), 1, {});
    ASSERT_TRUE(ended(whole.summary.status)) << whole.summary.message;
    fmt::print("{} plies: {} and {} steps\n", angles.size(), whole.summary.steps,
               small.summary.steps);
    EXPECT_EQ(small.summary.steps, whole.summary.steps);
    EXPECT_EQ(small.summary.work.searches, whole.summary.work.searches);
    double off = 0.0;
    for (std::size_t n = 0; n < whole.last.plies[0].x.size(); ++n)
      off = std::max(off, (small.last.plies[0].x[n] / s - whole.last.plies[0].x[n]).norm());
    EXPECT_LT(off, 1e-6); // mm: the round of lengths that are no powers of two
  }
}

/// A pushed tool approaches with the speed of a press, which does not shrink with the scene: what
/// it may move in a step counts when searches are due.
TEST(ScaledScene, WithAHolderHasNearlyTheSame) {
  const Summary whole = run_case(scaled_hemisphere(1.0, {0.0}, true), 1, {}).summary,
                small = run_case(scaled_hemisphere(0.1, {0.0}, true), 1, {}).summary;
  fmt::print("with a holder: {} and {} steps\n", whole.steps, small.steps);
  EXPECT_NEAR(static_cast<double>(small.steps), static_cast<double>(whole.steps),
              0.02 * static_cast<double>(whole.steps));
}

} // namespace
} // namespace plyform::scaled_scene_test
