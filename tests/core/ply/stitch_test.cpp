// SPDX-License-Identifier: GPL-3.0-or-later
// Stitches in the membrane, against statics of a cell sheared by gamma whose yarns keep their
// length: with s = a f1 + b f2 along the stitch and yarns at right angles before,
//   lambda_s^2 = a^2 + b^2 + 2 a b sin(gamma)
// so that stitches add the torque per area n_s F_s d(lambda_s)/d(gamma).
#include "core/model/yarn_law.hpp"
#include "core/ply/membrane.hpp"
#include "support/membrane_checks.hpp"

#include <gtest/gtest.h>

namespace plyform::stitch_test {
namespace {

constexpr double pi = std::numbers::pi;

/// A square of 40 mm of this fabric, in its place and sheared.
struct Square {
  BlankMesh mesh = mesh_blank(rectangle(40.0, 40.0, 10.0), 0.0, 0.5 * pi);
  Membrane m;
  std::vector<YarnMemory> states;

  explicit Square(const Fabric& fabric)
      : m(make_membrane(mesh, fabric, 0.0, ElementKind::averaged)), states(memory_at_start(m)) {}

  /// Sheared by gamma: the lines at +-45 degrees turn towards x and keep their length.
  std::vector<Vec3> sheared(double gamma) const {
    const double along = std::sqrt(1.0 + std::sin(gamma)),
                 across = std::sqrt(1.0 - std::sin(gamma));
    std::vector<Vec3> x;
    for (const Vec2& p : mesh.x)
      x.emplace_back(along * p.x(), across * p.y(), 0.0);
    return x;
  }

