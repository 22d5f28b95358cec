// SPDX-License-Identifier: GPL-3.0-or-later
// Sheets of rubber: closed forms at any stretch, forces from energy, the bound of their step.
#include "core/model/mooney_rivlin.hpp"
#include "core/ply/membrane.hpp"
#include "support/membrane_checks.hpp"
#include "support/pure_shear.hpp"
#include "support/sheet_stiffness.hpp"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

namespace plyform::mooney_rivlin_test {
namespace {

constexpr double thickness = 1.5; // mm

/// Neo-Hookean, Mooney-Rivlin, one with C01 alone, one whose C01 is negative; N/mm.
const MooneyRivlinLaw laws[] = {{0.3, 0.0}, {0.24, 0.06}, {0.0, 0.2}, {0.3, -0.01}};

Fabric rubber(const MooneyRivlinLaw& law) {
  Fabric f;
  f.name = "rubber";
  f.surface_density = 1.65e-9;
  f.thickness = thickness;
  f.sheet = law;
  return f;
}

double energy(const Membrane& m, const std::vector<Vec3>& x) {
  return membrane_energy(m, x).shear;
}

TEST(MooneyRivlin, HasTheClosedFormsOfUniaxialEquibiaxialAndPureShear) {
  for (const MooneyRivlinLaw& law : laws)
    for (const double l : {0.5, 0.9, 1.0 + 1e-7, 1.05, 1.5, 2.0, 3.0}) {
      const auto state = [&](double across) {
        return law.at(Vec3(0.0, l, 0.0), Vec3(0.0, 0.0, across));
      };
      const SheetResponse one = state(1.0 / std::sqrt(l)), both = state(l), held = state(1.0);
      const double scale = law.shear_modulus() * std::abs(l - 1.0);
      EXPECT_NEAR(l * one.s11, uniaxial_load(law, l), 1e-8 * scale) << l;
      EXPECT_NEAR(one.s22, 0.0, 1e-8 * scale) << l;
      EXPECT_NEAR(l * both.s11, equibiaxial_load(law, l), 1e-8 * scale) << l;
      EXPECT_NEAR(l * both.s22, equibiaxial_load(law, l), 1e-8 * scale) << l;
      EXPECT_NEAR(l * held.s11, pure_shear_load(law, l), 1e-8 * scale) << l;
      const auto wanted = [&](double l1, double l2) { // (W) by stretches
        const double l3 = 1.0 / (l1 * l2), a = l1 * l1, b = l2 * l2, c = l3 * l3;
        return law.c10 * (a + b + c - 3.0) + law.c01 * (a * b + b * c + c * a - 3.0);
      };
      if (std::abs(l - 1.0) < 1e-3) {
        const double e = l - 1.0; // E/2 e^2, E = 3 mu
        EXPECT_NEAR(one.energy, 1.5 * law.shear_modulus() * e * e, 1e-6 * one.energy);
        continue;
      }
      EXPECT_NEAR(one.energy, wanted(l, 1.0 / std::sqrt(l)), 1e-12 * std::abs(one.energy) + 1e-14);
      EXPECT_NEAR(both.energy, wanted(l, l), 1e-12 * std::abs(both.energy) + 1e-14);
    }
}

TEST(MooneyRivlin, ForceIsMinusEnergyGradientAtAnyStretch) {
  Random random(1);
  for (const MooneyRivlinLaw& law : laws)
    for (const double stretch : {0.8, 1.0, 1.5, 3.0}) {
      const BlankMesh mesh = irregular_mesh(random);
      Membrane m = make_membrane(mesh, rubber(law), 0.4, ElementKind::averaged);
      const std::vector<Vec3> x = random_state(mesh, stretch, 0.5, random);
      EXPECT_LT(gradient_error(m, x), 1e-6) << stretch;
    }
}

TEST(MooneyRivlin, OneElementHasTheClosedForms) {
  // A triangle askew to its axes: forces on its nodes from P = dW/dF of the closed form.
  for (const MooneyRivlinLaw& law : laws)
    for (const double l : {1.1, 2.0, 3.0})
      for (const int kind : {0, 1, 2}) { // uniaxial, equibiaxial, pure shear
        BlankMesh mesh = mesh_blank(rectangle(10.0, 10.0, 10.0), 0.0, 0.5 * std::numbers::pi);
        Membrane m = make_membrane(mesh, rubber(law), 0.7, ElementKind::plain);
        const double across = kind == 0 ? 1.0 / std::sqrt(l) : kind == 1 ? l : 1.0;
        const double load = kind == 0   ? uniaxial_load(law, l)
                            : kind == 1 ? equibiaxial_load(law, l)
                                        : pure_shear_load(law, l);
        const double side = law.at({l, 0, 0}, {0, across, 0}).s22 * across;
        std::vector<Vec3> x;
        for (const Vec2& p : mesh.x)
          x.emplace_back(l * p.x(), across * p.y(), 0.0);
        const std::vector<Vec3> f = nodal_forces(m, x);
        double pull = 0.0, other = 0.0;
        for (std::size_t n = 0; n < f.size(); ++n) {
          if (mesh.x[n].x() > 0.0) pull -= f[n].x();
          if (mesh.x[n].y() > 0.0) other -= f[n].y();
        }
        EXPECT_NEAR(pull, 10.0 * load, 1e-6 * 10.0 * load) << l << kind;
        EXPECT_NEAR(other, 10.0 * side, 1e-6 * 10.0 * load) << l << kind;
        if (kind == 0) {
          EXPECT_NEAR(other, 0.0, 1e-6 * 10.0 * load);
        }
      }
}

TEST(MooneyRivlin, DoesNotSeeRotationsNorItsAxes) {
  Random random(2);
  const BlankMesh mesh = irregular_mesh(random);
  const std::vector<Vec3> x = random_state(mesh, 2.0, 0.5, random);
  for (const MooneyRivlinLaw& law : laws) {
    Membrane m = make_membrane(mesh, rubber(law), 0.0, ElementKind::plain);
    const std::vector<Vec3> f = nodal_forces(m, x);
    Membrane other = make_membrane(mesh, rubber(law), 1.1, ElementKind::plain);
    const Eigen::Matrix3d turn = random_rotation(random);
    std::vector<Vec3> turned;
    for (const Vec3& p : x)
      turned.push_back(turn * p);
    const std::vector<Vec3> g = nodal_forces(other, turned);
    for (std::size_t n = 0; n < f.size(); ++n)
      EXPECT_LE((g[n] - turn * f[n]).norm(), 1e-11 * largest_norm(f));
    EXPECT_NEAR(energy(other, turned), energy(m, x), 1e-11 * energy(m, x));
  }
}

TEST(MooneyRivlin, SmallStrainsAreThoseOfAnIncompressibleFoil) {
  Random random(3);
  for (const MooneyRivlinLaw& law : laws) {
    const IsotropicLaw foil{3.0 * law.shear_modulus(), 0.5};
    const double e = 1e-7;
    const Vec3 k1(1.0 + e, 0.4 * e, 0.0), k2(0.7 * e, 1.0 - 0.3 * e, 0.0);
    const SheetResponse r = law.at(k1, k2), s = foil.at(k1, k2);
    for (const auto& [of, wanted] : {std::pair(r.s11, s.s11), {r.s22, s.s22}, {r.s12, s.s12}})
      EXPECT_NEAR(of, wanted, 1e-5 * law.shear_modulus() * e);
    EXPECT_NEAR(r.energy, s.energy, 1e-5 * s.energy);
    const Gram g{2.0, 1.0, -0.4};
    EXPECT_NEAR(law.stiffness_bound(Vec3::UnitX(), Vec3::UnitY(), g),
                foil.stiffness_bound(Vec3::UnitX(), Vec3::UnitY(), g), 1e-6 * law.shear_modulus());
  }
}

TEST(MooneyRivlin, StiffnessBoundHoldsForEveryStateOfOneTriangleAndIsNotFarAbove) {
  Random random(5);
  double loosest = 0.0;
  for (int trial = 0; trial < 4000; ++trial) {
    const MooneyRivlinLaw& law = laws[trial % 4];
    Vec6 k = Vec6::Zero(); // principal stretches 0.6 to 3, turned, sheared
    const double l1 = 1.8 + 1.2 * signed_unit(random), l2 = 1.8 + 1.2 * signed_unit(random);
    const double turn = 3.0 * signed_unit(random);
    const Eigen::Matrix3d place = random_rotation(random);
    k.head<3>() = place * Vec3(l1 * std::cos(turn), l2 * std::sin(turn), 0.0);
    k.tail<3>() = place * Vec3(-l1 * std::sin(turn), l2 * std::cos(turn), 0.0);
    Eigen::Matrix2d c; // gradients: G = c^T c
    for (int i = 0; i < 4; ++i)
      c(i / 2, i % 2) = signed_unit(random);
    const Eigen::Matrix2d g = c.transpose() * c;
    const double largest = largest_stiffness(law, k, c);
    const double bound = law.stiffness_bound(k.head<3>(), k.tail<3>(), {g(0, 0), g(1, 1), g(0, 1)});
    EXPECT_GE(bound, largest - 1e-7 * std::max(1.0, bound)) << trial;
    loosest = std::max(loosest, bound / largest);
  }
  RecordProperty("loosest", std::to_string(loosest));
  EXPECT_LT(loosest, 2.0);
}

TEST(MooneyRivlin, SaysWhereANegativeConstantSoftens) {
  EXPECT_FALSE(softening_of({0.3, 0.0}));
  EXPECT_FALSE(softening_of({0.2, 0.1}));
  EXPECT_FALSE(softening_of({0.0, 0.1}));
  const std::optional<Softening> both = softening_of({0.3, -0.01}),
                                 one = softening_of({-0.01, 0.3});
  ASSERT_TRUE(both && one);
  EXPECT_TRUE(both->equibiaxial);
  EXPECT_NEAR(both->stretch, std::sqrt(0.3 / 0.03), 0.02); // l (C10 + C01 l^2) is largest there
  EXPECT_FALSE(one->equibiaxial);
}

} // namespace
} // namespace plyform::mooney_rivlin_test
