// SPDX-License-Identifier: GPL-3.0-or-later
// Planes of symmetry: a part is as good as the whole.
#include "core/run/run.hpp"
#include "core/solver/scene.hpp"
#include "core/solver/step.hpp"
#include "support/boundary_scenes.hpp"
#include "support/thread_checks.hpp"

#include <cstring>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace plyform::symmetry_test {
namespace {

/// A scene run to its end with the stable step of its stiffest element, which part and whole share;
/// the sharper one (core/ply/membrane_eigenvalue.hpp) differs by a per cent.
Scene run_by_elements(const Case& data) {
  Scene s = make_scene(data);
  s.plies[0].eigenvalue_ratio = 1.0;
  s.next_lanczos = std::numeric_limits<long>::max();
  ThreadPool pool(1);
  start(s, pool);
  while (s.time < data.solver.duration) {
    const auto stop = compute_forces(s, pool);
    EXPECT_FALSE(stop) << stop->message;
    if (stop) break;
    move_plies(s, pool);
  }
  EXPECT_FALSE(compute_forces(s, pool));
  return s;
}

TEST(SymmetryScene, QuarterIsAQuarterOfTheWhole) {
  // Meshes of which the quarter's is exactly a quarter, and which the plain element fits: with
  // averaged strains pairs may lie across the planes.
  for (const auto& [angle, mesh] : {std::pair(0.0, MeshKind::alternating),
                                    std::pair(0.25 * std::numbers::pi, MeshKind::crossed)}) {
    const Scene whole = run_by_elements(pushed_square(angle, mesh, false));
    const Scene quarter = run_by_elements(pushed_square(angle, mesh, true));
    const PlyBody &all = whole.plies[0], &part = quarter.plies[0];
    ASSERT_EQ(4 * part.membrane.triangles.size(), all.membrane.triangles.size());
    double largest = 0.0, deepest = 0.0;
    for (std::size_t n = 0; n < part.x.size(); ++n) {
      std::size_t same = 0;
      while (same < all.x.size() && (all.x0[same] - part.x0[n]).norm() > 1e-9)
        ++same;
      ASSERT_LT(same, all.x.size());
      largest = std::max(largest, (all.x[same] - part.x[n]).norm());
      deepest = std::max(deepest, part.x0[n].z() - part.x[n].z());
      ASSERT_TRUE(part.x[n].allFinite());
    }
    EXPECT_GT(deepest, 7.0);
    EXPECT_LE(largest, 1e-6) << angle; // mm: rounding, grown over the run
    const double force = whole.tools[0].force.norm();
    EXPECT_GT(force, 1.0);
    EXPECT_NEAR(4.0 * quarter.tools[0].force.z(), whole.tools[0].force.z(), 1e-6 * force);
    ThreadPool pool(1);
    const double external = current_energies(whole, pool).external;
    EXPECT_NEAR(4.0 * current_energies(quarter, pool).external, external, 1e-6 * external);
  }
}

TEST(SymmetryScene, GripsOffThePlaneMayCrossIt) {
  // Half of a strip that is pulled at both ends.
  Case whole = strip(0.0, Vec3::UnitX(), 0.2);
  whole.boundaries[0].as<Grip>().direction = -Vec3::UnitX();
  whole.boundaries[0].as<Grip>().stroke = 0.2;
  Case half = whole;
  half.blanks[0].outline.boundary = {{0, -10}, {50, -10}, {50, 10}, {0, 10}};
  half.boundaries[0] = plane("middle", Vec2::UnitX());
  const RunResult a = run_case(whole, 1, {}), b = run_case(half, 1, {});
  ASSERT_EQ(a.last.boundaries.size(), 2u);
  ASSERT_EQ(b.last.boundaries.size(), 1u); // planes are not listed
  EXPECT_EQ(b.last.boundaries[0].name, "right");
  const double force = a.last.boundaries[1].force_N;
  EXPECT_NEAR(force, 115.0 * 20.0 * 0.004, 0.02 * force);
  EXPECT_NEAR(b.last.boundaries[0].force_N, force, 1e-6 * force);
}

} // namespace
} // namespace plyform::symmetry_test
