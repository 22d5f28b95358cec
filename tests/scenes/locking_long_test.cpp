// SPDX-License-Identifier: GPL-3.0-or-later
// The load of the bias-extension test does not hang on how the mesh lies to the yarns.
#include "support/static_bias.hpp"

#include <gtest/gtest.h>

namespace plyform::locking_long_test {
namespace {

constexpr double length = 300.0, width = 100.0;
const std::vector<double> angles{10.0 * degree, 20.0 * degree, 30.0 * degree};

std::vector<double> loads(const StripMesh& mesh, ElementKind element) {
  return bias_loads(strip_mesh(mesh, length, width), glass_weave(), length, width, element, angles);
}

/// Both diagonals of squares, which lie along the yarns: no locking, and converged (test below).
std::vector<double> converged_loads() {
  return loads({MeshKind::crossed, 10.0, 0.0, 0.0}, ElementKind::plain);
}

TEST(LockingLong, ReferenceIsConvergedAndNearTheory) {
  const std::vector<double> fine = loads({MeshKind::crossed, 5.0, 0.0, 0.0}, ElementKind::plain),
                            coarse = converged_loads();
  const ShearTest test = shear_test(BiasSpecimen{length, width});
  for (std::size_t i = 0; i < angles.size(); ++i) {
    EXPECT_NEAR(coarse[i] / fine[i], 1.0, 0.002);
    const double theory = test_load(test, glass_weave(), extension_at(test, angles[i]));
    EXPECT_NEAR(fine[i] / theory, 1.0, 0.02) << i; // zones are not as even as (40) has them
  }
}

/// Meshes of squares with one diagonal whose nodes are moved by up to 30 % of a side, and free
/// meshes, at 0 to 45 degrees to the yarns in steps: load within `most` of the converged one.
void judge(double size, double most, int step) {
  const std::vector<double> converged = converged_loads();
  for (const MeshKind kind : {MeshKind::fibres, MeshKind::free})
    for (int turn = 0; turn <= 45; turn += step) {
      const double noise = kind == MeshKind::free ? 0.0 : 0.3;
      const std::vector<double> found =
          loads({kind, size, (45.0 - turn) * degree, noise}, ElementKind::averaged);
      for (std::size_t i = 0; i < angles.size(); ++i)
        EXPECT_NEAR(found[i] / converged[i], 1.0, most)
            << (noise > 0.0 ? "shaken" : "free") << ", yarns at " << turn << " to the cells, angle "
            << angles[i] / degree;
    }
}

TEST(LockingLong, AveragedElementIsWithinTenPercentAtTenElementsAWidth) {
  judge(0.1 * width, 0.10, 5);
}

TEST(LockingLong, AveragedElementIsWithinFivePercentAtTwentyElementsAWidth) {
  judge(0.05 * width, 0.05, 15); // the angles between: locking_study angles
}

/// A band of small elements aslant across the zone that shears, and a ring of them.
TEST(LockingLong, AveragedElementOnGradedMeshesIsWithinFivePercentOfTheory) {
  const ShearTest test = shear_test(BiasSpecimen{length, width});
  for (const MeshKind kind : {MeshKind::diagonal, MeshKind::alternating, MeshKind::free}) {
    BlankSpec spec = rectangle(length, width, 10.0, kind);
    MeshZone band, ring;
    band.kind = ZoneKind::polygon, band.outline = {{-70, -60}, {-20, -60}, {60, 60}, {10, 60}};
    ring.centre = {70, 20}, ring.radius = 25.0, ring.inner_radius = 12.0;
    band.element_size = ring.element_size = 5.0;
    spec.zones = {band, ring};
    const std::vector<double> found =
        bias_loads(mesh_blank(spec, 0.0, 0.5 * std::numbers::pi), glass_weave(), length, width,
                   ElementKind::averaged, angles);
    for (std::size_t i = 0; i < angles.size(); ++i)
      EXPECT_NEAR(found[i] / test_load(test, glass_weave(), extension_at(test, angles[i])), 1.0,
                  0.05)
          << static_cast<int>(kind) << ' ' << i;
  }
}

/// A law ten times stiffer where the angle between the families closes, pulled either way: what
/// deviations cost follows the side that is sheared, but where they are larger than shear, at the
/// clamps: there they cost the mean of both sides, which the softer one feels.
TEST(LockingLong, LawOfBothSignsLocksLittleOnEitherSide) {
  const Fabric fabric = two_sided_weave();
  const ShearTest test = shear_test(BiasSpecimen{length, width});
  for (const bool negative : {false, true}) {
    const double warp = (negative ? 45.0 : -45.0) * degree, most = negative ? 0.15 : 0.10;
    const auto found = [&](const StripMesh& mesh, ElementKind element) {
      return bias_loads(strip_mesh(mesh, length, width), fabric, length, width, element, angles,
                        1e-10, warp);
    };
    const std::vector<double> converged =
        found({MeshKind::crossed, 10.0, 0.0, 0.0}, ElementKind::plain);
    for (std::size_t i = 0; i < angles.size(); ++i)
      EXPECT_NEAR(converged[i] / test_load(test, fabric, extension_at(test, angles[i]), negative),
                  1.0, 0.03);
    for (const double turn : {0.0, 30.0, 45.0})
      for (const MeshKind kind : {MeshKind::fibres, MeshKind::free}) {
        const double noise = kind == MeshKind::free ? 0.0 : 0.3;
        const std::vector<double> loads =
            found({kind, 10.0, (45.0 - turn) * degree, noise}, ElementKind::averaged);
        for (std::size_t i = 0; i < angles.size(); ++i)
          EXPECT_NEAR(loads[i] / converged[i], 1.0, most)
              << (negative ? "opens" : "closes") << ", yarns at " << turn << ", "
              << angles[i] / degree;
      }
  }
}

TEST(LockingLong, PlainElementIsNot) {
  const std::vector<double> converged = converged_loads();
  const std::vector<double> found =
      loads({MeshKind::fibres, 10.0, 25.0 * degree, 0.3}, ElementKind::plain);
  EXPECT_GT(found[2] / converged[2], 1.5);
}

} // namespace
} // namespace plyform::locking_long_test
