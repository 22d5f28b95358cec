// SPDX-License-Identifier: GPL-3.0-or-later
// Bending of yarns in their plane: curvature of known shapes, forces from energy, momentum, what
// must not cost anything, the step's bound.
#include "core/ply/bending.hpp"
#include "support/bending_laws.hpp"
#include "support/bending_reference.hpp"
#include "support/gradient_check.hpp"
#include "support/scene_checks.hpp"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

namespace plyform::in_plane_bending_test {
namespace {

constexpr double size = 60.0;        // mm, of the square blanks
constexpr double warp_angle = 0.3;   // rad, to the mesh
constexpr double fibre_angle = 1.25; // rad, from warp to weft: 72 degrees

BendingLaw in_plane_only() {
  BendingLaw law = weave_bending();
  law.families[0].in_plane = 8.0, law.families[1].in_plane = 3.0; // N mm
  return law;
}

BendingLaw both() {
  BendingLaw law = in_plane_only();
  law.families[0].law.stiffness = 5.0; // N mm
  law.families[1].law.stiffness = 0.5;
  law.twist = 0.3;
  return law;
}

BlankMesh square(MeshKind kind) {
  BlankSpec blank = rectangle(size, size, 8.0);
  blank.mesh = kind;
  return mesh_blank(blank, 0.0, 0.0);
}

Bending bend(const BlankMesh& mesh, const BendingLaw& law, double warp, double angle = fibre_angle,
             double mass = 1e-8) {
  const std::vector<double> masses(mesh.x.size(), mass); // t
  return make_bending(mesh.x, mesh.triangles, law, warp, warp + angle, masses);
}

/// Curved, sheared and stretched, each node moved at random by up to 0.4 mm besides.
std::vector<Vec3> crumpled(const BlankMesh& mesh) {
  Random random(7);
  std::vector<Vec3> x;
  for (const Vec2& p : mesh.x) {
    const Vec3 noise = 0.23 * random_vector(random);
    x.push_back(noise + Vec3(1.02 * p.x() + 0.3 * p.y() + 0.004 * p.y() * p.y(),
                             0.97 * p.y() - 0.05 * p.x() + 2.0 * std::sin(0.08 * p.x()),
                             3.0 * std::sin(0.1 * p.x() + 0.07 * p.y()) + 0.01 * p.y() * p.x()));
  }
  return x;
}

TEST(InPlaneBending, ForceIsMinusEnergyGradientAtEveryNode) {
  for (const MeshKind kind : {MeshKind::free, MeshKind::alternating})
    for (const BendingLaw& law : {in_plane_only(), both()})
      for (const double warp : {0.0, warp_angle}) { // 0: the warp lies along two of the rims
        const BlankMesh mesh = square(kind);
        Bending b = bend(mesh, law, warp);
        std::vector<Vec3> x = crumpled(mesh);
        const std::vector<Vec3> f = reference_bending_forces(b, x);
        const double scale = largest_norm(f);
        ASSERT_GT(scale, 1e-2);
        expect_minus_gradient(x, f, scale, 3,
                              [&](const std::vector<Vec3>& at) { return bending_energy(b, at); });
      }
}

TEST(InPlaneBending, HasNeitherNetForceNorMomentAndDoesNotSeeRotations) {
  const BlankMesh mesh = square(MeshKind::free);
  Bending b = bend(mesh, in_plane_only(), warp_angle);
  const std::vector<Vec3> x = crumpled(mesh), f = reference_bending_forces(b, x);
  Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
  double force_scale = 0.0, moment_scale = 0.0;
  for (std::size_t n = 0; n < f.size(); ++n) {
    sum += f[n];
    moment += x[n].cross(f[n]);
    force_scale += f[n].norm();
    moment_scale += x[n].norm() * f[n].norm();
  }
  EXPECT_LE(sum.norm(), 1e-12 * force_scale);
  EXPECT_LE(moment.norm(), 1e-12 * moment_scale);
  Random random(3);
  const Eigen::Matrix3d turn = random_rotation(random);
  std::vector<Vec3> turned;
  for (const Vec3& p : x)
    turned.push_back(turn * p + Vec3(4.0, -2.0, 9.0));
  const double e = bending_energy(b, x);
  EXPECT_NEAR(bending_energy(b, turned), e, 1e-11 * e);
}

TEST(InPlaneBending, IsFreeForStraightYarnsHoweverUnevenlyTheyAreStretchedAndSheared) {
  for (const MeshKind kind : {MeshKind::diagonal, MeshKind::free})
    for (const double warp : {0.0, warp_angle}) {
      const BlankMesh mesh = square(kind);
      const Vec2 e1(std::cos(warp), std::sin(warp)), across(-e1.y(), e1.x());
      BendingLaw law = weave_bending();
      law.families[0].in_plane = 8.0, law.families[1].in_plane = 0.0; // the weft does turn
      Bending b = bend(mesh, law, warp);
      Random random(5);
      const Eigen::Matrix3d turn = random_rotation(random);
      std::vector<Vec3> x;
      for (const Vec2& p : mesh.x) {
        const double r = p.dot(e1), s = p.dot(across);
        const double along = r + 0.004 * r * r + 0.3 * s + 3.0 * std::sin(0.1 * s + 0.05 * r);
        const Vec2 at = along * e1 + 0.9 * s * across;
        x.push_back(turn * Vec3(at.x(), at.y(), 0.0));
      }
      // N mm; a warp that turned as its length changes here (0.02/mm) would have 5
      EXPECT_LE(bending_energy(b, x), 1e-20);
      EXPECT_LE(largest_norm(reference_bending_forces(b, x)), 1e-10);
    }
}

TEST(InPlaneBending, YarnsOnAnArcTurnByOneOverItsRadius) {
  const double radius = 300.0; // mm, of the yarn in the middle; all turn by the same angle
  const BlankMesh mesh = square(MeshKind::diagonal);
  Bending b = bend(mesh, in_plane_only(), 0.0, 0.5 * std::numbers::pi);
  std::vector<Vec3> x;
  for (const Vec2& p : mesh.x) {
    const double out = radius - p.y(), angle = p.x() / radius;
    x.emplace_back(out * std::sin(angle), radius - out * std::cos(angle), 0.0);
  }
  int followed = 0;
  for (std::size_t n = 0; n < x.size(); ++n) {
    if (b.in_plane[2 * n + 0] == 0.0) continue;
    ++followed;
    // a quadratic on an arc is off by (h/R)^2 = 7e-4 at most, h = 8 mm the element; on the rim,
    // where lengths along it are fitted without their change across, by h/(4R) = 7e-3
    const double near = std::abs(mesh.x[n].y()) < 0.5 * size - 1e-6 ? 1e-3 : 1e-2;
    EXPECT_NEAR(in_plane_curvature(b, x, static_cast<int>(n), 0), 1.0 / radius, near / radius);
    if (b.in_plane[2 * n + 1] > 0.0) {
      EXPECT_NEAR(in_plane_curvature(b, x, static_cast<int>(n), 1), 0.0, 1e-3 / radius);
    }
  }
  EXPECT_GE(followed, 40); // inner nodes and those of two rims
}

TEST(InPlaneBending, FollowsOnTheRimOnlyYarnsThatLieAlongIt) {
  const BlankMesh mesh = square(MeshKind::diagonal);
  const double rim = 0.5 * size - 1e-6;
  for (const double warp : {0.0, warp_angle}) {
    const Bending b = bend(mesh, in_plane_only(), warp);
    for (std::size_t n = 0; n < mesh.x.size(); ++n) {
      const bool left = std::abs(mesh.x[n].x()) > rim, top = std::abs(mesh.x[n].y()) > rim;
      const bool along = !left && (!top || warp == 0.0); // no rim lies along the weft
      EXPECT_EQ(b.in_plane[2 * n + 0], along ? 8.0 : 0.0) << mesh.x[n].transpose();
      EXPECT_EQ(b.in_plane[2 * n + 1], !left && !top ? 3.0 : 0.0) << mesh.x[n].transpose();
    }
  }
}

TEST(InPlaneBending, OutOfTheSheetChargesNothing) {
  const BlankMesh mesh = square(MeshKind::diagonal);
  Bending b = bend(mesh, in_plane_only(), 0.0, 0.5 * std::numbers::pi);
  const double radius = 50.0; // mm
  std::vector<Vec3> x;
  for (const Vec2& p : mesh.x)
    x.emplace_back(radius * std::sin(p.x() / radius), p.y(), radius * std::cos(p.x() / radius));
  EXPECT_LE(bending_energy(b, x), 1e-20);
}

/// The largest eigenvalue of K / mass at shape x, 1/s^2, all nodes of that mass.
double largest_omega2(Bending& b, std::vector<Vec3> x, double mass) {
  const auto n = static_cast<Eigen::Index>(3 * x.size());
  const double step = 1e-5; // mm; central differences: linear but for its square
  Eigen::MatrixXd k(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    double& place = x[j / 3][j % 3];
    const double before = place;
    place = before + step;
    const std::vector<Vec3> up = reference_bending_forces(b, x);
    place = before - step;
    const std::vector<Vec3> down = reference_bending_forces(b, x);
    place = before;
    for (Eigen::Index i = 0; i < n; ++i)
      k(i, j) = (down[i / 3][i % 3] - up[i / 3][i % 3]) / (2.0 * step);
  }
  const Eigen::MatrixXd symmetric = 0.5 * (k + k.transpose());
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric).eigenvalues()[n - 1] / mass;
}

TEST(InPlaneBending, BoundHoldsFlatAndShearedAndIsTheLargerOfBothBendings) {
  BlankSpec spec = rectangle(40.0, 40.0, 10.0);
  const double mass = 1e-8; // t
  for (const MeshKind kind : {MeshKind::diagonal, MeshKind::alternating, MeshKind::free}) {
    spec.mesh = kind;
    const BlankMesh mesh = mesh_blank(spec, 0.0, 0.0);
    BendingLaw across = both();
    across.families[0].in_plane = across.families[1].in_plane = 0.0;
    const double out = bend(mesh, across, warp_angle, fibre_angle, mass).omega2;
    const double in = bend(mesh, in_plane_only(), warp_angle, fibre_angle, mass).omega2;
    Bending b = bend(mesh, both(), warp_angle, fibre_angle, mass);
    EXPECT_EQ(b.omega2, std::max(out, in));
    for (const double shear : {0.0, 0.6}) {
      std::vector<Vec3> x;
      for (const Vec2& p : mesh.x) // pure shear of the blank: no yarn is bent
        x.emplace_back(p.x() + shear * p.y(), p.y(), 0.0);
      const double omega2 = largest_omega2(b, x, mass);
      EXPECT_GE(b.omega2, omega2);
      if (shear == 0.0) {
        EXPECT_LE(b.omega2, 8.0 * omega2); // as far off as that of bending out of the sheet
      }
    }
  }
}

} // namespace
} // namespace plyform::in_plane_bending_test