  /// N/mm, torque per area: the power of the forces of a shear by d(gamma).
  double torque(double gamma) {
    std::vector<ElementForce> q(m.triangles.size());
    const std::vector<Vec3> x = sheared(gamma);
    element_forces(m, x, 0.0, 0, m.groups(), {states, states}, q);
    const double h = 1e-6;
    const std::vector<Vec3> above = sheared(gamma + h), below = sheared(gamma - h);
    double power = 0.0;
    for (std::size_t n = 0; n < x.size(); ++n)
      power -= node_force(m, q, static_cast<int>(n)).dot(above[n] - below[n]) / (2.0 * h);
    return power / 1600.0;
  }
};

TEST(Stitch, AlongADiagonalAddsItsTorque) {
  Fabric f = biaxial();
  f.crossings[0].shear.k.clear();
  f.stitches = {stitch_at(0.0, 30.0)};
  Square square(f);
  for (const double gamma : {0.1, 0.3, 0.6, 1.0}) {
    const double root = std::sqrt(1.0 + std::sin(gamma)), force = 30.0 * (root - 1.0);
    const double wanted = 0.2 * force * std::cos(gamma) / (2.0 * root);
    EXPECT_NEAR(square.torque(gamma), wanted, 1e-6 * wanted);
    EXPECT_NEAR(square.torque(-gamma), 0.0, 1e-12);
  }
}

TEST(Stitch, InAnyDirectionAddsItsTorque) {
  for (const double angle : {-0.7, -0.3, 0.2, 0.9, 1.5, 2.5}) { // to x, between yarns at +-45
    Fabric f = biaxial();
    f.crossings[0].shear.k.clear();
    f.stitches = {stitch_at(angle, 30.0, -0.4)}; // taut where it becomes shorter, too
    Square square(f);
    const double a = std::cos(angle + 0.25 * pi), b = std::sin(angle + 0.25 * pi);
    for (const double gamma : {-0.5, -0.1, 0.0, 0.2, 0.8}) {
      const double length = std::sqrt(a * a + b * b + 2.0 * a * b * std::sin(gamma));
      const double force = 30.0 * std::max(0.0, length - 1.0 + 0.4);
      const double wanted = 0.2 * force * a * b * std::cos(gamma) / length;
      EXPECT_NEAR(square.torque(gamma), wanted, 1e-6) << angle << ' ' << gamma;
    }
  }
}

TEST(Stitch, DoesNothingWhileItIsSlack) {
  Fabric f = biaxial();
  Square without(f);
  f.stitches = {stitch_at(0.0, 300.0, 0.1)};
  Square with(f);
  const double taut = std::asin(1.1 * 1.1 - 1.0);
  for (const double gamma : {-0.8, -0.2, 0.0, 0.1, taut - 1e-3})
    EXPECT_EQ(with.torque(gamma), without.torque(gamma)) << gamma;
  EXPECT_GT(with.torque(taut + 1e-3), without.torque(taut + 1e-3) + 1e-3);
}

/// Two legs of a zigzag at equal angles to both sides of the diagonal: twice the torque of one.
TEST(Stitch, ZigzagIsTheSumOfItsLegs) {
  Fabric f = biaxial();
  f.crossings[0].shear.k.clear();
  f.stitches = {stitch_at(0.3, 30.0), stitch_at(-0.3, 30.0)};
  Square both(f);
  f.stitches.pop_back();
  Square one(f);
  for (const double gamma : {0.1, 0.5, 0.9})
    EXPECT_NEAR(both.torque(gamma), 2.0 * one.torque(gamma), 1e-9);
}

TEST(Stitch, NoNetForceAndNoNetMoment) {
  Random random(41);
  for (int i = 0; i < 20; ++i) {
    const BlankMesh mesh = irregular_mesh(random);
    Fabric f = non_crimp();
    f.families[0].tension.stiffness = f.families[1].tension.stiffness = 1.0; // stitches alone
    f.families[1].tension.compression = 0.0;
    f.crossings[0].shear.k.clear();
    const Membrane m = make_membrane(mesh, f, 0.4, ElementKind::averaged);
    const std::vector<Vec3> x = random_state(mesh, 1.1, 0.3, random);
    const std::vector<Vec3> force = nodal_forces(m, x);
    Vec3 sum = Vec3::Zero(), moment = sum;
    for (std::size_t n = 0; n < x.size(); ++n)
      sum += force[n], moment += x[n].cross(force[n]);
    EXPECT_LE(sum.norm(), 1e-12 * largest_norm(force));
    EXPECT_LE(moment.norm(), 1e-11 * largest_norm(force) * 30.0);
  }
}

/// Drawn out, let go of and drawn out again: beyond its force it is gone, where it is gone it stays
/// so, and what it had stored is lost once.
TEST(Stitch, BreaksOnceAndForGood) {
  Fabric f = biaxial();
  f.crossings[0].shear.k.clear();
  f.stitches = {stitch_at(0.0, 30.0)};
  const double length = std::sqrt(1.0 + std::sin(0.5));
  f.stitches[0].law.breaking_force = 30.0 * (length - 1.0);
  EXPECT_NEAR(f.stitches[0].law.breaking_strain(), length - 1.0, 1e-15);
  Square square(f);
  std::vector<ElementForce> q(square.m.triangles.size());
  double torn = 0.0, before = 0.0;
  const auto step = [&](double gamma) {
    const std::vector<Vec3> x = square.sheared(gamma);
    before = membrane_energy(square.m, x, square.states).stitch;
    const GroupReport report =
        element_forces(square.m, x, 0.0, 0, square.m.groups(), {square.states, square.states}, q);
    torn += report.torn;
    EXPECT_EQ(report.lost, 0.0);
  };
  for (const double gamma : {0.2, 0.49, 0.1, 0.4999}) {
    step(gamma);
    EXPECT_GT(square.torque(gamma), 0.0);
    EXPECT_EQ(torn, 0.0);
  }
  const double stored = before;
  EXPECT_NEAR(stored, 1600.0 * 0.2 * 0.5 * 30.0 * std::pow(length - 1.0, 2), 1e-3 * stored);
  step(0.5001);
  EXPECT_EQ(before, 0.0); // what is broken at the end of the step stores nothing there
  EXPECT_NEAR(torn, stored, 1e-3 * stored);
  const double once = torn;
  for (const double gamma : {0.2, 0.9}) {
    step(gamma);
    EXPECT_NEAR(square.torque(gamma), 0.0, 1e-12);
    EXPECT_EQ(torn, once);
  }
}

/// Each strain group by itself.
TEST(Stitch, BreaksWhereItIsPulled) {
  Fabric f = biaxial();
  f.stitches = {stitch_at(0.0, 30.0)};
  f.stitches[0].law.breaking_force = 3.0;
  Square square(f);
  std::vector<Vec3> x = square.sheared(0.0);
  for (Vec3& p : x)
    if (p.x() > 5.0) p.x() += 0.2 * (p.x() - 5.0);
  std::vector<ElementForce> q(square.m.triangles.size());
  element_forces(square.m, x, 0.0, 0, square.m.groups(), {square.states, square.states}, q);
  const std::vector<std::vector<double>> strains = yarn_strains(square.m, x);
  int broken = 0;
  for (int p = 0; p < square.m.groups(); ++p) {
    const double strain = strains[2][at(square.m.group_begin[at(p)])];
    const double state = square.states[3 * at(p) + 2][0];
    EXPECT_EQ(state, strain > 0.1 ? 1.0 : 0.0) << strain;
    broken += state > 0.0 ? 1 : 0;
  }
  EXPECT_GT(broken, 0);
  EXPECT_LT(broken, square.m.groups());
}

TEST(StitchLaw, PretensionAndTable) {
  StitchLaw law;
  law.tension.strain = {0.0, 0.1, 0.3}, law.tension.tension = {0.0, 2.0, 10.0};
  law.taut_at = -law.tension.strain_at(4.0);
  EXPECT_NEAR(law.taut_at, -0.15, 1e-15);
  EXPECT_NEAR(law.at(0.0).value, 4.0, 1e-13);
  EXPECT_NEAR(law.at(0.0).energy, 0.1 + 0.15, 1e-13);
  EXPECT_EQ(law.at(-0.16).value, 0.0);
  law.breaking_force = 12.0; // by the last slope
  EXPECT_NEAR(law.breaking_strain(), 0.35 - 0.15, 1e-13);
  law.tension.tension = {0.0, 2.0, 2.0};
  EXPECT_TRUE(std::isinf(law.breaking_strain()));
  EXPECT_NEAR(law.tension.strain_at(2.0), 0.1, 1e-15);
}

/// Softening of fibres is a means against stiff yarns; stitches are as they are, and so is a sheet.
TEST(Stitch, IsNotSoftened) {
  Fabric f = non_crimp();
  f.sheet = IsotropicLaw{2.0, 0.3};
  Random random(42);
  const BlankMesh mesh = irregular_mesh(random);
  const std::vector<Vec3> x = random_state(mesh, 1.1, 0.3, random);
  const Membrane whole = make_membrane(mesh, f, 0.3, ElementKind::averaged);
  const Membrane soft = make_membrane(mesh, f, 0.3, ElementKind::averaged, 100.0);
  EXPECT_EQ(membrane_energy(soft, x).stitch, membrane_energy(whole, x).stitch);
  EXPECT_EQ(membrane_energy(soft, x).shear, membrane_energy(whole, x).shear);
  EXPECT_LT(membrane_energy(soft, x).fibre, 0.1 * membrane_energy(whole, x).fibre);
}

/// What stitches do not decide.
TEST(Stitch, LeavesTheFabricsNature) {
  const Fabric plain = biaxial();
  Fabric f = plain;
  f.stitches = {stitch_at(1.0, 30.0)};
  EXPECT_EQ(material_axes(f).first, material_axes(plain).first);
  EXPECT_EQ(material_axes(f).second, material_axes(plain).second);
  EXPECT_EQ(bending_law(f).families.size(), 2u);
  EXPECT_FALSE(is_weave(f));
  EXPECT_TRUE(is_weave(plain));
  EXPECT_EQ(balanced(f), balanced(plain));
  Fabric tape = unidirectional();
  tape.stitches = {stitch_at(0.9, 30.0)};
  EXPECT_EQ(axes_words(tape).second, "across");
}

} // namespace
} // namespace plyform::stitch_test
