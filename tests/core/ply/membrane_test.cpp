// SPDX-License-Identifier: GPL-3.0-or-later
// The membrane element against finite differences, the paper's own equations and closed forms.
#include "core/ply/membrane.hpp"
#include "support/membrane_checks.hpp"

#include <Eigen/Eigenvalues>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace plyform::membrane_test {
namespace {

constexpr double right_angle = 0.5 * std::numbers::pi;

enum class Term { fibre, shear, stabilisation, collapse_penalty, all };

/// Leaves one term of (E) standing.
void keep_only(Term term, Membrane& m) {
  if (term == Term::all) return;
  if (term != Term::fibre) m.families[0].yarn.stiffness = m.families[1].yarn.stiffness = 0.0;
  if (term != Term::shear) m.crossings[0].shear.k = {0.0};
  if (term == Term::fibre || term == Term::shear)
    for (MembraneFamily& family : m.families)
      family.side = {};
}

TEST(Membrane, ForceIsMinusEnergyGradient) {
  Random random(1);
  double worst = 0.0;
  for (const double omega0 : {right_angle, right_angle / 1.5})
    for (const ElementKind kind : {ElementKind::plain, ElementKind::averaged})
      for (const Term term :
           {Term::fibre, Term::shear, Term::stabilisation, Term::collapse_penalty, Term::all})
        for (int state = 0; state < 4; ++state) {
          if (term == Term::stabilisation && kind == ElementKind::plain) continue; // it is zero
          const BlankMesh mesh = irregular_mesh(random);
          Fabric fabric = glass_weave();
          fabric.families[1].angle = omega0;
          Membrane m = make_membrane(mesh, fabric, 3.0 * signed_unit(random), kind);
          keep_only(term, m);
          // fibres pull above a stretch of one only (some do at 1.2), the guard below one half
          const double stretch = term == Term::fibre              ? 1.2 + 0.2 * (state % 2)
                                 : term == Term::collapse_penalty ? 0.4
                                                                  : 0.75 + 0.3 * (state % 2);
          const double error = gradient_error(m, random_state(mesh, stretch, 0.5, random));
          EXPECT_LE(error, 1e-6) << "omega0 " << omega0 << " averaged "
                                 << (kind == ElementKind::averaged) << " term "
                                 << static_cast<int>(term) << " state " << state;
          worst = std::max(worst, error);
        }
  RecordProperty("worst", fmt::format("{:.2g}", worst));
}

TEST(Membrane, ForceIsMinusEnergyGradientWithCompressionToo) {
  Random random(12);
  for (const auto& [kind, buckles] :
       {std::pair(ElementKind::plain, false), std::pair(ElementKind::averaged, false),
        std::pair(ElementKind::averaged, true), std::pair(ElementKind::plain, true)})
    for (const double stretch : {0.4, 0.7, 0.97}) { // the guard acts too; all pressed; some
      const BlankMesh mesh = irregular_mesh(random);
      Fabric fabric = glass_weave();
      fabric.families[0].tension.compression = 460.0;
      fabric.families[1].tension.compression = 4800.0;
      if (buckles)
        fabric.families[0].tension.buckling_force = 20.0,
        fabric.families[1].tension.buckling_force = 100.0;
      Membrane m = make_membrane(mesh, fabric, 3.0 * signed_unit(random), kind);
      const std::vector<Vec3> x = random_state(mesh, stretch, 0.5, random);
      const auto strains = yarn_strains(m, x);
      ASSERT_TRUE(std::any_of(strains.begin(), strains.end(), [](const auto& of_family) {
        return std::any_of(of_family.begin(), of_family.end(), [](double s) { return s < -0.05; });
      }));
      EXPECT_LE(gradient_error(m, x), 1e-6) << stretch;
    }
}

/// Node forces of one triangle from the paper's (9)-(39), for fibres initially at 90 degrees.
std::array<Vec3, 3> paper_forces(const std::array<Vec2, 3>& x0, const std::array<Vec3, 3>& x,
                                 double warp_angle, const Fabric& fabric) {
  const Vec2 e1(std::cos(warp_angle), std::sin(warp_angle)), e2(-e1.y(), e1.x());
  const Vec2 s1 = x0[1] - x0[0], s2 = x0[2] - x0[0];
  const double area = 0.5 * (s1.x() * s2.y() - s1.y() * s2.x());
  const double a = e2.dot(s1) / e2.dot(s2); // warp line through M2: s1 - a s2 along e1
  const double b = e1.dot(s2) / e1.dot(s1); // weft line through M3: s2 - b s1 along e2
  // the lines' initial lengths, negative when they run against the fibre
  const double length1 = e1.dot(s1 - a * s2), length2 = e2.dot(s2 - b * s1);
  const Vec3 g1 = x[1] - x[0], g2 = x[2] - x[0]; // (8)
  const Vec3 k1 = g1 - a * g2, k2 = g2 - b * g1; // (11)
  const double k11 = k1.squaredNorm(), k22 = k2.squaredNorm(), k12 = k1.dot(k2);
  const double det = k11 * k22 - k12 * k12;
  const Vec3 up1 = (k22 * k1 - k12 * k2) / det, up2 = (k11 * k2 - k12 * k1) / det;
  const double n1 = fabric.families[0].tension.at(k1.norm() / std::abs(length1) - 1.0).value;
  const double n2 = fabric.families[1].tension.at(k2.norm() / std::abs(length2) - 1.0).value;
  const double t11 = n1 / k11, t22 = n2 / k22; // (2)(3)
  const double turned = length1 * length2 > 0.0 ? 1.0 : -1.0;
  const double gamma = right_angle - std::acos(turned * k12 / std::sqrt(k11 * k22));
  const double torque = fabric.crossings[0].shear.at(gamma).value;
  const double yarns1 = fabric.families[0].density * area / std::abs(length1);
  const double yarns2 = fabric.families[1].density * area / std::abs(length2);
  const double cells = fabric.families[0].density * fabric.families[1].density * area;
  const double r1[] = {a - 1.0, 1.0, -a}, r2[] = {b - 1.0, -b, 1.0}; // (26)
  std::array<Vec3, 3> internal;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 b1 = r1[i] * k1, b2 = r2[i] * k2; // (28)(33)
    const Vec3 b3 = r2[i] * k1, b4 = r1[i] * k2; // (37)(38)
    const double mixed = up1.dot(up2);
    const Vec3 shear = mixed / (k1.norm() * up2.norm()) * b1 + up2.norm() / k1.norm() * b4 +
                       mixed / (k2.norm() * up1.norm()) * b2 + up1.norm() / k2.norm() * b3; // (36)
    internal[i] = k1.norm() * yarns1 * t11 * b1 + k2.norm() * yarns2 * t22 * b2 +
                  turned * cells * torque * shear; // (31)(32)(39)
  }
  return internal;
}

