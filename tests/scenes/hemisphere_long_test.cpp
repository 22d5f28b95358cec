// SPDX-License-Identifier: GPL-3.0-or-later
// The shipped hemisphere cases, whole, as `plyform run` computes them.
#include "core/run/run.hpp"
#include "core/setup/prepare_case.hpp"
#include "core/setup/scene_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <map>

namespace plyform::hemisphere_long_test {
namespace {

Case shipped(const char* name) {
  const PreparedCase reading =
      prepare_case(std::string(PLYFORM_CASES) + "/" + name + "/case.toml", {});
  for (const CaseError& error : reading.errors)
    ADD_FAILURE() << error.text();
  return reading.value.value();
}

double largest_shear(const PlyFrame& ply) {
  double largest = 0.0;
  for (const double g : ply.shear_deg)
    if (!(std::abs(g) <= largest) && !std::isnan(largest)) largest = std::abs(g); // NaN stays
  return largest;
}

/// Rms (degrees) of what a quarter turn about z changes in the shear angle: turned, warp lies where
/// weft was and the angle has the other sign. The mesh has to be its own quarter turn.
double quarter_turn_change(const PlyFrame& ply) {
  std::map<std::pair<long, long>, double> shear; // by place of the centroid, 1e-3 mm
  const auto place = [](const Vec3& c) {
    return std::pair(std::lround(1e3 * c.x()), std::lround(1e3 * c.y()));
  };
  std::vector<Vec3> centroids;
  for (std::size_t e = 0; e < ply.triangles.size(); ++e) {
    Vec3 c = Vec3::Zero();
    for (const int n : ply.triangles[e])
      c += ply.x0[n] / 3.0;
    centroids.push_back(c);
    shear[place(c)] = ply.shear_deg[e];
  }
  double sum = 0.0;
  for (std::size_t e = 0; e < centroids.size(); ++e) {
    const Vec3& c = centroids[e];
    const double change = ply.shear_deg[e] + shear.at(place(Vec3(-c.y(), c.x(), 0.0)));
    sum += change * change;
  }
  return std::sqrt(sum / static_cast<double>(centroids.size()));
}

const ToolFrame& tool(const Frame& frame, const std::string& name) {
  return *std::find_if(frame.tools.begin(), frame.tools.end(),
                       [&](const ToolFrame& t) { return t.name == name; });
}

TEST(HemisphereLong, OnePlyShearsAsAnIndependentPrototype) {
  Case uniform = shipped("hemisphere_0");
  uniform.blanks[0].element_size = 6.8;
  const RunResult run = run_case(uniform, 1, {});
  ASSERT_TRUE(ended(run.summary.status)) << run.summary.message;
  EXPECT_NEAR(run.last.stroke_mm, 75.0, 1e-6);
  const double shear = largest_shear(run.last.plies.at(0));
  // An independent prototype with the same tools and fabric got 44.4 degrees.
  EXPECT_GE(shear, 42.0);
  EXPECT_LE(shear, 47.0);
  EXPECT_LT(std::abs(run.last.energy.balance_error()), 0.02);
  EXPECT_LT(quarter_turn_change(run.last.plies.at(0)), 0.1); // warp and weft differ by 4 %
  RecordProperty("largest_shear_deg", fmt::format("{:.2f}", shear));
}

// On a uniform mesh of as many elements it is doubtful: they cut 1.6 mm into the die's fillet.
TEST(HemisphereLong, OnePlyOnAMeshFromTheSceneIsDone) {
  PreparedCase prepared = prepare_case(PLYFORM_CASES "/hemisphere_0/case.toml", {});
  ASSERT_TRUE(prepared.value);
  const SceneMesh mesh = mesh_from_scene(prepared, 2);
  const RunResult run = run_case(*prepared.value, 2, {}, prepared.meshes);
  EXPECT_EQ(run.summary.status, "done") << run.summary.message;
  EXPECT_LT(mesh.triangles, 10000.0);                       // 20 000 of 3.4 mm end so, too
  EXPECT_NEAR(tool(run.last, "punch").force_N, 113.7, 2.3); // 2 % of that with 3.4 mm throughout
}

TEST(HemisphereLong, FivePliesFormSoundly) {
  Case data = shipped("hemisphere_five_ply_paper");
  data.solver.outputs = 100;
  double holder_force = 0.0;
  int frames = 0;
  RunHooks hooks;
  hooks.frame = [&](const Frame& f) {
    if (f.stroke_mm < 0.9 * 75.0) return;
    holder_force += tool(f, "blank_holder").force_N;
    ++frames;
  };
  const RunResult run = run_case(data, 1, hooks);
  ASSERT_TRUE(ended(run.summary.status)) << run.summary.message;
  EXPECT_NEAR(run.last.stroke_mm, 75.0, 1e-6);
  const Energies& e = run.last.energy;
  EXPECT_LT(std::abs(e.balance_error()), 0.02);
  EXPECT_LT(e.kinetic, 0.05 * e.shear); // slow enough to count as at rest
  ASSERT_GE(frames, 10);
  EXPECT_NEAR(holder_force / frames, 300.0, 0.02 * 300.0); // N, the case's
  const ContactReport& contact = run.summary.contact;
  EXPECT_EQ(contact.intersections_between_plies, 0);
  EXPECT_LT(contact.max_tool_penetration_mm, 0.06); // a tenth of the thickness
  EXPECT_LT(contact.max_ply_penetration_mm, 0.12);  // a fifth
  for (const PlyFrame& ply : run.last.plies) {
    EXPECT_GT(largest_shear(ply), 10.0) << ply.name; // it has been drawn over the punch
    EXPECT_LT(largest_shear(ply), 60.0) << ply.name; // a glass weave is long locked there
    if (ply.angle_deg == 0.0) {
      EXPECT_LT(quarter_turn_change(ply), 1.0) << ply.name;
    }
    RecordProperty("quarter_turn_deg_" + ply.name, fmt::format("{:.3f}", quarter_turn_change(ply)));
    RecordProperty("largest_shear_deg_" + ply.name, fmt::format("{:.2f}", largest_shear(ply)));
  }
  RecordProperty("balance_error", fmt::format("{:.4f}", e.balance_error()));
  RecordProperty("kinetic_over_shear", fmt::format("{:.4f}", e.kinetic / e.shear));
  RecordProperty("holder_force_N", fmt::format("{:.2f}", holder_force / frames));
  RecordProperty("tool_penetration_mm", fmt::format("{:.4f}", contact.max_tool_penetration_mm));
  RecordProperty("ply_penetration_mm", fmt::format("{:.4f}", contact.max_ply_penetration_mm));
}

} // namespace
} // namespace plyform::hemisphere_long_test
