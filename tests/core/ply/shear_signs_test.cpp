// SPDX-License-Identifier: GPL-3.0-or-later
// Membranes whose law of shear differs by the sign of the angle.
#include "core/ply/membrane_eigenvalue.hpp"
#include "core/ply/membrane_simd.hpp"
#include "support/membrane_checks.hpp"

#include <gtest/gtest.h>

namespace plyform::shear_signs_test {
namespace {

/// Three families whose crossings have laws of both signs of either form.
Fabric two_sided_triaxial() {
  Fabric f = triaxial();
  f.crossings[0].shear = two_sided_weave().crossings[0].shear;
  f.crossings[2].shear = two_sided_table().crossings[0].shear;
  return f;
}

const std::vector<Fabric>& fabrics() {
  static const std::vector<Fabric> all{two_sided_weave(), two_sided_table(), two_sided_table(true),
                                       two_sided_triaxial()};
  return all;
}

/// A state sheared by gamma (rad) on the whole and shaken, so that pairs have deviations.
std::vector<Vec3> sheared(const BlankMesh& mesh, double gamma, double noise, Random& random) {
  const Vec2 f1(1.01, 0.0), f2(1.01 * std::sin(gamma), 1.01 * std::cos(gamma));
  const Eigen::Matrix3d turn = random_rotation(random);
  std::vector<Vec3> x;
  for (const Vec2& p : mesh.x) {
    const Vec2 q = p.x() * f1 + p.y() * f2;
    x.push_back(turn * (Vec3(q.x(), q.y(), 0.0) + noise * random_vector(random)));
  }
  return x;
}

/// Shear alone, or with all else; both signs, and angles about 0.
TEST(ShearSigns, ForceIsMinusEnergyGradientOnBothSidesAndThroughZero) {
  Random random(41);
  for (Fabric fabric : fabrics())
    for (const bool yarns : {true, false})
      for (const ElementKind kind : {ElementKind::plain, ElementKind::averaged})
        for (const double gamma : {-0.7, -0.2, 0.0, 0.2, 0.7}) {
          if (!yarns)
            for (YarnFamily& family : fabric.families)
              family.tension = {}, family.tension.stiffness = 1e-3;
          const BlankMesh mesh = irregular_mesh(random);
          Membrane m = make_membrane(mesh, fabric, 0.0, kind);
          const std::vector<Vec3> x = sheared(mesh, gamma, 0.5, random);
          EXPECT_LE(gradient_error(m, x), 1e-6)
              << fabric.families.size() << " at " << gamma << (yarns ? " with yarns" : "");
        }
}

TEST(ShearSigns, ForcesHaveNoSumAndNoMoment) {
  Random random(42);
  for (const Fabric& fabric : fabrics())
    for (const double gamma : {-0.5, 0.0, 0.5}) {
      const BlankMesh mesh = irregular_mesh(random);
      const Membrane m = make_membrane(mesh, fabric, 0.3, ElementKind::averaged);
      const std::vector<Vec3> x = sheared(mesh, gamma, 0.5, random), force = nodal_forces(m, x);
      Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
      for (std::size_t n = 0; n < x.size(); ++n)
        sum += force[n], moment += x[n].cross(force[n]);
      EXPECT_LE(sum.norm(), 1e-13 * largest_norm(force)); // rounding
      EXPECT_LE(moment.norm(), 1e-12 * largest_norm(force) * 30.0);
    }
}

/// The second family to the left of the first: shear that leans it towards the first closes the
/// angle between them, and stretches the diagonal first + second.
TEST(ShearSigns, AngleThatClosesIsPositive) {
  const BlankMesh mesh = mesh_blank(rectangle(40.0, 20.0, 5.0), 0.0, 0.5 * std::numbers::pi);
  for (const double gamma : {-0.5, 0.5}) {
    const Membrane m = make_membrane(mesh, two_sided_weave(), 0.0, ElementKind::averaged);
    std::vector<Vec3> x;
    for (const Vec2& p : mesh.x)
      x.emplace_back(p.x() + p.y() * std::sin(gamma), p.y() * std::cos(gamma), 0.0);
    TriangleState t;
    find_triangle(m, x, 0, t);
    EXPECT_NEAR(shown_shear(m, t), gamma, 1e-14);
    EXPECT_EQ((t.yarn[0].f + t.yarn[1].f).norm() > std::sqrt(2.0), gamma > 0.0);
    const double torque = gamma > 0.0 ? 0.37044 * 0.5 + 0.84105 * 0.125 + 1.03113 * 0.03125
                                      : 0.037 * 0.5 + 0.084 * 0.125 + 0.103 * 0.03125;
    double pull = 0.0; // square to the first family, at the right-hand edge: arm 40 mm
    const std::vector<Vec3> force = nodal_forces(m, x);
    for (std::size_t n = 0; n < x.size(); ++n)
      if (mesh.x[n].x() > 20.0 - 1e-9) pull += force[n].y();
    EXPECT_NEAR(40.0 * std::abs(pull), 0.0625 * 800.0 * torque, 1e-8);
  }
}

TEST(ShearSigns, PacksAgreeWithTheMembraneOneByOne) {
  Random random(43);
  for (const Fabric& fabric : fabrics())
    for (const ElementKind kind : {ElementKind::plain, ElementKind::averaged})
      for (const double gamma : {-0.8, -0.1, 0.0, 0.1, 0.8}) {
        const BlankMesh mesh = irregular_mesh(random);
        const Membrane m = make_membrane(mesh, fabric, 0.0, kind);
        const std::vector<Vec3> x = sheared(mesh, gamma, 0.5, random), slow = nodal_forces(m, x);
        MembraneSimd simd = make_membrane_simd(m, x);
        std::vector<SimdYarnStates> states = states_at_start(simd, m);
        MembraneEnergy energy;
        for (int b = 0; b < static_cast<int>(simd.blocks.size()); ++b) {
          simd_forces(simd, m, x, 0.0, b, {states, states});
          const MembraneEnergy e = simd_energy(simd, m, x, 0.0, b, states);
          energy.fibre += e.fibre, energy.shear += e.shear;
        }
        for (std::size_t n = 0; n < x.size(); ++n)
          EXPECT_LE((simd_force(simd, n) - slow[n]).norm(), 1e-12 * largest_norm(slow)) << gamma;
        const MembraneEnergy of_slow = membrane_energy(m, x);
        // of a side that does not resist, 0 but for rounding
        EXPECT_NEAR(energy.shear, of_slow.shear, 1e-12 * of_slow.shear + 1e-12);
      }
}

/// Shear alone, at rest and in any state: the element is nowhere softer than its softer side makes
/// it by more than what deviations push towards rest.
TEST(ShearSigns, StepReliesOnTheStifferSide) {
  Membrane m = make_membrane(mesh_blank(rectangle(20.0, 20.0, 5.0), 0.0, 1.5), two_sided_weave(),
                             0.0, ElementKind::averaged);
  const MembraneCrossing& c = m.crossings[0];
  for (const double gamma : {-0.6, -0.1, 0.1, 0.6})
    EXPECT_EQ(shear_slope(c, gamma), c.shear.at(std::abs(gamma)).slope);
  m = make_membrane(mesh_blank(rectangle(20.0, 20.0, 5.0), 0.0, 1.5), two_sided_table(), 0.0,
                    ElementKind::averaged);
  double steepest = 0.0;
  for (double g = -1.2; g < 1.2; g += 1e-4)
    steepest = std::max(steepest, m.crossings[0].shear.at(g).slope);
  EXPECT_GE(shear_slope(m.crossings[0], 0.0), steepest * (1.0 - 1e-12));
  EXPECT_LE(shear_slope(m.crossings[0], 0.0), steepest * (1.0 + 1e-6)); // found in steps
  EXPECT_GE(deviation_stiffness(m.crossings[0], 0.0), 8.0 * 0.0625 * steepest * (1.0 - 1e-12));
}

} // namespace
} // namespace plyform::shear_signs_test
