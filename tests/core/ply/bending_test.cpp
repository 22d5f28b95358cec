// SPDX-License-Identifier: GPL-3.0-or-later
// Bending: curvatures of known surfaces, forces from energy, momentum, the step's bound.
#include "core/ply/bending.hpp"
#include "support/bending_laws.hpp"
#include "support/bending_reference.hpp"
#include "support/gradient_check.hpp"
#include "support/scene_checks.hpp"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

namespace plyform::bending_test {
namespace {

BendingLaw cloth() {
  BendingLaw law = weave_bending();
  law.families[0].law.stiffness = 5.0; // N mm
  law.families[1].law.stiffness = 0.5;
  law.coupling = 0.2;
  law.twist = 0.3;
  return law;
}

/// A third family askew to the axes, by a table, that bends in its plane too.
BendingLaw three_families() {
  BendingLaw law = cloth();
  law.families.push_back({Vec2(-0.6, 1.1), {0.0, {0.0, 0.01, 0.03}, {0.0, 0.03, 0.05}}, 4.0});
  return law;
}

BendingLaw one_family() {
  BendingLaw law;
  law.families = {{Vec2::UnitX(), {2.0, {}, {}}, 3.0}};
  return law;
}

/// A square of 60 mm with free triangles of 8 mm.
BlankMesh free_square() {
  BlankSpec blank = rectangle(60.0, 60.0, 8.0);
  blank.mesh = MeshKind::free;
  return mesh_blank(blank, 0.0, 0.0);
}

Bending bend(const BlankMesh& mesh, const BendingLaw& law, double warp, double mass = 1e-8) {
  const std::vector<double> masses(mesh.x.size(), mass);
  return make_bending(mesh.x, mesh.triangles, law, warp, warp + 0.5 * std::numbers::pi, masses);
}

std::vector<Vec3> wavy(const BlankMesh& mesh) {
  std::vector<Vec3> x;
  for (const Vec2& p : mesh.x)
    x.emplace_back(1.02 * p.x() + 0.1 * p.y(), 0.97 * p.y() - 0.05 * p.x(),
                   3.0 * std::sin(0.1 * p.x() + 0.07 * p.y()) + 0.01 * p.y() * p.x());
  return x;
}

TEST(Bending, FindsTheSecondDerivativesOfAnyQuadraticInsideAnyMesh) {
  const double angle = 0.4, a = 2e-3, c = -1e-3, twist = 5e-4; // 1/mm
  const Vec2 e1(std::cos(angle), std::sin(angle)), e2(-e1.y(), e1.x());
  BlankSpec crossed = rectangle(60.0, 60.0, 10.0);
  crossed.mesh = MeshKind::crossed;
  for (const BlankMesh& mesh : {free_square(), mesh_blank(crossed, 0.0, 0.0),
                                mesh_blank(rectangle(60.0, 60.0, 10.0), 0.0, 0.0)}) {
    const Bending b = bend(mesh, cloth(), angle);
    std::vector<Vec3> x;
    for (const Vec2& p : mesh.x) {
      const double r = p.dot(e1), s = p.dot(e2);
      x.emplace_back(p.x(), p.y(), 0.5 * a * r * r + 0.5 * c * s * s + twist * r * s + 0.1 * r);
    }
    std::vector<Vec3> normal(x.size(), Vec3::Zero());
    for (const Triangle& t : mesh.triangles)
      for (const int n : t)
        normal[n] += (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]);
    for (std::size_t n = 0; n < x.size(); ++n) {
      if (mesh.x[n].cwiseAbs().maxCoeff() > 29.999) continue; // the rim
      const double up = normal[n].normalized().z();
      const std::array<double, 3> k = curvatures(b, x, static_cast<int>(n));
      // 1e-10: rounding of fits with singular values down to 0.02 of the largest
      EXPECT_NEAR(k[0], a * up, 1e-10);
      EXPECT_NEAR(k[1], c * up, 1e-10);
      EXPECT_NEAR(k[2], twist * up, 1e-10);
    }
  }
}

TEST(Bending, ForceIsMinusEnergyGradient) {
  const BlankMesh mesh = free_square();
  BendingLaw table = cloth();
  table.families[0].law.curvature = {0.0, 0.01, 0.03};
  table.families[0].law.moment = {0.0, 0.05, 0.07};
  for (const BendingLaw& law : {cloth(), table, three_families(), one_family()}) {
    Bending b = bend(mesh, law, 0.3);
    std::vector<Vec3> x = wavy(mesh);
    const std::vector<Vec3> f = reference_bending_forces(b, x);
    const double scale = largest_norm(f);
    ASSERT_GT(scale, 1e-4);
    expect_minus_gradient(x, f, scale, 7,
                          [&](const std::vector<Vec3>& at) { return bending_energy(b, at); });
  }
}

TEST(Bending, HasNeitherNetForceNorMomentAndDoesNotSeeRotations) {
  const BlankMesh mesh = free_square();
  Bending b = bend(mesh, cloth(), 0.3);
  const std::vector<Vec3> x = wavy(mesh);
  const std::vector<Vec3> f = reference_bending_forces(b, x);
  const double scale = largest_norm(f);
  Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
  for (std::size_t n = 0; n < f.size(); ++n) {
    sum += f[n];
    moment += x[n].cross(f[n]);
  }
  EXPECT_LE(sum.norm(), 1e-10 * scale);
  EXPECT_LE(moment.norm(), 1e-10 * scale * 60.0); // the square's size, mm
  Random random(3);
  const Eigen::Matrix3d turn = random_rotation(random);
  std::vector<Vec3> turned;
  for (const Vec3& p : x)
    turned.push_back(turn * p + Vec3(4.0, -2.0, 9.0));
  const double e = bending_energy(b, x);
  EXPECT_NEAR(bending_energy(b, turned), e, 1e-11 * e);
}

/// Eigenvalues (1/s^2, ascending) of motions of the flat sheet along these axes, each node of the
/// given mass.
Eigen::VectorXd flat_modes(const Bending& b, const BlankMesh& mesh, double mass,
                           const std::vector<Eigen::Index>& axes = {2}) {
  std::vector<Vec3> x;
  for (const Vec2& p : mesh.x)
    x.emplace_back(p.x(), p.y(), 0.0);
  const auto each = static_cast<Eigen::Index>(axes.size()),
             n = each * static_cast<Eigen::Index>(x.size());
  const auto at = [&](std::vector<Vec3>& of, Eigen::Index i) -> double& {
    return of[static_cast<std::size_t>(i / each)][axes[static_cast<std::size_t>(i % each)]];
  };
  Eigen::MatrixXd k(n, n); // linear, so a unit step is exact but for its square
  const double step = 1e-6;
  for (Eigen::Index j = 0; j < n; ++j) {
    const double before = at(x, j);
    at(x, j) = before + step;
    std::vector<Vec3> f = reference_bending_forces(b, x);
    at(x, j) = before;
    for (Eigen::Index i = 0; i < n; ++i)
      k(i, j) = -at(f, i) / step;
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(0.5 * (k + k.transpose())).eigenvalues() /
         mass;
}

constexpr double rounding = 1e-7; // of flat_modes: finite differences

TEST(Bending, BoundHoldsAndLeavesNoModeOfTheFlatSheetFree) {
  const BlankMesh mesh = mesh_blank(rectangle(40.0, 40.0, 10.0), 0.0, 0.0);
  BendingLaw plate = weave_bending(); // nu = 0.3
  plate.families[0].law.stiffness = plate.families[1].law.stiffness = 2.0;
  plate.coupling = 0.6;
  plate.twist = 2.8;
  const double mass = 1e-8; // t
  Bending b = bend(mesh, plate, 0.0, mass);
  const Eigen::VectorXd omega2 = flat_modes(b, mesh, mass);
  const Eigen::Index n = omega2.size();
  EXPECT_GE(b.omega2, omega2[n - 1] * (1.0 - rounding));
  EXPECT_LE(b.omega2, omega2[n - 1] * 1.03);            // the margin of Lanczos' iteration
  EXPECT_LE(std::abs(omega2[2]), 1e-9 * omega2[n - 1]); // one shift, two rotations
  EXPECT_GE(omega2[3], 1e-5 * omega2[n - 1]); // all else bends; a strip's first mode is (h/L)^4
}

TEST(Bending, BoundHoldsForAWeaveAndItsSoftestShapeIsTheSaddle) {
  BlankSpec spec = rectangle(40.0, 40.0, 10.0);
  const double mass = 1e-8; // t
  for (const MeshKind kind : {MeshKind::diagonal, MeshKind::alternating, MeshKind::free})
    for (const double warp : {0.0, 0.5}) {
      spec.mesh = kind;
      const BlankMesh mesh = mesh_blank(spec, warp, warp + 0.5 * std::numbers::pi);
      BendingLaw law = weave_bending();
      law.families[0].law.stiffness = 2.0;
      law.families[1].law.stiffness = 0.5;
      Bending limp = bend(mesh, law, warp, mass);
      law.twist = 1.0;
      Bending b = bend(mesh, law, warp, mass);
      const Eigen::VectorXd omega2 = flat_modes(b, mesh, mass),
                            without = flat_modes(limp, mesh, mass);
      EXPECT_GE(b.omega2, omega2[omega2.size() - 1] * (1.0 - rounding));
      EXPECT_GE(limp.omega2, without[without.size() - 1] * (1.0 - rounding));
      // small rims at an angle to the yarns hold a saddle, too
      if (warp == 0.0) {
        EXPECT_LE(without[3], 0.1 * omega2[3]) << static_cast<int>(kind);
      }
      EXPECT_GE(omega2[3], 1e-4 * omega2[omega2.size() - 1]);
    }
}

TEST(Bending, BoundHoldsForYarnsThatBendInThePlane) {
  BlankSpec spec = rectangle(40.0, 40.0, 10.0);
  const double mass = 1e-8; // t
  for (const MeshKind kind : {MeshKind::diagonal, MeshKind::alternating, MeshKind::free})
    for (const double warp : {0.0, 0.5})
      for (const double across : {0.5 * std::numbers::pi, 0.2 * std::numbers::pi}) { // sheared
        spec.mesh = kind;
        const BlankMesh mesh = mesh_blank(spec, warp, warp + across);
        BendingLaw law = weave_bending();
        law.families[0].law.stiffness = law.families[1].law.stiffness = 0.2;
        law.families[0].in_plane = 9.0, law.families[1].in_plane = 3.0;
        const Bending b = make_bending(mesh.x, mesh.triangles, law, warp, warp + across,
                                       std::vector<double>(mesh.x.size(), mass));
        const Eigen::VectorXd omega2 = flat_modes(b, mesh, mass, {0, 1});
        EXPECT_GE(b.omega2, omega2[omega2.size() - 1] * (1.0 - rounding));
        EXPECT_LE(b.omega2, omega2[omega2.size() - 1] * 2.2) << static_cast<int>(kind);
      }
}

} // namespace
} // namespace plyform::bending_test