TEST(Membrane, IsThePapersElement) {
  Random random(2);
  const Fabric fabric = glass_weave();
  for (int trial = 0; trial < 200; ++trial) {
    const BlankMesh mesh = irregular_mesh(random);
    const double angle = 3.0 * signed_unit(random);
    const Triangle t = mesh.triangles[static_cast<std::size_t>(trial) % mesh.triangles.size()];
    BlankMesh one;
    for (const int n : t)
      one.x.push_back(mesh.x[n]);
    one.triangles = {{0, 1, 2}};
    Membrane m = make_membrane(one, fabric, angle, ElementKind::plain);
    const std::vector<Vec3> x = random_state(one, 1.5, 0.2, random); // both families in tension
    const std::vector<Vec3> force = nodal_forces(m, x);
    const auto internal =
        paper_forces({one.x[0], one.x[1], one.x[2]}, {x[0], x[1], x[2]}, angle, fabric);
    for (std::size_t n = 0; n < 3; ++n)
      EXPECT_LE((force[n] + internal[n]).norm(), 1e-10 * largest_norm(force)) << trial;
    ASSERT_GT(yarn_strains(m, x)[0][0], 0.0);
    ASSERT_GT(yarn_strains(m, x)[1][0], 0.0);
    // without its tensions, so that the shear forces are not lost beside them
    m.families[0].yarn.stiffness = m.families[1].yarn.stiffness = 0.0;
    const std::vector<Vec3> shear = nodal_forces(m, x);
    Fabric slack = fabric;
    slack.families[0].tension.stiffness = slack.families[1].tension.stiffness = 0.0;
    const auto internal_shear =
        paper_forces({one.x[0], one.x[1], one.x[2]}, {x[0], x[1], x[2]}, angle, slack);
    for (std::size_t n = 0; n < 3; ++n)
      EXPECT_LE((shear[n] + internal_shear[n]).norm(), 1e-10 * largest_norm(shear)) << trial;
  }
}

