// SPDX-License-Identifier: GPL-3.0-or-later
// Tools as triangle meshes form like the shapes that they were made from.
#include "core/run/run.hpp"
#include "core/solver/scene.hpp"
#include "support/stress_scenes.hpp"
#include "support/thread_checks.hpp"

namespace plyform::stl_tools_long_test {
namespace {

/// The coarse hemisphere with punch and die as they are, or as meshes of 1 mm facets (which miss a
/// radius of 75 mm by 1.7 um, one of 10 mm by 13 um).
Case hemisphere(bool meshes) {
  Case data = coarse_hemisphere({0.0});
  data.tools[1].shape = make_profile({{80.0, -90.0, 0.0}, {80.0, 0.0, 10.0}, {250.0, 0.0, 0.0}});
  data.solver.outputs = 1; // each state has a copy of the meshes
  if (meshes)
    for (const std::size_t t : {0, 1}) {
      const double reach = 400.0; // mm, beyond the ply's corners
      data.tools[t].shape = make_mesh_shape(tessellate(data.tools[t].shape, 1.0, reach), nullptr);
    }
  return data;
}

TEST(StlToolsLong, FormLikeTheirShapes) {
  const EndedRun shapes = run_on_any_threads([] { return make_scene(hemisphere(false)); });
  const Case meshed = hemisphere(true);
  const EndedRun meshes = run_on_any_threads([&] { return make_scene(meshed); });
  for (const EndedRun* run : {&shapes, &meshes}) {
    ASSERT_TRUE(ended(run->result.summary.status)) << run->result.summary.message;
    EXPECT_LE(imbalance(run->result.last.energy), 0.02);
  }
  const std::vector<double>& a = shapes.result.last.plies[0].shear_deg;
  const std::vector<double>& b = meshes.result.last.plies[0].shear_deg;
  ASSERT_EQ(a.size(), b.size());
  double sum = 0.0, most = 0.0;
  for (std::size_t e = 0; e < a.size(); ++e) {
    sum += (a[e] - b[e]) * (a[e] - b[e]);
    most = std::max(most, std::abs(a[e]));
  }
  const double rms = std::sqrt(sum / static_cast<double>(a.size()));
  const double time = shapes.result.summary.wall_time_s,
               of_mesh = meshes.result.summary.wall_time_s;
  fmt::print("shear up to {:.1f} degrees, {:.3f} rms apart; {:.2f} s as shapes, {:.2f} s as meshes "
             "({:.1f} times)\n",
             most, rms, time, of_mesh, of_mesh / time);
  EXPECT_GT(most, 30.0);
  EXPECT_LE(rms, 0.3);
}

} // namespace
} // namespace plyform::stl_tools_long_test
