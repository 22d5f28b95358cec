// SPDX-License-Identifier: GPL-3.0-or-later
// What temperatures make of the torque of crossings: the kernel against the membrane computed one
// triangle after the other, and forces against the energy.
#include "core/ply/membrane_simd.hpp"
#include "core/ply/viscous_simd.hpp"
#include "support/membrane_checks.hpp"

#include <gtest/gtest.h>

namespace plyform::shear_factors_test {
namespace {

/// Shear by a table, and yarns that are not at right angles.
Fabric table_weave() {
  Fabric f = glass_weave();
  f.families[1].angle = 1.2;
  f.crossings[0].shear.angle = {0.0, 0.3, 0.9};
  f.crossings[0].shear.torque = {0.0, 0.1, 1.2};
  f.crossings[0].shear.k.clear();
  return f;
}

/// What counts as energy of shear and has no factor: a sheet, here beside a weave.
Fabric weave_on_a_sheet() {
  Fabric f = glass_weave();
  f.sheet = rubber().sheet;
  return f;
}

/// Factors of temperature on the torque of crossings: forces and energies as one by one, forces
/// that are the slope of the energy, and changes of the energy that are of crossings alone.
TEST(ShearFactors, AgreeWithTheMembraneOneByOneAndWithItsEnergy) {
  Random random(13);
  for (const Fabric& fabric :
       {glass_weave(), table_weave(), triaxial(), stitched(), weave_on_a_sheet()})
    for (const ElementKind kind : {ElementKind::plain, ElementKind::averaged})
      for (int i = 0; i < 10; ++i) {
        const BlankMesh mesh = irregular_mesh(random);
        const Membrane m = make_membrane(mesh, fabric, 0.4, kind, 1e3);
        std::vector<Vec3> x = random_state(mesh, 1.0, 0.2, random);
        MembraneSimd simd = make_membrane_simd(m, x);
        std::vector<double> factors;
        for (std::size_t e = 0; e < m.triangles.size(); ++e)
          factors.push_back(std::pow(10.0, signed_unit(random)));
        std::vector<SimdNumbers> packed(simd.triangles->size(), SimdNumbers{});
        pack(simd, m, factors, packed);
        ASSERT_EQ(simd.blocks.size(), 1u);
        std::vector<SimdYarnStates> of_packs = states_at_start(simd, m);
        std::vector<YarnMemory> of_groups = memory_at_start(m);
        std::vector<ElementForce> q(m.triangles.size());
        simd_forces(simd, m, x, 0.0, 0, {of_packs, of_packs}, nullptr, {packed, {}});
        element_forces(m, x, 0.0, 0, m.groups(), {of_groups, of_groups}, q, factors);
        std::vector<Vec3> fast, slow;
        double largest = 0.0;
        for (std::size_t n = 0; n < x.size(); ++n) {
          fast.push_back(simd_force(simd, n));
          slow.push_back(node_force(m, q, static_cast<int>(n)));
          largest = std::max(largest, slow.back().norm());
        }
        for (std::size_t n = 0; n < x.size(); ++n)
          ASSERT_LE((fast[n] - slow[n]).norm(), 1e-11 * largest) << n;
        const auto start = states_at_start(simd, m);
        const MembraneEnergy one = membrane_energy(m, x, {}, 0.0, factors);
        EXPECT_NEAR(simd_energy(simd, m, x, 0.0, 0, start, {packed, {}}).shear, one.shear,
                    1e-12 * one.shear);
        const std::vector<double> none(factors.size(), 0.0);
        EXPECT_NEAR(simd_shear_energy(simd, m, x, 0, start, packed),
                    one.shear - membrane_energy(m, x, {}, 0.0, none).shear, 1e-11 * one.shear);
        const double h = 1e-6, before = x[1].x();
        const auto energy_at = [&](double place) {
          x[1].x() = place;
          const MembraneEnergy e = membrane_energy(m, x, {}, 0.0, factors);
          return e.fibre + e.shear + e.stitch;
        };
        const double slope = (energy_at(before + h) - energy_at(before - h)) / (2.0 * h);
        EXPECT_NEAR(slow[1].x(), -slope, 1e-5 * largest) << fabric.name;
      }
}

} // namespace
} // namespace plyform::shear_factors_test