TEST(Membrane, RigidMotionGivesNoForce) {
  Random random(3);
  for (const ElementKind kind : {ElementKind::plain, ElementKind::averaged}) {
    const BlankMesh mesh = irregular_mesh(random);
    Membrane m = make_membrane(mesh, glass_weave(), 0.7, kind);
    const Eigen::Matrix3d turn = random_rotation(random);
    std::vector<Vec3> x;
    for (const Vec2& p : mesh.x)
      x.emplace_back(turn * Vec3(p.x(), p.y(), 3.0) + Vec3(100.0, -200.0, 50.0));
    // rounding of 1e-13 in strain, times C d and a side of 10 mm
    EXPECT_LE(largest_norm(nodal_forces(m, x)), 1e-12 * 46000.0 * 0.25 * 10.0);
    EXPECT_LE(energy_of(m, x), 1e-12);
    EXPECT_GE(energy_of(m, x), 0.0);
  }
}

TEST(Membrane, ForcesHaveNoSumAndNoMoment) {
  Random random(4);
  for (const ElementKind kind : {ElementKind::plain, ElementKind::averaged})
    for (int state = 0; state < 10; ++state) {
      const BlankMesh mesh = irregular_mesh(random);
      Membrane m = make_membrane(mesh, glass_weave(), 3.0 * signed_unit(random), kind);
      set_viscosity(m, {1e-3, 1e-3});
      const std::vector<Vec3> x = random_state(mesh, 1.05, 1.0, random);
      const std::vector<Vec3> force = nodal_forces(m, x, 1e-5); // viscous forces too
      Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
      for (std::size_t n = 0; n < x.size(); ++n) {
        sum += force[n];
        moment += x[n].cross(force[n]);
      }
      EXPECT_LE(sum.norm(), 1e-13 * largest_norm(force)); // rounding
      EXPECT_LE(moment.norm(), 1e-12 * largest_norm(force) * 30.0);
    }
}

/// Sum of the forces on the nodes at the right-hand edge of a mesh.
Vec3 edge_force(const BlankMesh& mesh, const std::vector<Vec3>& force, double right) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t n = 0; n < mesh.x.size(); ++n)
    if (mesh.x[n].x() > right - 1e-9) sum += force[n];
  return sum;
}

TEST(Membrane, StretchAlongWarpPullsWithEveryYarn) {
  const BlankMesh mesh = mesh_blank(rectangle(40.0, 20.0, 5.0), 0.0, right_angle);
  const double strain = 0.003;
  for (const ElementKind kind : {ElementKind::plain, ElementKind::averaged}) {
    Membrane m = make_membrane(mesh, glass_weave(), 0.0, kind);
    std::vector<Vec3> x;
    for (const Vec2& p : mesh.x)
      x.emplace_back((1.0 + strain) * p.x(), p.y(), 0.0);
    const double yarns = 0.25 * 20.0;
    const Vec3 pull = edge_force(mesh, nodal_forces(m, x), 20.0);
    EXPECT_NEAR(pull.x(), -yarns * 46000.0 * strain, 1e-9); // N, of 690 N
    EXPECT_NEAR(pull.y(), 0.0, 1e-9);
    const MembraneEnergy e = membrane_energy(m, x);
    EXPECT_NEAR(e.fibre, yarns * 40.0 * 0.5 * 46000.0 * strain * strain, 1e-9);
    EXPECT_NEAR(e.shear, 0.0, 1e-20);
    // pressed, not a newton: fibres carry tension only
    for (std::size_t n = 0; n < x.size(); ++n)
      x[n].x() = 0.9 * mesh.x[n].x();
    EXPECT_LE(largest_norm(nodal_forces(m, x)), 1e-9);
  }
}

TEST(Membrane, PureShearTurnsEveryCell) {
  const BlankMesh mesh = mesh_blank(rectangle(40.0, 20.0, 5.0), 0.0, right_angle);
  const Fabric fabric = glass_weave();
  for (const double gamma : {-0.6, 0.1, 0.9}) {
    Membrane m = make_membrane(mesh, fabric, 0.0, ElementKind::averaged);
    const Vec3 f1 = Vec3::UnitX(), f2(std::sin(gamma), std::cos(gamma), 0.0);
    std::vector<Vec3> x;
    for (const Vec2& p : mesh.x)
      x.emplace_back(p.x() * f1 + p.y() * f2);
    const double cells = 0.25 * 0.25 * 40.0 * 20.0;
    EXPECT_NEAR(membrane_energy(m, x).shear, cells * fabric.crossings[0].shear.at(gamma).energy,
                1e-11);
    // Power balance of a picture frame: the right-hand edge feels a force square to the warp, with
    // the arm of 40 mm it holds the torque of all cells.
    const Vec3 pull = edge_force(mesh, nodal_forces(m, x), 20.0);
    // fibre strains of rounding, 1e-16, times C d and the width: 1e-11 N
    EXPECT_NEAR(pull.x(), 0.0, 1e-9);
    EXPECT_NEAR(40.0 * pull.y(), cells * fabric.crossings[0].shear.at(gamma).value * -1.0, 1e-8);
  }
}

