// SPDX-License-Identifier: GPL-3.0-or-later
// The isotropic sheet: forces from energy, rotations, small strains, the bound of its step.
#include "core/ply/membrane_eigenvalue.hpp"
#include "support/gradient_check.hpp"
#include "support/membrane_checks.hpp"
#include "support/sheet_stiffness.hpp"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

namespace plyform::isotropic_test {
namespace {

constexpr double modulus = 4200.0, ratio = 0.35, thickness = 0.25; // N/mm^2, -, mm: paper or foil

Fabric foil(double nu = ratio) {
  Fabric f;
  f.name = "foil";
  f.surface_density = 8e-11;
  f.thickness = thickness;
  f.sheet = IsotropicLaw{modulus * thickness, nu};
  return f;
}

double energy(const Membrane& m, const std::vector<Vec3>& x) {
  const MembraneEnergy e = membrane_energy(m, x);
  EXPECT_EQ(e.fibre, 0.0); // it has none
  return e.shear;
}

TEST(Isotropic, ForceIsMinusEnergyGradient) {
  Random random(1);
  for (const double stretch : {0.8, 1.0, 1.2}) { // compressed, about unstrained, stretched
    const BlankMesh mesh = irregular_mesh(random);
    Membrane m = make_membrane(mesh, foil(), 0.4, ElementKind::averaged);
    std::vector<Vec3> x = random_state(mesh, stretch, 0.5, random);
    const std::vector<Vec3> f = nodal_forces(m, x);
    const double scale = largest_norm(f);
    ASSERT_GT(scale, 1.0);
    // a quartic: h^2 over the size of a triangle squared, 1e-10; rounding 1e-16 E / (h F)
    expect_minus_gradient(x, f, scale, 1,
                          [&](const std::vector<Vec3>& at) { return energy(m, at); });
  }
}

TEST(Isotropic, DoesNotSeeRotations) {
  Random random(2);
  const BlankMesh mesh = irregular_mesh(random);
  Membrane m = make_membrane(mesh, foil(), 0.4, ElementKind::plain);
  const std::vector<Vec3> x = random_state(mesh, 1.05, 0.5, random);
  const std::vector<Vec3> f = nodal_forces(m, x);
  const double e = energy(m, x), scale = largest_norm(f);
  const Eigen::Matrix3d turn = random_rotation(random);
  const Vec3 shift(7, -3, 11);
  std::vector<Vec3> turned;
  for (const Vec3& p : x)
    turned.push_back(turn * p + shift);
  EXPECT_NEAR(energy(m, turned), e, 1e-11 * e);
  const std::vector<Vec3> g = nodal_forces(m, turned);
  Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
  for (std::size_t n = 0; n < f.size(); ++n) {
    EXPECT_LE((g[n] - turn * f[n]).norm(), 1e-11 * scale);
    sum += f[n];
    moment += x[n].cross(f[n]);
  }
  EXPECT_LE(sum.norm(), 1e-12 * scale * 10);
  EXPECT_LE(moment.norm(), 1e-12 * scale * 10 * 30); // arms of up to 30 mm
}

TEST(Isotropic, DoesNotSeeTheDirectionOfItsWarp) {
  Random random(3);
  const BlankMesh mesh = irregular_mesh(random);
  const std::vector<Vec3> x = random_state(mesh, 0.95, 0.5, random);
  Membrane m = make_membrane(mesh, foil(), 0.0, ElementKind::plain);
  const std::vector<Vec3> f = nodal_forces(m, x);
  for (const double angle : {0.3, 1.0, 2.5}) {
    Membrane other = make_membrane(mesh, foil(), angle, ElementKind::plain);
    const std::vector<Vec3> g = nodal_forces(other, x);
    for (std::size_t n = 0; n < f.size(); ++n)
      EXPECT_LE((g[n] - f[n]).norm(), 1e-11 * largest_norm(f)) << angle;
    EXPECT_NEAR(energy(other, x), energy(m, x), 1e-11 * energy(m, x));
  }
}

TEST(Isotropic, SmallUniaxialStressHasYoungsModulusAndPoissonsRatio) {
  const double width = 30.0, eps = 1e-6; // of either sign: it resists compression
  const BlankMesh mesh = mesh_blank(rectangle(40.0, width, 10.0), 0.0, 0.5 * std::numbers::pi);
  Membrane m = make_membrane(mesh, foil(), 0.7, ElementKind::plain);
  for (const double strain : {eps, -eps}) {
    std::vector<Vec3> x;
    for (const Vec2& p : mesh.x)
      x.emplace_back((1.0 + strain) * p.x(), (1.0 - ratio * strain) * p.y(), 0.0);
    const std::vector<Vec3> f = nodal_forces(m, x);
    const double wanted = modulus * thickness * strain * width;
    double pull = 0.0;
    for (std::size_t n = 0; n < f.size(); ++n) {
      const bool end = std::abs(mesh.x[n].x()) > 19.0;
      if (mesh.x[n].x() > 19.0) pull -= f[n].x(); // what it would be held with
      // Free sides and the inside feel nothing, to second order of the strain and rounding.
      EXPECT_LE((end ? std::abs(f[n].y()) : f[n].norm()), 1e-5 * std::abs(wanted)) << n;
    }
    EXPECT_NEAR(pull, wanted, 1e-5 * std::abs(wanted)); // E_11 = eps + eps^2/2, and rounding
    const double stored = 0.5 * modulus * thickness * strain * strain * 40.0 * width;
    EXPECT_NEAR(energy(m, x), stored, 1e-5 * stored);
  }
}

TEST(Isotropic, SmallShearHasTheShearModulus) {
  const IsotropicLaw law{modulus * thickness, ratio};
  const double gamma = 1e-6;
  const SheetResponse s = law.at({1, 0, 0}, {gamma, 1, 0});
  const double shear = modulus * thickness / (2.0 * (1.0 + ratio)) * gamma;
  EXPECT_NEAR(s.s12, shear, 1e-6 * shear);
  EXPECT_NEAR(s.energy, 0.5 * shear * gamma, 2e-6 * shear * gamma);
}

/// Largest eigenvalue of M^-1 K, K by differences of the forces.
double largest_omega2(Membrane& m, std::vector<Vec3> x) {
  const auto size = static_cast<Eigen::Index>(3 * x.size());
  const double h = 1e-5; // mm
  Eigen::MatrixXd k(size, size);
  for (Eigen::Index j = 0; j < size; ++j) {
    double& place = x[j / 3][static_cast<int>(j % 3)];
    const double before = place;
    place = before + h;
    const std::vector<Vec3> up = nodal_forces(m, x);
    place = before - h;
    const std::vector<Vec3> down = nodal_forces(m, x);
    place = before;
    for (Eigen::Index i = 0; i < size; ++i) {
      const auto n = static_cast<std::size_t>(i / 3);
      const double mass = std::sqrt(m.node_mass[n] * m.node_mass[j / 3]);
      const int axis = static_cast<int>(i % 3);
      k(i, j) = -(up[n][axis] - down[n][axis]) / (2.0 * h) / mass;
    }
  }
  EXPECT_LE((k - k.transpose()).norm(), 1e-6 * k.norm());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(0.5 * (k + k.transpose()),
                                                              Eigen::EigenvaluesOnly);
  return solver.eigenvalues().maxCoeff();
}

TEST(Isotropic, FrequencyBoundHoldsAndIsNotFarAbove) {
  Random random(4);
  for (const double nu : {0.0, 0.3, 0.5})
    for (const MeshKind kind : {MeshKind::diagonal, MeshKind::alternating, MeshKind::crossed}) {
      const BlankMesh mesh =
          mesh_blank(rectangle(40.0, 40.0, 10.0, kind), 0.0, 0.5 * std::numbers::pi);
      Membrane m = make_membrane(mesh, foil(nu), 0.3, ElementKind::plain);
      std::vector<std::vector<Vec3>> states;
      for (const double stretch : {1.0, 0.9, 1.2}) { // one strain everywhere, in a plane
        states.emplace_back();
        for (const Vec2& p : mesh.x)
          states.back().emplace_back(stretch * p.x(), p.y() / stretch, 0.0);
      }
      for (const std::vector<Vec3>& x : states) {
        const double found = largest_omega2(m, x), bound = eigenvalue_bound(m, x).omega2;
        EXPECT_GE(bound, found * (1.0 - 1e-9)) << nu;
        EXPECT_LE(bound, 2.0 * found) << nu;
      }
      for (int i = 0; i < 3; ++i) { // any state: it must hold; one bad triangle may make it loose
        const std::vector<Vec3> x = random_state(mesh, 1.0 + 0.1 * i, 1.0, random);
        EXPECT_GE(eigenvalue_bound(m, x).omega2, largest_omega2(m, x) * (1.0 - 1e-9)) << nu;
      }
    }
}

TEST(Isotropic, StiffnessBoundHoldsForEveryStateOfOneTriangle) {
  Random random(5);
  for (int trial = 0; trial < 3000; ++trial) {
    const IsotropicLaw law{1.0, 0.5 * std::abs(signed_unit(random))};
    const bool at_rest = trial % 3 == 0;
    Vec6 k = Vec6::Unit(0) + Vec6::Unit(4);
    for (int i = 0; i < 6 && !at_rest; ++i)
      k[i] += (trial % 3 == 1 ? 0.3 : 1.0) * signed_unit(random);
    Eigen::Matrix2d c; // gradients: G = c^T c
    for (int i = 0; i < 4; ++i)
      c(i / 2, i % 2) = signed_unit(random);
    const Eigen::Matrix2d g = c.transpose() * c;
    const double largest = largest_stiffness(law, k, c);
    const double bound = law.stiffness_bound(k.head<3>(), k.tail<3>(), {g(0, 0), g(1, 1), g(0, 1)});
    // differences of a cubic with h = 1e-5, and the closed form's cancellation
    const double tolerance = 1e-7 * std::max(1.0, bound);
    EXPECT_GE(bound, largest - tolerance) << trial;
    if (at_rest) {
      EXPECT_NEAR(bound, largest, tolerance) << trial; // no stress: exact
    }
  }
}

} // namespace
} // namespace plyform::isotropic_test
