// SPDX-License-Identifier: GPL-3.0-or-later
// The kernel against bending computed one node after the other.
#include "contact/simd/cpu_features.hpp"
#include "core/ply/bending_simd.hpp"
#include "support/membrane_checks.hpp"

#include <cstring>
#include <gtest/gtest.h>

namespace plyform {
namespace {

constexpr double warp = 0.3, weft = 1.55; // rad

BendingLaw cloth() {
  BendingLaw law;
  law.warp.stiffness = 5.0; // N mm
  law.weft.stiffness = 0.5;
  law.coupling = 0.2;
  law.twist = 0.3;
  return law;
}

/// Alone and together: bending out of the sheet by line and by table, and in it.
std::vector<BendingLaw> laws() {
  BendingLaw table = cloth(), both = cloth(), in_plane;
  table.weft.curvature = {0.0, 0.01, 0.03}; // 1/mm
  table.weft.moment = {0.0, 0.05, 0.07};    // N
  both.in_plane = {8.0, 2.0};               // N mm
  in_plane.in_plane = {0.0, 3.0};
  BendingLaw all = table;
  all.in_plane = both.in_plane;
  return {cloth(), table, both, in_plane, all};
}

std::vector<Vec3> unformed(const BlankMesh& mesh) {
  std::vector<Vec3> x;
  for (const Vec2& p : mesh.x)
    x.emplace_back(p.x(), p.y(), 0.0);
  return x;
}

std::vector<Vec3> by_simd(BendingSimd& simd, const std::vector<Vec3>& x) {
  for (int block = 0; block < static_cast<int>(simd.blocks.size()); ++block)
    bending_forces(simd, x, block);
  std::vector<Vec3> force;
  for (std::size_t n = 0; n < x.size(); ++n)
    force.push_back(simd_force(simd, n));
  return force;
}

void expect_same(const BlankMesh& mesh, const BendingLaw& law, const std::vector<Vec3>& x) {
  const std::vector<double> masses(mesh.x.size(), 1e-8);
  const Bending b = make_bending(mesh.x, mesh.triangles, law, warp, weft, masses);
  BendingSimd simd = make_bending_simd(b, unformed(mesh));
  for (const BendingBlock& block : simd.blocks)
    EXPECT_LE(block.nodes, most_block_nodes);
  const std::vector<Vec3> fast = by_simd(simd, x), slow = reference_bending_forces(b, x);
  const double scale = largest_norm(slow);
  ASSERT_GT(scale, 0.0);
  const double energy = bending_energy(b, x);
  EXPECT_NEAR(bending_energy(simd, x), energy, 1e-12 * energy);
  for (std::size_t n = 0; n < x.size(); ++n) // second differences of places keep twelve digits
    ASSERT_LE((fast[n] - slow[n]).norm(), 1e-11 * scale) << n;
}

TEST(BendingSimd, AgreeWithBendingNodeByNode) {
  Random random(11);
  for (const BendingLaw& law : laws())
    for (int i = 0; i < 20; ++i) {
      const BlankMesh mesh = irregular_mesh(random);
      expect_same(mesh, law, random_state(mesh, 1.05, 0.5, random));
    }
}

TEST(BendingSimd, ManyBlocksHoldEveryNodeOnceOnAnyMesh) {
  Random random(12);
  for (const MeshKind kind :
       {MeshKind::diagonal, MeshKind::alternating, MeshKind::crossed, MeshKind::free}) {
    BlankSpec spec = rectangle(150.0, 100.0, 4.0, kind);
    const BlankMesh mesh = mesh_blank(spec, warp, weft);
    for (const BendingLaw& law : laws())
      expect_same(mesh, law, random_state(mesh, 1.05, 0.3, random));
  }
}

TEST(BendingSimd, KnowAHoleAndTrianglesThatOnlyShareANode) {
  // Two squares of two triangles with a corner in common; a ring of eight around a hole.
  BlankMesh corner;
  corner.x = {{0, 0}, {10, 0}, {10, 10}, {0, 10}, {20, 10}, {20, 20}, {10, 20}};
  corner.triangles = {{0, 1, 2}, {0, 2, 3}, {2, 4, 5}, {2, 5, 6}};
  BlankMesh hole;
  for (int i = 0; i < 8; ++i)
    for (const double r : {10.0, 20.0})
      hole.x.push_back(r * Vec2(std::cos(i * std::numbers::pi / 4), std::sin(i * M_PI / 4)));
  for (int i = 0; i < 8; ++i) {
    const int a = 2 * i, b = 2 * ((i + 1) % 8);
    hole.triangles.push_back({a, a + 1, b + 1});
    hole.triangles.push_back({a, b + 1, b});
  }
  hole.x.emplace_back(30.0, 0.0); // so that one edge of the rim goes on straight
  hole.triangles.push_back({1, 16, 3});
  Random random(13);
  for (const BlankMesh& mesh : {corner, hole}) {
    const std::vector<double> masses(mesh.x.size(), 1e-8);
    const Bending b = make_bending(mesh.x, mesh.triangles, laws()[4], warp, weft, masses);
    BendingSimd simd = make_bending_simd(b, unformed(mesh));
    const std::vector<Vec3> x = random_state(mesh, 1.0, 0.5, random);
    const std::vector<Vec3> fast = by_simd(simd, x), slow = reference_bending_forces(b, x);
    for (std::size_t n = 0; n < x.size(); ++n)
      EXPECT_LE((fast[n] - slow[n]).norm(), 1e-11 * largest_norm(slow) + 1e-15) << n;
  }
}

/// All copies of the kernel: no processor answers differently.
TEST(BendingSimd, GiveTheSameBitsOnEveryProcessor) {
  if (!has_avx2()) GTEST_SKIP() << "this processor has no AVX2";
  Random random(8);
  constexpr std::size_t ring = 5, slots = 7, nodes = 8;
  for (int i = 0; i < 200; ++i) {
    SimdStencils stencils{};
    SimdNumbers constants[5 * slots];
    std::uint16_t slot[simd_width * slots];
    SimdForce force[3][nodes];
    double x[3 * nodes];
    for (double& a : x)
      a = 3.0 * signed_unit(random);
    for (std::size_t lane = 0; lane < simd_width; ++lane) {
      stencils.area[lane] = 2.0 + signed_unit(random);
      stencils.in_plane[0][lane] = 8.0, stencils.in_plane[1][lane] = 2.0;
      stencils.own[lane] = static_cast<std::uint16_t>(sizeof(SimdForce) * lane);
      for (SimdNumbers& c : constants)
        c.of[lane] = signed_unit(random);
      for (std::size_t k = 0; k < slots; ++k)
        slot[simd_width * k + lane] =
            static_cast<std::uint16_t>(sizeof(SimdForce) * ((k + lane + 1) % nodes));
    }
    stencils.ring = ring, stencils.slots = slots;
    const std::int32_t list[nodes] = {0, 1, 2, 3, 4, 5, 6, 7};
    for (const bool in_plane : {false, true}) {
      const BendingKernelLaw law{{5.0, 0.5}, 0.2, 0.3, false, in_plane, nullptr, nullptr};
      bending_kernel_generic({list, nodes, &stencils, 1, constants, slot, force[0]}, law, x);
      bending_kernel_avx2({list, nodes, &stencils, 1, constants, slot, force[1]}, law, x);
      ASSERT_TRUE(std::isfinite(force[0][0].x));
      ASSERT_EQ(std::memcmp(force[0], force[1], sizeof force[0]), 0) << i;
      if (!has_avx512()) continue;
      bending_kernel_avx512({list, nodes, &stencils, 1, constants, slot, force[2]}, law, x);
      ASSERT_EQ(std::memcmp(force[0], force[2], sizeof force[0]), 0) << i;
    }
  }
}

} // namespace
} // namespace plyform
