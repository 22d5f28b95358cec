// SPDX-License-Identifier: GPL-3.0-or-later
// Membranes and bending that resist by rates: what forces do along a path is what is stored and
// lost, motions of a rigid body cost nothing, and steady rates give the torque of the law.
#include "core/ply/viscous_bending.hpp"
#include "core/ply/viscous_membrane.hpp"
#include "support/membrane_checks.hpp"
#include "support/viscous_fabrics.hpp"
#include "support/viscous_reference.hpp"

#include <functional>
#include <gtest/gtest.h>

namespace plyform::viscous_test {
namespace {

using Path = std::function<Vec3(const Vec2& p, double t)>;

BlankMesh square() {
  BlankSpec blank = rectangle(40.0, 40.0, 8.0, MeshKind::free);
  return mesh_blank(blank, 0.0, 0.5 * std::numbers::pi);
}

/// A sheet sheared, stretched and bent more and more, and turned.
Vec3 askew(const Vec2& p, double t) {
  const Vec3 x(p.x() * (1.0 + 0.02 * t) + 0.4 * t * p.y(), p.y() - 0.1 * t * p.y(),
               1e-2 * t * (p.x() * p.x() - 0.5 * p.y() * p.x()) + 0.3 * std::sin(p.x() + 2.0 * t));
  return Eigen::AngleAxisd(0.7 * t, Vec3(1.0, 2.0, 0.5).normalized()) * x;
}

Vec3 turning(const Vec2& p, double t) {
  return Eigen::AngleAxisd(2.0 * t, Vec3(1.0, 2.0, 0.5).normalized()) * Vec3(p.x(), p.y(), 0.0);
}

struct Taken {
  double work = 0.0, stored = 0.0, lost = 0.0, largest = 0.0; ///< N mm; N
};

/// Takes a membrane along a path in 1 s of the process.
Taken take(const Fabric& fabric, const Path& path, int steps) {
  const BlankMesh mesh = square();
  Membrane m = make_membrane(mesh, fabric, 0.0, ElementKind::averaged);
  const ViscousMembrane v = *make_viscous(m, 1.0);
  std::vector<double> now(m.triangles.size() * v.states, 0.0), next = now;
  std::vector<ElementForce> q(m.triangles.size());
  std::vector<Vec3> x, force(mesh.x.size(), Vec3::Zero());
  for (const Vec2& p : mesh.x)
    x.push_back(path(p, 0.0));
  Taken taken;
  for (int i = 0; i <= steps; ++i) {
    const std::vector<Vec3> before = x, was = force;
    for (std::size_t n = 0; n < x.size(); ++n)
      x[n] = path(mesh.x[n], static_cast<double>(i) / steps);
    viscous_forces(v, m, x, i > 0 ? 1.0 / steps : 0.0, 0, m.groups(), {now, next}, q);
    for (std::size_t n = 0; n < x.size(); ++n) {
      force[n] = node_force(m, q, static_cast<int>(n));
      taken.largest = std::max(taken.largest, force[n].norm());
      if (i > 0) taken.work -= 0.5 * (was[n] + force[n]).dot(x[n] - before[n]);
    }
    now.swap(next);
  }
  const ViscousEnergy energy = viscous_energy(v, m, now);
  taken.stored = energy.stored, taken.lost = energy.lost;
  return taken;
}

TEST(Viscous, MembranesStoreAndLoseWhatIsDoneOnThem) {
  for (const Fabric& fabric : {viscous_weave(), viscous_triaxial(), molten_tape()}) {
    const Taken taken = take(fabric, askew, 4000);
    EXPECT_GT(taken.lost, 0.1) << fabric.name;
    EXPECT_NEAR((taken.stored + taken.lost) / taken.work, 1.0, 2e-3) << fabric.families[0].name;
  }
}

TEST(Viscous, MembranesTurnFreely) {
  for (const Fabric& fabric : {viscous_weave(), viscous_triaxial(), molten_tape()})
    EXPECT_LT(take(fabric, turning, 100).largest, 1e-9);
}

/// Drawn along and across the yarns of a tape at steady rates: N_ab = eta_L h 2 d_ab while it is
/// sheared by any angle, N_bb = 4 eta_T h d_bb per width before.
TEST(Viscous, TapeHasTheForcesOfItsMelt) {
  Fabric f = molten_tape();
  f.families[0].angle = 0.0;
  const double rate = 0.8, h = f.thickness, area = 1600.0;
  const Taken sheared = take(
      f, [&](const Vec2& p, double t) { return Vec3(p.x() + rate * t * p.y(), p.y(), 0.0); }, 2000);
  EXPECT_NEAR(sheared.lost, 0.02 * h * rate * rate * area, 1e-3 * sheared.lost);
  const Taken drawn = take(
      f, [&](const Vec2& p, double t) { return Vec3(p.x(), std::exp(rate * t) * p.y(), 0.0); },
      2000);
  EXPECT_NEAR(drawn.lost, 4.0 * 0.01 * h * rate * rate * area, 2e-3 * drawn.lost);
}

BendingLaw viscous_plate() {
  BendingLaw law;
  law.families = {{Vec2::UnitX(), {2.0, {}, {}}, 0.0, 0.5},
                  {Vec2::UnitY(), {1.0, {}, {}}, 0.0, 0.0}};
  return law;
}

/// Likewise of bending: a cylinder that gets rounder at a steady rate has the moment eta kappa'.
TEST(Viscous, BendingStoresAndLosesWhatIsDoneOnIt) {
  const BlankMesh mesh = square();
  const Membrane m = make_membrane(mesh, glass_weave(), 0.0, ElementKind::averaged);
  const Bending bending =
      make_bending(mesh.x, m.triangles, viscous_plate(), 0.0, 0.5 * std::numbers::pi, m.node_mass);
  const auto v = make_viscous_bending(bending, m.node_mass, 1e9);
  ASSERT_TRUE(v);
  EXPECT_EQ(v->states(), 3u); // of the one family that is viscous
  const int steps = 2000;
  const double rate = 0.02; // 1/(mm s)
  std::vector<double> now(mesh.x.size() * v->states(), 0.0), next = now;
  std::vector<Vec3> x, force(mesh.x.size(), Vec3::Zero());
  for (const Vec2& p : mesh.x)
    x.emplace_back(p.x(), p.y(), 0.0);
  double work = 0.0;
  for (int i = 1; i <= steps; ++i) {
    const std::vector<Vec3> before = x, was = force;
    const double kappa = rate * i / steps;
    for (std::size_t n = 0; n < x.size(); ++n) {
      const Vec2& p = mesh.x[n];
      x[n] = Vec3(std::sin(kappa * p.x()) / kappa, p.y(), (1.0 - std::cos(kappa * p.x())) / kappa);
    }
    viscous_bending_forces(*v, bending, x, 1.0 / steps, now, next, force);
    for (std::size_t n = 0; n < x.size(); ++n)
      work -= 0.5 * (was[n] + force[n]).dot(x[n] - before[n]);
    now.swap(next);
  }
  const ViscousBendingEnergy energy = viscous_bending_energy(*v, bending.area, now);
  EXPECT_NEAR((energy.stored + energy.lost) / work, 1.0, 2e-3);
  double middle = 0.0; // its moment where the free edges are far
  for (std::size_t n = 0; n < x.size(); ++n)
    if (mesh.x[n].norm() < 10.0) middle = now[n * v->states() + 2];
  EXPECT_NEAR(std::abs(middle), 0.5 * rate, 0.05 * 0.5 * rate);
}

} // namespace
} // namespace plyform::viscous_test
