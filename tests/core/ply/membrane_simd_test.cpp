// SPDX-License-Identifier: GPL-3.0-or-later
// The kernel against the membrane computed one triangle after the other.
#include "base/cpu_features.hpp"
#include "core/ply/membrane_simd.hpp"
#include "core/ply/viscous_simd.hpp"
#include "support/membrane_checks.hpp"

#include <cstring>
#include <gtest/gtest.h>

namespace plyform::membrane_simd_test {
namespace {

/// Table laws that bend, and yarns that bear some compression.
Fabric table_weave() {
  Fabric f = glass_weave();
  f.families[1].angle = 1.2;
  f.families[0].tension.strain = {0.0, 0.002, 0.01};
  f.families[0].tension.tension = {0.0, 20.0, 400.0};
  f.families[1].tension.compression = 50.0;
  f.crossings[0].shear.angle = {0.0, 0.3, 0.9};
  f.crossings[0].shear.torque = {0.0, 0.1, 1.2};
  f.crossings[0].shear.k.clear();
  return f;
}

/// Yarns that buckle: the warp by numbers, the weft by a table too.
Fabric buckling_weave(bool table) {
  Fabric f = table ? table_weave() : glass_weave();
  f.families[0].tension.compression = 300.0;
  f.families[0].tension.buckling_force = 12.0; // at a strain of 0.04
  f.families[1].tension.compression = 50.0;
  if (table) f.families[1].tension.buckling_force = 4.0;
  return f;
}

struct Sums {
  std::vector<Vec3> force;
  double work = 0.0, torn = 0.0;
  bool collapsed = false;
};

Sums by_simd(MembraneSimd& simd, const Membrane& m, const std::vector<Vec3>& x, double dt,
             std::vector<SimdYarnStates>& states) {
  Sums sums;
  for (int b = 0; b < static_cast<int>(simd.blocks.size()); ++b) {
    const GroupReport report = simd_forces(simd, m, x, dt, b, {states, states});
    sums.work += report.lost, sums.torn += report.torn;
    sums.collapsed |= report.collapsed;
  }
  for (std::size_t n = 0; n < x.size(); ++n)
    sums.force.push_back(simd_force(simd, n));
  return sums;
}

Sums one_by_one(const Membrane& m, const std::vector<Vec3>& x, double dt,
                std::vector<YarnMemory>& states) {
  std::vector<ElementForce> q(m.triangles.size());
  const GroupReport report = element_forces(m, x, dt, 0, m.groups(), {states, states}, q);
  Sums sums{{}, report.lost, report.torn, report.collapsed};
  for (std::size_t n = 0; n < x.size(); ++n)
    sums.force.push_back(node_force(m, q, static_cast<int>(n)));
  return sums;
}

void expect_near(const Sums& fast, const Sums& slow) {
  double largest = 0.0;
  for (const Vec3& f : slow.force)
    largest = std::max(largest, f.norm());
  ASSERT_GT(largest, 0.0);
  // strains of 1e-3 and less keep twelve digits of stretches of one
  for (std::size_t n = 0; n < slow.force.size(); ++n)
    ASSERT_LE((fast.force[n] - slow.force[n]).norm(), 1e-11 * largest) << n;
  EXPECT_NEAR(fast.work, slow.work, 1e-11 * std::abs(slow.work) + 1e-13);
  EXPECT_NEAR(fast.torn, slow.torn, 1e-11 * slow.torn);
  EXPECT_EQ(fast.collapsed, slow.collapsed);
}

TEST(MembraneSimd, AgreeWithTheMembraneOneByOne) {
  Random random(11);
  double torn = 0.0;
  for (const Fabric& fabric :
       {glass_weave(), table_weave(), buckling_weave(false), buckling_weave(true), unidirectional(),
        triaxial(), stitched(), rubber(), breaking(false), breaking(true)})
    for (const ElementKind kind : {ElementKind::plain, ElementKind::averaged})
      for (int i = 0; i < 20; ++i) {
        const BlankMesh mesh = irregular_mesh(random);
        Membrane m = make_membrane(mesh, fabric, 0.4, kind);
        set_viscosity(m, {0.02, 0.03, 0.01});
        std::vector<Vec3> x0;
        for (const Vec2& p : mesh.x)
          x0.emplace_back(p.x(), p.y(), 0.0);
        MembraneSimd simd = make_membrane_simd(m, x0);
        std::vector<SimdYarnStates> of_packs = states_at_start(simd, m);
        std::vector<YarnMemory> of_groups = memory_at_start(m);
        for (const double dt : {0.0, 1e-5, 2e-5}) { // the state of the viscosity goes along
          const double stretch = i % 3 == 2 ? 0.85 : i % 3 ? 1.0 : 1.1;
          const std::vector<Vec3> x = random_state(mesh, stretch, 0.3, random);
          const Sums fast = by_simd(simd, m, x, dt, of_packs);
          expect_near(fast, one_by_one(m, x, dt, of_groups));
          torn += fast.torn;
        }
      }
  EXPECT_GT(torn, 0.0);
}

/// A force that is asked for twice, as a line search does, is the same, and no step is taken.
TEST(MembraneSimd, EvaluatingTwiceIsHarmless) {
  Random random(21);
  for (const Fabric& fabric : {glass_weave(), table_weave(), buckling_weave(true), triaxial(),
                               breaking(false), breaking(true)}) {
    const BlankMesh mesh = irregular_mesh(random);
    Membrane m = make_membrane(mesh, fabric, 0.4, ElementKind::averaged);
    set_viscosity(m, {0.02, 0.03, 0.01});
    std::vector<Vec3> x0;
    for (const Vec2& p : mesh.x)
      x0.emplace_back(p.x(), p.y(), 0.0);
    MembraneSimd simd = make_membrane_simd(m, x0);
    std::vector<SimdYarnStates> begin = states_at_start(simd, m), end = begin;
    const auto evaluate = [&](const std::vector<Vec3>& x) {
      const GroupReport report = simd_forces(simd, m, x, 1e-5, 0, {begin, end});
      EXPECT_EQ(simd.blocks.size(), 1u);
      return std::pair(report.lost + report.torn, simd_force(simd, 3));
    };
    evaluate(random_state(mesh, 1.05, 0.1, random));
    begin.swap(end); // a step is taken
    const std::vector<Vec3> x = random_state(mesh, 1.1, 0.1, random);
    const auto before = begin;
    const auto once = evaluate(x);
    const auto state = end;
    evaluate(random_state(mesh, 1.2, 0.3, random)); // a try that comes to nothing
    const auto twice = evaluate(x);
    const std::size_t bytes = begin.size() * sizeof(SimdYarnStates);
    EXPECT_GT(once.first, 0.0);
    EXPECT_EQ(once.first, twice.first);
    EXPECT_EQ(once.second, twice.second);
    EXPECT_EQ(std::memcmp(state.data(), end.data(), bytes), 0);
    EXPECT_EQ(std::memcmp(before.data(), begin.data(), bytes), 0);
  }
}

TEST(MembraneSimd, EnergyAgreesWithTheMembraneOneByOne) {
  Random random(12);
  Fabric long_law = glass_weave(); // a polynomial longer than the kernel's own
  long_law.crossings[0].shear.k.assign(most_shear_terms + 1, 0.1);
  for (const Fabric& fabric : {glass_weave(), table_weave(), long_law, buckling_weave(false),
                               buckling_weave(true), breaking(false), breaking(true)})
    for (const ElementKind kind : {ElementKind::plain, ElementKind::averaged})
      for (int i = 0; i < 20; ++i) {
        const BlankMesh mesh = irregular_mesh(random);
        const Membrane m = make_membrane(mesh, fabric, 0.3, kind);
        // states of wide stretches: the guard acts in some
        const std::vector<Vec3> x = random_state(mesh, i % 2 ? 0.45 : 1.1, 0.3, random);
        const MembraneSimd simd = make_membrane_simd(m, x);
        MembraneEnergy sum;
        for (int b = 0; b < static_cast<int>(simd.blocks.size()); ++b) {
          const MembraneEnergy e = simd_energy(simd, m, x, 0.0, b, states_at_start(simd, m));
          sum.fibre += e.fibre, sum.shear += e.shear, sum.stitch += e.stitch;
        }
        const MembraneEnergy slow = membrane_energy(m, x);
        ASSERT_GT(slow.fibre, 0.0);
        ASSERT_GT(slow.shear, 0.0);
        EXPECT_NEAR(sum.fibre, slow.fibre, 1e-12 * slow.fibre); // sums of positive terms
        EXPECT_NEAR(sum.shear, slow.shear, 1e-12 * slow.shear);
        EXPECT_NEAR(sum.stitch, slow.stitch, 1e-12 * slow.stitch);
      }
}

TEST(MembraneSimd, ManyBlocksHoldEveryTriangleOnce) {
  const BlankMesh mesh = mesh_blank(rectangle(300.0, 200.0, 4.0), 0.0, 1.5);
  BlankMesh half = mesh; // one half along the yarns: pairs and singles in the same block
  Random random(4);
  for (Vec2& p : half.x)
    if (p.x() > 8.0 && p.x() < 140.0 && std::abs(p.y()) < 90.0)
      p += 1.0 * Vec2(signed_unit(random), signed_unit(random));
  Membrane m = make_membrane(half, glass_weave(), 0.0, ElementKind::automatic);
  std::vector<Vec3> x0, x;
  for (const Vec2& p : half.x)
    x0.emplace_back(p.x(), p.y(), 0.0);
  MembraneSimd simd = make_membrane_simd(m, x0);
  ASSERT_GT(simd.blocks.size(), 8u);
  int pairs = 0, singles = 0;
  for (const SimdBlock& b : simd.blocks) {
    EXPECT_LE(b.nodes, most_block_nodes);
    pairs += b.pair_packs, singles += b.single_packs;
  }
  EXPECT_GT(pairs, 0);
  EXPECT_GT(singles, 0);
  for (const Vec3& p : x0)
    x.emplace_back(1.01 * p.x() + 0.3 * p.y(), 1.02 * p.y(), 0.01 * p.x() * p.y() / 100.0);
  std::vector<SimdYarnStates> of_packs = states_at_start(simd, m);
  std::vector<YarnMemory> of_groups = memory_at_start(m);
  expect_near(by_simd(simd, m, x, 0.0, of_packs), one_by_one(m, x, 0.0, of_groups));
}

TEST(MembraneSimd, SeeTrianglesCollapse) {
  Random random(3);
  const BlankMesh mesh = irregular_mesh(random);
  Membrane m = make_membrane(mesh, glass_weave(), 0.3, ElementKind::plain);
  std::vector<Vec3> x;
  for (const Vec2& p : mesh.x)
    x.emplace_back(p.x(), p.y(), 0.0);
  MembraneSimd simd = make_membrane_simd(m, x);
  std::vector<SimdYarnStates> states = states_at_start(simd, m);
  EXPECT_FALSE(by_simd(simd, m, x, 0.0, states).collapsed);
  std::vector<Vec3> flat = x, lost = x;
  for (Vec3& p : flat)
    p = Vec3(p.x(), p.x(), p.x() * 1e-3);
  EXPECT_TRUE(by_simd(simd, m, flat, 0.0, states).collapsed);
  lost[5].x() = std::nan("");
  EXPECT_TRUE(by_simd(simd, m, lost, 0.0, states).collapsed);
}

/// What a copy of the kernel makes of a block of some packs of pairs and of single triangles.
struct KernelRun {
  alignas(32) SimdForce force[6] = {};
  std::vector<SimdYarnStates> viscosity;
  PackedStates rates;
  KernelReport report{};
  KernelEnergy energy{};

