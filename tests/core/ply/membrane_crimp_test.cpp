// SPDX-License-Identifier: GPL-3.0-or-later
// Crimped cells in the element: forces from energy, momentum, packs, the stable step's bound.
#include "core/ply/membrane_eigenvalue.hpp"
#include "core/ply/membrane_simd.hpp"
#include "support/membrane_checks.hpp"

#include <gtest/gtest.h>

namespace plyform::membrane_crimp_test {
namespace {

std::vector<Fabric> crimped_fabrics() {
  return {crimped_weave(false), crimped_weave(true), crimped_triaxial()};
}

/// Pulled, pressed, and within the toes.
TEST(MembraneCrimp, ForceIsMinusEnergyGradient) {
  Random random(41);
  for (const Fabric& fabric : crimped_fabrics())
    for (const ElementKind kind : {ElementKind::plain, ElementKind::averaged})
      for (const double stretch : {0.8, 1.0, 1.01, 1.2}) {
        const BlankMesh mesh = irregular_mesh(random);
        Membrane m = make_membrane(mesh, fabric, 3.0 * signed_unit(random), kind);
        const std::vector<Vec3> x = random_state(mesh, stretch, 0.1, random);
        EXPECT_LE(gradient_error(m, x), 1e-6) << fabric.families.size() << " at " << stretch;
      }
}

TEST(MembraneCrimp, HasNeitherNetForceNorMoment) {
  Random random(42);
  for (const Fabric& fabric : crimped_fabrics()) {
    const BlankMesh mesh = irregular_mesh(random);
    const Membrane m = make_membrane(mesh, fabric, 0.3, ElementKind::averaged);
    const std::vector<Vec3> x = random_state(mesh, 1.05, 0.3, random), f = nodal_forces(m, x);
    Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
    for (std::size_t n = 0; n < x.size(); ++n)
      sum += f[n], moment += x[n].cross(f[n]);
    EXPECT_LE(sum.norm(), 1e-11 * largest_norm(f));
    EXPECT_LE(moment.norm(), 1e-11 * largest_norm(f) * 30.0); // mm, the mesh
  }
}

std::vector<Vec3> flat(const BlankMesh& mesh) {
  std::vector<Vec3> x;
  for (const Vec2& p : mesh.x)
    x.emplace_back(p.x(), p.y(), 0.0);
  return x;
}

/// Forces, energy and what is lost, over three steps.
TEST(MembraneCrimp, PacksAgreeWithTheMembraneOneByOne) {
  Random random(43);
  for (const Fabric& fabric : crimped_fabrics())
    for (const ElementKind kind : {ElementKind::plain, ElementKind::averaged})
      for (const double stretch : {0.9, 1.0, 1.1}) {
        const BlankMesh mesh = irregular_mesh(random);
        Membrane m = make_membrane(mesh, fabric, 0.4, kind);
        set_viscosity(m, {0.02, 0.03, 0.01});
        MembraneSimd simd = make_membrane_simd(m, flat(mesh));
        std::vector<SimdYarnStates> of_packs = states_at_start(simd, m);
        std::vector<YarnMemory> of_groups = memory_at_start(m);
        std::vector<ElementForce> q(m.triangles.size());
        for (const double dt : {0.0, 1e-5, 2e-5}) {
          const std::vector<Vec3> x = random_state(mesh, stretch, 0.2, random);
          double lost = 0.0;
          MembraneEnergy energy;
          for (int b = 0; b < static_cast<int>(simd.blocks.size()); ++b) {
            const MembraneEnergy of = simd_energy(simd, m, x, dt, b, of_packs);
            energy.fibre += of.fibre, energy.shear += of.shear;
            lost += simd_forces(simd, m, x, dt, b, {of_packs, of_packs}).lost;
          }
          const MembraneEnergy slow = membrane_energy(m, x, of_groups, dt);
          EXPECT_NEAR(energy.fibre, slow.fibre, 1e-11 * slow.fibre);
          EXPECT_NEAR(energy.shear, slow.shear, 1e-11 * slow.shear);
          const double slowly =
              element_forces(m, x, dt, 0, m.groups(), {of_groups, of_groups}, q).lost;
          EXPECT_NEAR(lost, slowly, 1e-11 * std::abs(slowly));
          std::vector<Vec3> f;
          for (std::size_t n = 0; n < x.size(); ++n)
            f.push_back(node_force(m, q, static_cast<int>(n)));
          for (std::size_t n = 0; n < x.size(); ++n)
            ASSERT_LE((simd_force(simd, n) - f[n]).norm(), 1e-10 * largest_norm(f)) << n;
        }
      }
}

/// The bound of elements is above the stiffest mode of the sheet, found by products with its
/// tangent: differences of forces.
TEST(MembraneCrimp, ElementBoundHoldsForItsTangent) {
  Random random(44);
  for (const Fabric& fabric : crimped_fabrics())
    for (const double stretch : {1.0, 1.004, 1.03}) {
      const BlankMesh mesh = irregular_mesh(random);
      const Membrane m = make_membrane(mesh, fabric, 0.4, ElementKind::averaged);
      const std::vector<Vec3> x = random_state(mesh, stretch, 0.02, random);
      Eigen::VectorXd v = scattered_motion(m, x).normalized();
      double omega2 = 0.0;
      for (int i = 0; i < 60; ++i) { // power iteration with M^-1 K
        constexpr double small = 1e-7;
        std::vector<Vec3> ahead = x, back = x;
        for (std::size_t n = 0; n < x.size(); ++n) {
          const Vec3 step = small * v.segment<3>(static_cast<Eigen::Index>(3 * n));
          ahead[n] += step, back[n] -= step;
        }
        const std::vector<Vec3> f = nodal_forces(m, ahead), g = nodal_forces(m, back);
        Eigen::VectorXd w(v.size());
        for (std::size_t n = 0; n < x.size(); ++n)
          w.segment<3>(static_cast<Eigen::Index>(3 * n)) =
              (g[n] - f[n]) / (2.0 * small * m.node_mass[n]);
        omega2 = w.norm();
        v = w / omega2;
      }
      const double bound = eigenvalue_bound(m, x).omega2;
      EXPECT_LE(omega2, bound) << stretch;
      EXPECT_GE(omega2, 0.02 * bound) << stretch;
    }
}

} // namespace
} // namespace plyform::membrane_crimp_test
