// SPDX-License-Identifier: GPL-3.0-or-later
// Laws with rates in the kernels against the same computed one triangle and one node after the
// other.
#include "core/ply/viscous_simd.hpp"
#include "support/bending_laws.hpp"
#include "support/membrane_checks.hpp"
#include "support/viscous_fabrics.hpp"
#include "support/viscous_reference.hpp"

#include <gtest/gtest.h>

namespace plyform::viscous_simd_test {
namespace {

std::vector<Vec3> unformed(const BlankMesh& mesh) {
  std::vector<Vec3> x;
  for (const Vec2& p : mesh.x)
    x.emplace_back(p.x(), p.y(), 0.0);
  return x;
}

/// 0.2 to 20: from slow to fast, as temperatures may have it.
std::vector<double> some_factors(std::size_t count, Random& random) {
  std::vector<double> factors;
  for (std::size_t i = 0; i < count; ++i)
    factors.push_back(2.0 * std::pow(10.0, signed_unit(random)));
  return factors;
}

/// Each number of `fast` is near that of `slow`, against the largest of its kind, of which there
/// are `size`.
void expect_near(const std::vector<double>& fast, const std::vector<double>& slow,
                 std::size_t size) {
  ASSERT_EQ(fast.size(), slow.size());
  std::vector<double> largest(size, 0.0);
  for (std::size_t i = 0; i < slow.size(); ++i)
    largest[i % size] = std::max(largest[i % size], std::abs(slow[i]));
  for (std::size_t i = 0; i < slow.size(); ++i)
    ASSERT_NEAR(fast[i], slow[i], 1e-10 * largest[i % size]) << i % size;
}

constexpr double softening = 1e4; // so that forces by rates count beside those of yarns

/// A membrane by both ways, with what they keep.
struct Both {
  Membrane m;
  ViscousMembrane v;
  MembraneSimd simd;
  PackedStates packed, factors;
  std::vector<double> states, of_triangles;

  Both(const BlankMesh& mesh, const Fabric& fabric, ElementKind kind, bool heated, Random& random)
      : m(make_membrane(mesh, fabric, 0.4, kind, softening)), v(*make_viscous(m, 10.0)),
        simd(make_membrane_simd(m, unformed(mesh))) {
    states.assign(m.triangles.size() * v.states, 0.0);
    packed.assign(simd.triangles->size() * v.states, {});
    if (!heated) return;
    of_triangles = some_factors(m.triangles.size(), random);
    factors.assign(simd.triangles->size(), {{1.0, 1.0, 1.0, 1.0}});
    pack(simd, m, of_triangles, factors);
  }