TEST(Membrane, DoesNotCareWhichNodeComesFirst) {
  Random random(5);
  BlankMesh mesh = irregular_mesh(random);
  Membrane before = make_membrane(mesh, glass_weave(), 0.4, ElementKind::averaged);
  for (std::size_t e = 0; e < mesh.triangles.size(); ++e)
    std::rotate(mesh.triangles[e].begin(), mesh.triangles[e].begin() + 1 + e % 2,
                mesh.triangles[e].end());
  Membrane after = make_membrane(mesh, glass_weave(), 0.4, ElementKind::averaged);
  const std::vector<Vec3> x = random_state(mesh, 1.05, 1.0, random);
  const std::vector<Vec3> f = nodal_forces(before, x), g = nodal_forces(after, x);
  for (std::size_t n = 0; n < x.size(); ++n)
    EXPECT_LE((f[n] - g[n]).norm(), 1e-13 * largest_norm(f)); // rounding
}

TEST(Membrane, YarnStrainsAreThePatchesMeans) {
  Random random(6);
  const BlankMesh mesh = irregular_mesh(random);
  const Membrane m = make_membrane(mesh, glass_weave(), 0.4, ElementKind::averaged);
  ASSERT_LT(m.groups(), static_cast<int>(mesh.triangles.size()));
  const std::vector<Vec3> x = random_state(mesh, 1.05, 1.0, random);
  const auto strains = yarn_strains(m, x);
  for (std::size_t p = 0; p + 1 < m.group_begin.size(); ++p) {
    double area = 0.0, sum1 = 0.0, sum2 = 0.0;
    for (int e = m.group_begin[p]; e < m.group_begin[p + 1]; ++e) {
      const AxesState s = axes_state(m, x, e);
      area += m.area[e];
      sum1 += m.area[e] * (s.lambda1 - 1.0);
      sum2 += m.area[e] * (s.lambda2 - 1.0);
    }
    for (int e = m.group_begin[p]; e < m.group_begin[p + 1]; ++e) {
      EXPECT_NEAR(strains[0][at(e)], sum1 / area, 1e-14);
      EXPECT_NEAR(strains[1][at(e)], sum2 / area, 1e-14);
    }
  }
}

TEST(Membrane, ConstantStrainsPutNoForceOnInnerNodesOfGradedMeshes) {
  BlankSpec spec = rectangle(60.0, 40.0, 5.0, MeshKind::alternating);
  spec.zones.resize(1);
  spec.zones[0].centre = {4.0, 3.0}, spec.zones[0].radius = 9.0, spec.zones[0].element_size = 1.2;
  const BlankMesh mesh = mesh_blank(spec, 0.0, right_angle);
  std::vector<Vec3> x;
  for (const Vec2& p : mesh.x)
    x.emplace_back(1.02 * p.x() + 0.3 * p.y(), 1.01 * p.y(), 0.2 * p.x());
  for (const double warp : {0.0, 0.4}) { // the element is plain in parts at 0
    Membrane m = make_membrane(mesh, glass_weave(), warp, ElementKind::automatic);
    const std::vector<Vec3> f = nodal_forces(m, x);
    for (std::size_t n = 0; n < x.size(); ++n)
      if (std::abs(mesh.x[n].x()) < 29.0 && std::abs(mesh.x[n].y()) < 19.0) {
        EXPECT_LE(f[n].norm(), 1e-12 * largest_norm(f)); // rounding; the rim carries the load
      }
  }
}

TEST(Membrane, YarnTensionsKeepTheirSumAndEvenOutThoseOfPairs) {
  const BlankMesh mesh = mesh_blank(rectangle(60.0, 60.0, 5.0), 0.0, right_angle);
  std::vector<Vec3> x;
  for (const Vec2& p : mesh.x)
    x.emplace_back(1.01 * p.x(), 1.002 * p.y(), 0.0);
  for (const bool scattered : {false, true}) {
    if (scattered) // by some per mille of strain
      for (std::size_t n = 0; n < x.size(); ++n)
        x[n].x() += n % 2 ? 0.01 : -0.01;
    for (const ElementKind kind : {ElementKind::plain, ElementKind::averaged}) {
      const Membrane m = make_membrane(mesh, glass_weave(), 0.3, kind);
      const auto strains = yarn_strains(m, x), tensions = yarn_tensions(m, x);
      double sum = 0.0, expected = 0.0, lowest = 1e9, highest = 0.0, raw_lowest = 1e9,
             raw_highest = 0.0;
      for (std::size_t e = 0; e < m.triangles.size(); ++e) {
        const double raw = m.families[0].yarn.at(strains[0][e]).value;
        EXPECT_TRUE(kind == ElementKind::averaged || tensions[0][e] == raw);
        sum += m.area[e] * tensions[0][e];
        expected += m.area[e] * raw;
        lowest = std::min(lowest, tensions[0][e]);
        highest = std::max(highest, tensions[0][e]);
        raw_lowest = std::min(raw_lowest, raw);
        raw_highest = std::max(raw_highest, raw);
      }
      EXPECT_NEAR(sum, expected, 1e-12 * expected); // a mean of means, by area
      const double spread = highest - lowest, raw_spread = raw_highest - raw_lowest;
      if (!scattered) {
        EXPECT_LT(spread, 1e-9 * highest); // an even tension stays
      } else if (kind == ElementKind::averaged) {
        EXPECT_LT(spread, 0.5 * raw_spread);
      }
    }
  }
}

