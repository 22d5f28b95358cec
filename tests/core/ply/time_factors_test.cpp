// SPDX-License-Identifier: GPL-3.0-or-later
// What temperatures make of the times of yarns: the kernel with factors has the forces, losses and
// states of one triangle after the other with times multiplied by them.
#include "core/mesh/mesh_blank.hpp"
#include "core/ply/membrane_simd.hpp"
#include "support/membrane_checks.hpp"

#include <gtest/gtest.h>

namespace plyform::time_factors_test {
namespace {

TEST(TimeFactors, AreThoseOfTheTimesOfYarns) {
  const double factor = 0.3, dt = 1e-3;
  Fabric fabric = glass_weave();
  fabric.families[0].relaxation = MaxwellBranch{9000.0, 2e-3};
  Fabric faster = fabric;
  faster.families[0].relaxation->time *= factor;
  for (const ElementKind kind : {ElementKind::plain, ElementKind::averaged}) {
    Random random(7);
    const BlankMesh mesh = irregular_mesh(random);
    Membrane m = make_membrane(mesh, fabric, 0.1, kind),
             scaled = make_membrane(mesh, faster, 0.1, kind);
    std::vector<Vec3> x;
    for (const Vec2& p : mesh.x)
      x.emplace_back(p.x(), p.y(), 0.0);
    MembraneSimd simd = make_membrane_simd(m, x);
    const std::vector<SimdNumbers> factors(at(simd.packs),
                                           SimdNumbers{{factor, factor, factor, factor}});
    std::vector<SimdYarnStates> packs = states_at_start(simd, m);
    std::vector<YarnMemory> groups = memory_at_start(scaled);
    std::vector<ElementForce> q(m.triangles.size());
    double flowed = 0.0;
    for (int step = 0; step < 4; ++step) {
      for (Vec3& p : x)
        p.x() *= 1.002;
      const GroupReport fast =
          simd_forces(simd, m, x, dt, 0, {packs, packs}, nullptr, {{}, factors});
      const GroupReport slow = element_forces(scaled, x, dt, 0, m.groups(), {groups, groups}, q);
      EXPECT_NEAR(fast.flowed, slow.flowed, 1e-11 * slow.flowed);
      EXPECT_NEAR(fast.lost, slow.lost, 1e-11 * std::abs(slow.lost) + 1e-15);
      flowed += slow.flowed;
      double largest = 0.0;
      for (std::size_t n = 0; n < x.size(); ++n)
        largest = std::max(largest, simd_force(simd, n).norm());
      for (std::size_t n = 0; n < x.size(); ++n)
        ASSERT_LE((simd_force(simd, n) - node_force(scaled, q, static_cast<int>(n))).norm(),
                  1e-11 * largest);
    }
    EXPECT_GT(flowed, 0.0);
    const std::vector<YarnMemory> of = memory_of(simd, m, packs);
    for (std::size_t i = 0; i < of.size(); ++i)
      for (std::size_t k = 0; k < of[i].size(); ++k)
        EXPECT_NEAR(of[i][k], groups[i][k], 1e-12 * (1.0 + std::abs(groups[i][k])));
    const auto elastic = yarn_tensions(m, x), now = yarn_tensions(m, x, of);
    for (std::size_t e = 0; e < m.triangles.size(); ++e)
      EXPECT_GE(now[0][e], elastic[0][e]); // the branch pulls too
    EXPECT_GT(*std::max_element(now[0].begin(), now[0].end()),
              1.02 * *std::max_element(elastic[0].begin(), elastic[0].end()));
    EXPECT_EQ(now[1], elastic[1]);
  }
}

} // namespace
} // namespace plyform::time_factors_test
