// SPDX-License-Identifier: GPL-3.0-or-later
// The kernel against bending computed one node after the other.
#include "base/cpu_features.hpp"
#include "core/ply/bending_simd.hpp"
#include "core/ply/viscous_simd.hpp"
#include "support/bending_laws.hpp"
#include "support/bending_reference.hpp"
#include "support/membrane_checks.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>

namespace plyform::bending_simd_test {
namespace {

constexpr double warp = 0.3, weft = 1.55; // rad

BendingLaw cloth() {
  BendingLaw law = weave_bending();
  law.families[0].law.stiffness = 5.0; // N mm
  law.families[1].law.stiffness = 0.5;
  law.coupling = 0.2;
  law.twist = 0.3;
  return law;
}

/// Alone and together: bending out of the sheet by line and by table, and in it.
std::vector<BendingLaw> laws() {
  BendingLaw table = cloth(), both = cloth(), in_plane = weave_bending();
  table.families[1].law.curvature = {0.0, 0.01, 0.03};              // 1/mm
  table.families[1].law.moment = {0.0, 0.05, 0.07};                 // N
  both.families[0].in_plane = 8.0, both.families[1].in_plane = 2.0; // N mm
  in_plane.families[0].in_plane = 0.0, in_plane.families[1].in_plane = 3.0;
  BendingLaw all = table;
  for (std::size_t a = 0; a < 2; ++a)
    all.families[a].in_plane = both.families[a].in_plane;
  BendingLaw three = all, oblique = cloth(), one;
  three.families.push_back({Vec2(-0.6, 1.1), table.families[1].law, 4.0});
  oblique.families.push_back({Vec2(0.8, 0.5), {1.5, {}, {}}, 0.0});
  one.families = {{Vec2::UnitX(), {2.0, {}, {}}, 3.0}};
  return {cloth(), table, both, in_plane, all, three, oblique, one};
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

/// A part and all its images at planes as one sheet: its nodes first.
struct WholeSheet {
  BlankMesh mesh;
  std::vector<std::pair<std::size_t, std::size_t>> of; ///< of each node: that of the part, mirror
};

WholeSheet whole_of(const BlankMesh& part, const std::vector<SymmetryPlane>& planes) {
  WholeSheet whole;
  const std::vector<Mirror> mirrors = images_at(planes);
  for (std::size_t i = 0; i < mirrors.size(); ++i) {
    std::vector<std::int32_t> number;
    for (std::size_t n = 0; n < part.x.size(); ++n) {
      const Vec2 x = mirrors[i].place({part.x[n].x(), part.x[n].y(), 0.0}).head<2>();
      std::size_t k = 0;
      while (k < whole.mesh.x.size() && (whole.mesh.x[k] - x).norm() > 1e-9)
        ++k;
      if (k == whole.mesh.x.size()) whole.mesh.x.push_back(x), whole.of.emplace_back(n, i);
      number.push_back(static_cast<std::int32_t>(k));
    }
    for (const auto& [a, b, c] : part.triangles) {
      Triangle& t =
          whole.mesh.triangles.emplace_back(Triangle{number[at(a)], number[at(b)], number[at(c)]});
      if (mirrors[i].turns_round()) std::swap(t[1], t[2]);
    }
  }
  return whole;
}

TEST(BendingSimd, APartSeesItsImagesBeyondPlanesOfSymmetry) {
  const double slant = std::numbers::sqrt2 / 2.0;
  const std::vector<SymmetryPlane> middle = {{{2.0, 0.0}, {1.0, 0.0}}, {{0.0, 1.0}, {0.0, 1.0}}},
                                   slanted = {{{0.0, 0.0}, {slant, slant}}};
  BlankSpec square;
  square.outline.boundary = {{2, 1}, {42, 1}, {42, 31}, {2, 31}};
  square.element_size = 4.0;
  BlankSpec corner = square;
  corner.outline.boundary = {{-30, 30}, {30, -30}, {30, 30}};
  Random random(17);
  for (const auto& [spec, at_planes] : {std::pair(square, middle), std::pair(corner, slanted)})
    for (const MeshKind kind : {MeshKind::crossed, MeshKind::free})
      for (const BendingLaw& law : {laws()[1], laws()[4], laws()[5]}) {
        const std::vector<SymmetryPlane> planes = at_planes;
        BlankSpec of = spec;
        of.mesh = kind;
        const BlankMesh part = mesh_blank(of, warp, weft);
        const WholeSheet whole = whole_of(part, planes);
        std::vector<Vec3> x = random_state(part, 1.02, 0.3, random);
        std::vector<unsigned> on(x.size(), 0);
        for (std::size_t n = 0; n < x.size(); ++n)
          for (std::size_t k = 0; k < planes.size(); ++k)
            if (lies_on(planes[k], part.x[n])) {
              on[n] |= 1U << k;
              const Vec3 normal = normal_of(planes[k]);
              const Vec3 point(planes[k].point.x(), planes[k].point.y(), 0.0);
              x[n] -= (x[n] - point).dot(normal) * normal;
            }
        const std::vector<double> mass(part.x.size(), 1e-8), masses(whole.of.size(), 1e-8);
        const Bending b = make_bending(part.x, part.triangles, law, warp, weft, mass, planes);
        const Bending c = make_bending(whole.mesh.x, whole.mesh.triangles, law, warp, weft, masses);
        BendingSimd one = make_bending_simd(b, unformed(part));
        const std::vector<Vec3> force = by_simd(one, x);
        const double scale = largest_norm(force);
        for (std::size_t s = 0; s < part.x.size(); ++s) // as many nodes as in the whole
          ASSERT_EQ(b.begin[s + 1] - b.begin[s], c.begin[s + 1] - c.begin[s]) << s;
        // energy falls by the work of the forces, images moving along
        std::vector<Vec3> way(x.size());
        for (std::size_t n = 0; n < x.size(); ++n)
          way[n] = 1e-4 * random_vector(random);
        const auto moved = [&](double by) {
          std::vector<Vec3> y = x;
          for (std::size_t n = 0; n < x.size(); ++n) {
            Vec3 step = by * way[n];
            for (std::size_t k = 0; k < planes.size(); ++k)
              if (on[n] >> k & 1U) step -= step.dot(normal_of(planes[k])) * normal_of(planes[k]);
            y[n] += step;
          }
          return y;
        };
        double work = 0.0;
        const std::vector<Vec3> ahead = moved(1.0), back = moved(-1.0);
        for (std::size_t n = 0; n < x.size(); ++n)
          work += force[n].dot(ahead[n] - back[n]);
        const double change = bending_energy(one, back) - bending_energy(one, ahead);
        EXPECT_NEAR(work, change, 1e-5 * scale * 1e-4 * static_cast<double>(x.size()));
      }
}

TEST(BendingSimd, AQuarterHasAQuarterOfTheForces) {
  const std::vector<SymmetryPlane> planes = {{{0.0, 0.0}, {1.0, 0.0}}, {{0.0, 0.0}, {0.0, 1.0}}};
  BlankSpec spec;
  spec.outline.boundary = {{0, 0}, {40, 0}, {40, 30}, {0, 30}};
  spec.element_size = 4.0;
  Random random(18);
  for (const MeshKind kind : {MeshKind::crossed, MeshKind::free, MeshKind::diagonal}) {
    spec.mesh = kind;
    const BlankMesh part = mesh_blank(spec, 0.0, 0.5 * std::numbers::pi);
    const WholeSheet whole = whole_of(part, planes);
    const std::vector<Mirror> mirrors = images_at(planes);
    for (const BendingLaw& law : {laws()[0], laws()[1], laws()[3], laws()[4]}) {
      std::vector<Vec3> x = random_state(part, 1.02, 0.3, random);
      for (std::size_t n = 0; n < x.size(); ++n)
        for (int k = 0; k < 2; ++k)
          if (std::abs(part.x[n][k]) < 1e-9) x[n][k] = 0.0;
      std::vector<Vec3> all;
      for (const auto& [n, mirror] : whole.of)
        all.push_back(mirrors[mirror].place(x[n]));
      const std::vector<double> mass(part.x.size(), 1e-8), masses(whole.of.size(), 1e-8);
      const double across = 0.5 * std::numbers::pi;
      BendingSimd one = make_bending_simd(
                      make_bending(part.x, part.triangles, law, 0.0, across, mass, planes),
                      unformed(part)),
                  other = make_bending_simd(
                      make_bending(whole.mesh.x, whole.mesh.triangles, law, 0.0, across, masses),
                      unformed(whole.mesh));
      const double energy = bending_energy(other, all);
      EXPECT_NEAR(4.0 * bending_energy(one, x), energy, 1e-9 * energy);
      const std::vector<Vec3> of_part = by_simd(one, x), of_whole = by_simd(other, all);
      const double scale = largest_norm(of_whole);
      for (std::size_t n = 0; n < x.size(); ++n) {
        Vec3 force = of_part[n];
        for (int k = 0; k < 2; ++k) // of a node on a plane half is the part's
          if (std::abs(part.x[n][k]) < 1e-9) force *= 2.0, force[k] = 0.0;
        EXPECT_LE((force - of_whole[n]).norm(), 1e-9 * scale) << n;
      }
    }
  }
}

/// A block of groups of four stencils. Most successive groups have as many slots; some have more
/// than are computed together.
struct StencilBlock {
  static constexpr std::int32_t nodes = 8;
  std::vector<SimdStencils> stencils;
  std::vector<SimdNumbers> constants; // as many as with bending in the plane
  std::vector<SimdNumbers> in_plane;  // of as many families as there can be
  std::vector<std::uint16_t> slots;
  std::vector<double> x;

  StencilBlock(Random& random, int groups, int families) {
    for (int n = 0; n < 3 * nodes; ++n)
      x.push_back(3.0 * signed_unit(random));
    constexpr std::array<std::int32_t, 2> sizes[] = {{5, 7}, {5, 7}, {5, 7},
                                                     {6, 7}, {5, 6}, {5, 70}};
    for (int g = 0; g < groups; ++g) {
      const auto [ring, slot_count] = sizes[random() % std::size(sizes)];
      SimdStencils& p = stencils.emplace_back();
      p.ring = ring, p.slots = slot_count;
      for (int a = 0; a < families; ++a)
        for (double& stiffness : in_plane.emplace_back().of)
          stiffness = 8.0 - 3.0 * a;
      for (std::size_t lane = 0; lane < simd_width; ++lane) {
        p.area[lane] = 2.0 + signed_unit(random);
        p.own[lane] = node(lane + random() % 2);
      }
      for (std::int32_t k = 0; k < slot_count; ++k)
        for (std::size_t lane = 0; lane < simd_width; ++lane)
          slots.push_back(node(std::size_t(k) + lane + 1));
      for (std::int32_t k = 0; k < 5 * slot_count; ++k)
        for (double& c : constants.emplace_back().of)
          c = signed_unit(random);
    }
  }

  static std::uint16_t node(std::size_t number) {
    return static_cast<std::uint16_t>(sizeof(SimdForce) * (number % nodes));
  }

  /// viscous: the first family, from some states on, whose ends are `states`.
  template <class Kernel>
  std::array<SimdForce, nodes> forces(const Kernel& kernel, BendingKernelLaw law, bool viscous,
                                      PackedStates& states) const {
    const std::int32_t list[nodes] = {0, 1, 2, 3, 4, 5, 6, 7};
    std::array<SimdForce, nodes> force;
    const PackedStates begin(3 * stencils.size(), {{0.1, -0.2, 0.3, 0.0}});
    const PackedStates factors(stencils.size(), {{1.0, 0.5, 2.0, 1.0}});
    states.assign(begin.size(), {});
    const KernelViscousBending rates{
        1.0, 1, {0}, {2.0}, {5.0, 0.2, 0.5}, 3, begin.data(), states.data(), factors.data()};
    if (viscous) law.viscous = &rates;
    kernel({list, nodes, stencils.data(), int(stencils.size()), constants.data(), slots.data(),
            in_plane.data(), force.data()},
           law, x.data());
    return force;
  }
};

void saturating(const BendingKernelLaw&, int family, const double* kappa, double* moment) {
  for (int i = 0; i < simd_width; ++i)
    moment[i] = (1.0 + family) * kappa[i] / (1.0 + std::abs(kappa[i]));
}

/// A law of two families along the axes, or of one or three.
BendingKernelLaw kernel_law(int families, bool table, bool in_plane) {
  BendingKernelLaw law{{5.0, 0.5},    0.2,   {0.0, 0.0}, 0.3,     families, {},
                       families == 2, table, in_plane,   nullptr, nullptr,  saturating};
  if (!law.weave) law.oblique[0] = 0.1, law.oblique[1] = -0.2;
  const Vec2 along[] = {Vec2::UnitX(), Vec2::UnitY(), Vec2(-1.0, 1.0)};
  for (int a = 0; a < families; ++a) {
    const Vec3 p = FamilyBending{along[a], {}, 0.0}.of_axes();
    law.family[a] = {{along[a].x(), along[a].y()}, {p[0], p[1], p[2]}, table};
  }
  return law;
}

/// All copies of the kernel: no processor answers differently.
TEST(BendingSimd, GiveTheSameBitsOnEveryProcessor) {
  if (!has_avx2()) GTEST_SKIP() << "this processor has no AVX2";
  Random random(8);
  for (int i = 0; i < 200; ++i) {
    const int families = 1 + i % 3;
    const StencilBlock block(random, 1 + i % 9, families);
    for (const bool in_plane : {false, true})
      for (const bool table : {false, true}) {
        const BendingKernelLaw law = kernel_law(families, table, in_plane);
        const bool viscous = i % 2 == 0;
        PackedStates states, other;
        const auto same_states = [&] {
          return std::memcmp(states.data(), other.data(), states.size() * sizeof(SimdNumbers)) == 0;
        };
        const auto generic = block.forces(bending_kernel_generic, law, viscous, states);
        const auto avx2 = block.forces(bending_kernel_avx2, law, viscous, other);
        ASSERT_TRUE(std::isfinite(generic[0].x));
        ASSERT_EQ(viscous, states[2].of[0] != 0.0); // a moment
        ASSERT_EQ(std::memcmp(&generic, &avx2, sizeof generic), 0) << i;
        ASSERT_TRUE(same_states()) << i;
        if (!has_avx512()) continue;
        const auto avx512 = block.forces(bending_kernel_avx512, law, viscous, other);
        ASSERT_EQ(std::memcmp(&generic, &avx512, sizeof generic), 0) << i;
        ASSERT_TRUE(same_states()) << i;
      }
  }
}

} // namespace
} // namespace plyform::bending_simd_test