TEST(Membrane, ViscosityDoesItsWorkByTheTrapezoidalRule) {
  const BlankMesh mesh = mesh_blank(rectangle(20.0, 20.0, 10.0), 0.0, right_angle);
  Membrane m = make_membrane(mesh, glass_weave(), 0.0, ElementKind::plain);
  set_viscosity(m, {0.02, 0.0});
  std::vector<ElementForce> q(m.triangles.size());
  std::vector<YarnMemory> states = memory_at_start(m);
  const double dt = 1e-5, area = 400.0, d1 = 0.25;
  double last = 0.0, expected = 0.0, last_tension = 0.0;
  for (const double strain : {0.001, 0.003, 0.002, -0.001, 0.004}) {
    std::vector<Vec3> x;
    for (const Vec2& p : mesh.x)
      x.emplace_back((1.0 + strain) * p.x(), p.y(), 0.0);
    const double work = element_forces(m, x, dt, 0, m.groups(), {states, states}, q).lost;
    const double tension = strain > 0.0 ? 0.02 * (strain - last) / dt : 0.0;
    expected = 0.5 * area * d1 * (tension + last_tension) * (strain - last);
    EXPECT_NEAR(work, expected, 1e-9 * std::abs(expected)) << strain; // rounding of strains
    last = strain, last_tension = tension;
  }
}

TEST(Membrane, PicksTheElementThatSuitsTheMesh) {
  const BlankMesh mesh = mesh_blank(rectangle(30.0, 30.0, 10.0), 0.0, right_angle);
  const auto groups = [&](double angle) {
    return make_membrane(mesh, glass_weave(), angle, ElementKind::automatic).groups();
  };
  EXPECT_EQ(groups(0.0), 18);            // sides along both families: the paper's element
  EXPECT_EQ(groups(right_angle / 2), 9); // pairs
  // cells along the yarns inside, a band of others along the rim
  const BlankMesh cut = mesh_blank(rectangle(200.0, 200.0, 10.0, MeshKind::fibres), 0.5, 2.0);
  Fabric skew = glass_weave();
  skew.families[1].angle = 1.5;
  const auto triangles = static_cast<int>(cut.triangles.size());
  EXPECT_GT(make_membrane(cut, skew, 0.5, ElementKind::automatic).groups(), 0.98 * triangles);
  // one half along the yarns, the other shaken
  BlankMesh half = mesh_blank(rectangle(200.0, 100.0, 10.0), 0.0, right_angle);
  Random random(4);
  for (Vec2& p : half.x)
    if (p.x() > 5.0 && p.x() < 95.0 && std::abs(p.y()) < 45.0)
      p += 3.0 * Vec2(signed_unit(random), signed_unit(random));
  const Membrane m = make_membrane(half, glass_weave(), 0.0, ElementKind::automatic);
  int strays = 0;
  for (std::size_t p = 0; p < static_cast<std::size_t>(m.groups()); ++p) {
    const bool alone = m.group_begin[p + 1] - m.group_begin[p] == 1;
    double x = 0.0; // of the group's first triangle
    for (const int n : m.triangles[m.group_begin[p]])
      x += half.x[n].x() / 3.0;
    EXPECT_TRUE(alone || x > 0.0) << x;
    strays += alone && x > 20.0;
  }
  EXPECT_LE(strays, 2);
  BlankMesh turned = mesh;
  std::swap(turned.triangles[0][0], turned.triangles[0][1]);
  EXPECT_THROW(make_membrane(turned, glass_weave(), 0.0, ElementKind::plain),
               std::invalid_argument);
}

} // namespace
} // namespace plyform::membrane_test
