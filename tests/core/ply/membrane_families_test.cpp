// SPDX-License-Identifier: GPL-3.0-or-later
// Membranes of any number of families of yarns.
#include "core/ply/membrane.hpp"
#include "support/membrane_checks.hpp"

#include <gtest/gtest.h>

namespace plyform::membrane_families_test {
namespace {

/// One family, three, families without a crossing, none: all terms at once, pressed and pulled.
TEST(Membrane, ForceIsMinusEnergyGradientForAnyNumberOfFamilies) {
  Random random(31);
  for (const Fabric& fabric : {unidirectional(), triaxial(), stitched(), non_crimp(), foil()})
    for (const ElementKind kind : {ElementKind::plain, ElementKind::averaged})
      for (const double stretch : {0.45, 0.8, 1.2}) {
        const BlankMesh mesh = irregular_mesh(random);
        Membrane m = make_membrane(mesh, fabric, 3.0 * signed_unit(random), kind);
        const std::vector<Vec3> x = random_state(mesh, stretch, 0.3, random);
        EXPECT_LE(gradient_error(m, x), 1e-6) << fabric.families.size() << " at " << stretch;
      }
}

/// A fabric does not know in which order its families are written, nor its axes: two of a weave
/// exchanged, or one more without stiffness, change nothing.
TEST(Membrane, AnswersTheSameWhateverTheOrderOfItsFamilies) {
  Random random(32);
  const BlankMesh mesh = irregular_mesh(random);
  const std::vector<Vec3> x = random_state(mesh, 1.05, 0.3, random);
  const Fabric weave = triaxial();
  const auto reordered = [&](const std::vector<std::size_t>& order) {
    Fabric f = weave;
    for (std::size_t a = 0; a < order.size(); ++a)
      f.families[order[a]] = weave.families[a];
    for (Crossing& c : f.crossings)
      c.first = order[c.first], c.second = order[c.second];
    return f;
  };
  const std::vector<Vec3> force =
      nodal_forces(make_membrane(mesh, weave, 0.2, ElementKind::averaged), x);
  for (const std::vector<std::size_t>& order :
       {std::vector<std::size_t>{1, 0, 2}, {2, 0, 1}, {1, 2, 0}}) {
    const std::vector<Vec3> other =
        nodal_forces(make_membrane(mesh, reordered(order), 0.2, ElementKind::averaged), x);
    for (std::size_t n = 0; n < x.size(); ++n)
      EXPECT_LE((other[n] - force[n]).norm(), 1e-10 * largest_norm(force)) << n;
  }
}

} // namespace
} // namespace plyform::membrane_families_test
