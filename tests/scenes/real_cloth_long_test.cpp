// SPDX-License-Identifier: GPL-3.0-or-later
// Stacks of yarns that bear compression and bend in their plane, formed whole.
#include "core/setup/prepare_case.hpp"
#include "support/scene_checks.hpp"
#include "support/thread_checks.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace plyform::real_cloth_long_test {
namespace {

/// hemisphere_five_ply with cells of 10 mm, and zones of sheared yarns that these carry (cases/
/// random_stacks/README.md): 28 mm wide.
Case coarse_five_plies() {
  const std::string path = std::string(PLYFORM_CASES) + "/hemisphere_five_ply/case.toml";
  const PreparedCase reading = prepare_case(path, {{"blanks.square.element_size", "10.0"}});
  for (const CaseError& error : reading.errors)
    ADD_FAILURE() << error.text();
  Case data = reading.value.value();
  for (Fabric& fabric : data.fabrics)
    for (YarnFamily& family : fabric.families)
      family.in_plane_bending = 18.0;
  return data;
}

/// Gone all the way, closed in energy, nothing through anything, as deep as contact may be at most.
void expect_sound(const RunResult& run, const std::string& what) {
  ASSERT_TRUE(ended(run.summary.status)) << what << ": " << run.summary.message;
  const ContactReport& contact = run.summary.contact;
  fmt::print("{}: {} steps, balance {:.1e}, {:.3f} mm into tools, {:.3f} between plies; shear",
             what, run.summary.steps, run.last.energy.balance_error(),
             contact.max_tool_penetration_mm, contact.max_ply_penetration_mm);
  for (const PlyFrame& ply : run.last.plies)
    fmt::print(" {:.1f}", std::abs(*std::max_element(
                              ply.shear_deg.begin(), ply.shear_deg.end(),
                              [](double a, double b) { return std::abs(a) < std::abs(b); })));
  fmt::print(" deg\n");
  EXPECT_EQ(contact.intersections_between_plies, 0) << what;
  EXPECT_EQ(contact.intersections_within_plies, 0) << what;
  EXPECT_LT(std::abs(run.last.energy.balance_error()), 0.01) << what;
  EXPECT_LE(contact.max_tool_penetration_mm, 0.1) << what;
  EXPECT_LE(contact.max_ply_penetration_mm, 0.15) << what;
}

TEST(RealClothLong, FivePliesShearAsOneAloneAndDoNotShorten) {
  const RunResult run = run_case(coarse_five_plies(), 1, {});
  expect_sound(run, "five plies");
  EXPECT_NEAR(run.last.stroke_mm, 75.0, 1e-6);
  for (const PlyReport& ply : run.summary.plies) { // by 460 N per strain; spots on this coarse mesh
    EXPECT_LT(std::abs(ply.pressed.value().largest), 0.05);
    EXPECT_LT(ply.pressed.value().share_above_2, 0.01);
  }
  for (const PlyFrame& ply : run.last.plies) {
    double sum = 0.0;
    for (const double g : ply.shear_deg)
      sum += g * g;
    const double rms = std::sqrt(sum / static_cast<double>(ply.shear_deg.size()));
    // one ply alone has 19.8 degrees, five of 6.8 mm 20.6 to 22.1; tension-only yarns have 11
    EXPECT_NEAR(rms, 21.0, 2.0) << ply.name;
  }
}

/// Softer contact than anybody would take, the highest friction, yarns that hardly bend: where
/// contact gave way before.
TEST(RealClothLong, ContactHoldsWhereItGaveWay) {
  for (const double friction : {0.05, 0.4}) {
    Case data = coarse_five_plies();
    for (Fabric& fabric : data.fabrics) {
      fabric.families[0].tension.compression = fabric.families[1].tension.compression = 46.0;
      fabric.families[0].bending.stiffness = fabric.families[1].bending.stiffness = 0.5;
      fabric.twist = 0.5;
    }
    set_friction(data, friction);
    data.contact.stiffness = 0.025;
    data.solver.fibre_softening = 300.0;
    expect_sound(run_case(data, 1, {}), fmt::format("friction {}", friction));
  }
}

} // namespace
} // namespace plyform::real_cloth_long_test