  void expect_same(const KernelRun& other) const {
    EXPECT_EQ(report.lost, other.report.lost);
    EXPECT_EQ(report.torn, other.report.torn);
    EXPECT_EQ(report.collapsed, other.report.collapsed);
    EXPECT_EQ(std::memcmp(force, other.force, sizeof force), 0);
    EXPECT_EQ(std::memcmp(viscosity.data(), other.viscosity.data(),
                          viscosity.size() * sizeof(SimdYarnStates)),
              0);
    EXPECT_EQ(std::memcmp(rates.data(), other.rates.data(), rates.size() * sizeof(SimdNumbers)), 0);
    EXPECT_EQ(energy.fibre, other.energy.fibre);
    EXPECT_EQ(energy.shear, other.energy.shear);
    EXPECT_EQ(energy.stitch, other.energy.stitch);
  }
};

/// Stresses of a sheet that stiffens.
void stiffening_sheet(const KernelLaw&, const double* a, const double* b, const double* d,
                      SheetAnswers& out) {
  for (int i = 0; i < simd_width; ++i) {
    out.s11[i] = a[i] - 1.0, out.s22[i] = b[i] - 1.0, out.s12[i] = 0.3 * d[i];
    out.energy[i] = 0.5 * (out.s11[i] * out.s11[i] + out.s22[i] * out.s22[i]);
  }
}

/// Energies of crossings that the kernel does not know itself.
void energies_of_shear(const KernelLaw&, int crossing, const double* gamma, const double* measure2,
                       double* energy) {
  for (int i = 0; i < simd_width; ++i)
    energy[i] = measure2[i] * (1.0 + 0.1 * gamma[i] + crossing);
}

/// Laws of a weave, by turns with yarns that buckle or have crimp and with none to two directions
/// of stitches that break, or of three families, one of them askew, with two crossings, a sheet and
/// three directions of stitches.
KernelLaw kernel_law(int number) {
  constexpr double never = std::numeric_limits<double>::infinity();
  static const ShearInterval intervals[4] = {{0}, {0}, {1}, {1}}; // of 0.3 rad
  static const ShearPiece pieces[5] = {
      {0.0, {0.0, 0.05, 0.1, 0.1}, {0.0, 0.03, 0.01, 0.02}, 0.0},
      {0.4, {0.042, 0.178, 0.2, -0.1}, {0.015, 0.048, 0.0, 0.0}, 0.003},
      {1.1, {0.23, 0.3, 0.0, 0.0}, {0.049, 0.02, 0.0, 0.0}, 0.03},
      {never, {}, {}, 0.0},
      {never, {}, {}, 0.0}};
  KernelLaw law{};
  law.weave = number % 3 != 0;
  law.families = law.weave ? 2 : 3, law.crossings = law.weave ? 1 : 2, law.beta = 8.0;
  for (int a = 0; a < 3; ++a) {
    KernelYarns& yarns = law.yarns[a];
    yarns.along[0] = a == 0 ? 1.0 : -0.4 * (a - 1), yarns.along[1] = a == 0 ? 0.0 : 1.0;
    yarns.stiffness = 115.0, yarns.viscosity = 2.5e-4;
    yarns.stabilisation = 0.0025, yarns.collapse_penalty = 0.025;
  }
  if (number % 2) {
    KernelYarns& yarns = law.yarns[1];
    yarns.along[0] = 0.0, yarns.compression = 40.0;
    yarns.buckles = true, yarns.buckling_strain = 0.2, yarns.buckling_drop = 39.6;
  }
  law.stitches = law.weave ? number / 3 % 3 : 3;
  for (int a = law.families; a < law.families + law.stitches; ++a) {
    KernelYarns& stitches = law.yarns[a];
    stitches.along[0] = 0.7, stitches.along[1] = 0.3 * (a - 1);
    stitches.stiffness = 30.0, stitches.taut_at = 1.0 + 0.1 * (a - 2);
    stitches.breaks = a % 2 == 0, stitches.breaking = 20.0;
  }
  law.side_cubic = 0.48;
  law.crossing[0] = {0, 1,   0.1,   1.0, {0.022, 0.05, 0.062}, 3, false, {}, nullptr, nullptr,
                     0, 0.0, false, {}};
  law.crossing[1] = {2,       1,       0.4, 0.4, {0.03, 0.01}, 2, true, {0.02, 0.01},
                     nullptr, nullptr, 0,   0.0, false,        {}};
  const int table = number / 3 % 4; // no table, an odd one, one of both signs, polynomials of both
  if (table == 1 || table == 2)
    law.crossing[0] = {0,  1,      0.1,       1.0, {},        0,     table == 2,
                       {}, pieces, intervals, 4,   1.0 / 0.3, false, {}};
  if (table == 3) law.crossing[0].both_signs = true, law.crossing[0].even[1] = 0.04;
  law.shear_energy = energies_of_shear;
  if (number % 5 == 2) {
    law.crimped = law.crossing[0].crimped = true;
    law.crossing[0].cell = {{4.0, 5.0}, {4.02, 5.1}, 1.4, {28.0, 22.0}};
    law.yarns[0].stiffness = law.yarns[1].stiffness = 0.0;
  }
  law.sheet = !law.weave, law.sheet_law = stiffening_sheet;
  return law;
}

/// Viscosities of a crossing that the kernel does not know itself.
void thinning(const KernelViscous&, int index, const double* angle, const double* driven,
              const double* factor, double* c) {
  for (int i = 0; i < simd_width; ++i)
    c[i] = factor[i] * (1.0 + index + angle[i] * angle[i]) / (1.0 + std::abs(driven[i]));
}

/// Laws with rates beside such a law: dashpots of both kinds, branches and, unless it is a weave, a
/// melt.
KernelViscous kernel_rates(const KernelLaw& law) {
  KernelViscous v{};
  v.moves = 1.0, v.per_dt = 100.0, v.states = 1 + 3 * 5 + 3 * 3 + 9;
  v.crossings = law.crossings;
  const KernelSpring spring{5.0, 0.2, 0.05};
  for (int k = 0; k < v.crossings; ++k) {
    KernelViscousCrossing& c = v.crossing[k];
    c.crossing = k, c.first_state = k == 0 ? 1 : 15;
    c.dashpot = true, c.viscosity[0] = 0.4, c.viscosity[1] = 0.2, c.terms = k == 0 ? 2 : 0;
    c.shear = c.deviation = spring, c.smoothing = 0.1, c.cells = 0.06;
  }
  v.crossing[0].branch[0] = {2.0, 0.5, 0.9, 1.8, 0.1};
  v.crossing[0].branch[1] = {3.0, 1.0 / 3.0, 0.1, 1.2, 2.3};
  v.crossing[0].branches = 2;
  v.has_melt = !law.weave;
  v.melt = {{0.02, 0.01}, spring, 24, 0.2, {0.1, 0.9}};
  v.viscosity = thinning;
  return v;
}

/// All copies of the kernel: no processor answers differently, whether packs are computed one or
/// two at a time.
TEST(MembraneSimd, GiveTheSameBitsOnEveryProcessor) {
  if (!has_avx2()) GTEST_SKIP() << "this processor has no AVX2";
  Random random(8);
  for (int i = 0; i < 400; ++i) {
    const int pairs = i % 7, singles = (i / 7) % 11;
    if (pairs + singles == 0) continue;
    std::vector<SimdTriangles> t(static_cast<std::size_t>(2 * pairs + singles));
    double x[18];
    for (double& a : x)
      a = 3.0 * signed_unit(random);
    for (SimdTriangles& triangle : t)
      for (std::size_t lane = 0; lane < simd_width; ++lane) {
        triangle.c11[lane] = signed_unit(random), triangle.c12[lane] = signed_unit(random);
        triangle.c21[lane] = signed_unit(random), triangle.c22[lane] = signed_unit(random);
        triangle.area[lane] = 1.0 + signed_unit(random);
        triangle.share[lane] = 0.5;
        for (std::size_t k = 0; k < 3; ++k)
          triangle.node[k][lane] = static_cast<std::uint16_t>(sizeof(SimdForce) * ((k + lane) % 6));
      }
    KernelLaw law = kernel_law(i);
    KernelViscous rates = kernel_rates(law);
    const PackedStates begin(at(rates.states) * t.size(), {{0.1, 0.0, -0.2, 0.3}});
    const PackedStates factors(t.size(), {{1.0, 0.1, 3.0, 1.0}});
    rates.first = t.data(), rates.begin = begin.data();
    rates.factors = i % 4 == 0 ? factors.data() : nullptr;
    if (i % 2 == 0) law.viscous = &rates;
    const std::int32_t nodes[6] = {0, 1, 2, 3, 4, 5};
    SimdYarnStates state{};
    for (std::size_t lane = 0; lane < simd_width; ++lane)
      state.of[0][lane] = lane % 2 ? 1.0 : 0.0, state.of[1][lane] = 0.1; // of stitches: broken
    const auto run = [&](auto* forces, auto* energy) {
      KernelRun r;
      r.rates.assign(begin.size(), {});
      rates.end = r.rates.data();
      r.viscosity.assign(at((law.families + law.stitches) * (pairs + singles)), state);
      const KernelBlock block{nodes, 6,       t.data(), r.viscosity.data(), r.viscosity.data(),
                              pairs, singles, r.force};
      r.report = forces(block, law, x, 1e5);
      r.energy = energy(block, law, x, 1e5);
      return r;
    };
    const KernelRun generic = run(membrane_kernel_generic, membrane_energy_generic);
    ASSERT_TRUE(std::isfinite(generic.force[0].x));
    ASSERT_EQ(i % 2 == 0, generic.rates[4].of[0] != 0.0); // a torque
    ASSERT_GT(generic.energy.shear, 0.0);
    generic.expect_same(run(membrane_kernel_avx2, membrane_energy_avx2));
    if (has_avx512()) generic.expect_same(run(membrane_kernel_avx512, membrane_energy_avx512));
    ASSERT_FALSE(HasFailure()) << i;
  }
}

} // namespace
} // namespace plyform::membrane_simd_test