  void step_to(const std::vector<Vec3>& x, double dt) {
    std::vector<ElementForce> elastic(m.triangles.size()), q = elastic;
    std::vector<YarnMemory> yarns = memory_at_start(m);
    std::vector<SimdYarnStates> of_packs = states_at_start(simd, m);
    std::vector<double> next = states;
    element_forces(m, x, 0.0, 0, m.groups(), {yarns, yarns}, elastic);
    viscous_forces(v, m, x, dt, 0, m.groups(), {states, next, of_triangles}, q);
    states = next;
    const PackedStates before = packed;
    const KernelViscous viscous = kernel_viscous(v, m, simd, {dt, before, packed, factors});
    for (std::size_t b = 0; b < simd.blocks.size(); ++b)
      simd_forces(simd, m, x, 0.0, static_cast<int>(b), {of_packs, of_packs}, &viscous);
    std::vector<Vec3> slow, by_rates;
    for (std::size_t n = 0; n < x.size(); ++n) {
      by_rates.push_back(node_force(m, q, static_cast<int>(n)));
      slow.push_back(node_force(m, elastic, static_cast<int>(n)) + by_rates.back());
    }
    ASSERT_TRUE(dt == 0.0 || largest_norm(by_rates) > 1e-4 * largest_norm(slow))
        << largest_norm(by_rates) / largest_norm(slow);
    for (std::size_t n = 0; n < x.size(); ++n)
      ASSERT_LE((simd_force(simd, n) - slow[n]).norm(), 1e-11 * largest_norm(slow)) << n;
    expect_near(by_triangles(simd, m, packed, v.states), states, v.states);
  }
};

TEST(ViscousSimd, MembranesAgreeWithTrianglesOneByOne) {
  Random random(31);
  for (const Fabric& fabric : viscous_fabrics())
    for (const ElementKind kind : {ElementKind::plain, ElementKind::averaged})
      for (const bool heated : {false, true})
        for (int i = 0; i < 5; ++i) {
          const BlankMesh mesh = irregular_mesh(random);
          Both both(mesh, fabric, kind, heated, random);
          for (const double dt : {0.0, 0.3, 1e-4, 0.05}) {
            const std::vector<Vec3> x = random_state(mesh, 1.0, 0.1, random);
            both.step_to(x, dt);
            ASSERT_FALSE(HasFailure()) << fabric.name << " " << i << " " << dt;
          }
        }
}

TEST(ViscousSimd, MembranesOfManyBlocksAgreeToo) {
  Random random(32);
  const BlankMesh mesh = mesh_blank(rectangle(150.0, 100.0, 4.0, MeshKind::free), 0.0, 1.4);
  for (const Fabric& fabric : viscous_fabrics()) {
    Both both(mesh, fabric, ElementKind::averaged, true, random);
    both.step_to(random_state(mesh, 1.0, 0.1, random), 0.1);
    both.step_to(random_state(mesh, 1.0, 0.1, random), 0.1);
  }
}

/// Weaves with one and with both families viscous, three families, and what is viscous alone.
std::vector<BendingLaw> viscous_bending_laws() {
  BendingLaw both = weave_bending(), one, three, alone, table;
  both.families[0].law.stiffness = 5.0, both.families[1].law.stiffness = 0.5;
  both.families[0].viscosity = 2.0, both.families[1].viscosity = 0.3;
  one = both, one.families[0].viscosity = 0.0, one.families[1].in_plane = 3.0;
  three = both, three.families.push_back({Vec2(-0.6, 1.1), {1.0, {}, {}}, 4.0, 0.7});
  alone = both, alone.families[0].law.stiffness = alone.families[1].law.stiffness = 0.0;
  table = both, table.families[1].law = {0.0, {0.0, 0.01, 0.03}, {0.0, 0.05, 0.07}};
  return {both, one, three, alone, table};
}

TEST(ViscousSimd, BendingAgreesWithNodesOneByOne) {
  Random random(33);
  for (const BendingLaw& law : viscous_bending_laws())
    for (const bool heated : {false, true}) {
      const BlankMesh mesh = mesh_blank(rectangle(150.0, 100.0, 7.0, MeshKind::free), 0.0, 1.4);
      const std::vector<double> masses(mesh.x.size(), 1e-8);
      const Bending b = make_bending(mesh.x, mesh.triangles, law, 0.3, 1.55, masses);
      const ViscousBending v = *make_viscous_bending(b, masses, 1e12);
      BendingSimd simd = make_bending_simd(b, unformed(mesh));
      std::vector<double> states(mesh.x.size() * v.states(), 0.0), next = states, of_nodes;
      PackedStates packed(simd.stencils.size() * v.states()), factors;
      if (heated) {
        of_nodes = some_factors(mesh.x.size(), random);
        factors.assign(simd.stencils.size(), {{1.0, 1.0, 1.0, 1.0}});
        pack(simd, of_nodes, factors);
      }
      for (const double dt : {0.0, 0.3, 1e-4, 0.05}) {
        const std::vector<Vec3> x = random_state(mesh, 1.0, 0.3, random);
        std::vector<Vec3> force(x.size());
        viscous_bending_forces(v, b, x, dt, states, next, force, of_nodes);
        states.swap(next);
        ASSERT_TRUE(dt == 0.0 || largest_norm(force) > 0.0);
        const std::vector<Vec3> elastic = reference_bending_forces(b, x);
        const PackedStates before = packed;
        const KernelViscousBending viscous = kernel_viscous(v, {dt, before, packed, factors});
        for (std::size_t i = 0; i < simd.blocks.size(); ++i)
          bending_forces(simd, x, static_cast<int>(i), &viscous);
        const double scale = std::max(largest_norm(force), largest_norm(elastic));
        for (std::size_t n = 0; n < x.size(); ++n)
          ASSERT_LE((simd_force(simd, n) - force[n] - elastic[n]).norm(), 1e-10 * scale) << n;
        expect_near(by_nodes(simd, x.size(), packed, v.states()), states, v.states());
      }
    }
}

} // namespace
} // namespace plyform::viscous_simd_test
