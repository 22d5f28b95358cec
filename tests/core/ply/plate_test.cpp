// SPDX-License-Identifier: GPL-3.0-or-later
// Plates with small deflections against closed forms, on every kind of mesh: twisted by forces at
// corners, simply supported and clamped under a uniform load, strips, and what a constant moment
// leaves on inner nodes.
#include "support/bending_laws.hpp"
#include "support/scene_checks.hpp"
#include "support/static_plate.hpp"

#include <gtest/gtest.h>
#include <iostream>

namespace plyform::plate_test {
namespace {

constexpr double side = 60.0;     // mm
constexpr double pressure = 1e-6; // N/mm^2

BendingLaw weave(double warp, double weft, double twist) {
  BendingLaw law = weave_bending();
  law.families[0].law.stiffness = warp; // N mm
  law.families[1].law.stiffness = weft;
  law.twist = twist;
  return law;
}

/// An isotropic plate of 2 N mm, Poisson's ratio 0.3.
BendingLaw isotropic() {
  BendingLaw law = weave(2.0, 2.0, 2.8);
  law.coupling = 0.6;
  return law;
}

struct NamedMesh {
  const char* name;
  BlankMesh mesh;
};

BlankMesh rectangle_of(MeshKind kind, double width, double element) {
  return mesh_blank(rectangle(side, width, element, kind), 0.0, 0.0);
}

/// Distance from the rim of the plate, mm.
double from_rim(const Vec2& p, double width = side) {
  return std::min(0.5 * side - std::abs(p.x()), 0.5 * width - std::abs(p.y()));
}

/// Squares with elements a third as large in a disc that is not in the middle.
BlankMesh graded_rectangle(double width, double element) {
  BlankSpec spec = rectangle(side, width, element, MeshKind::alternating);
  MeshZone zone;
  zone.centre = {0.1 * side, 0.1 * width}, zone.radius = 0.25 * width;
  zone.element_size = element / 3.0;
  spec.zones = {zone};
  return mesh_blank(spec, 0.0, 0.0);
}

/// Squares with so many elements a side, with one diagonal, with every kind of them, and with inner
/// nodes moved at random by a quarter of an element, free triangles, and graded ones.
std::vector<NamedMesh> meshes(int elements, double width = side) {
  const double element = side / elements;
  std::vector<NamedMesh> all{{"diagonal", rectangle_of(MeshKind::diagonal, width, element)},
                             {"alternating", rectangle_of(MeshKind::alternating, width, element)},
                             {"crossed", rectangle_of(MeshKind::crossed, width, element)},
                             {"free", rectangle_of(MeshKind::free, width, element)},
                             {"graded", graded_rectangle(width, element)},
                             {"shaken", rectangle_of(MeshKind::diagonal, width, element)}};
  Random random(3);
  for (Vec2& p : all.back().mesh.x)
    if (from_rim(p, width) > 1e-6 * side)
      p += 0.25 * element * Vec2(signed_unit(random), signed_unit(random));
  return all;
}

Eigen::VectorXd nothing_held(const BlankMesh& mesh) {
  return Eigen::VectorXd::Constant(static_cast<Eigen::Index>(mesh.x.size()),
                                   std::numeric_limits<double>::quiet_NaN());
}

/// Force at the corners, N, of a plate twisted by `twist` (1/mm), over D_t times that.
double corner_force_over_theory(const BlankMesh& mesh, const BendingLaw& law, double warp) {
  constexpr double twist = 1e-4; // w = twist x y
  const StaticPlate plate = make_plate(mesh, law, warp);
  Eigen::VectorXd held = nothing_held(mesh);
  for (std::size_t n = 0; n < mesh.x.size(); ++n)
    if (std::abs(mesh.x[n].x()) + std::abs(mesh.x[n].y()) > side * (1.0 - 1e-9))
      held[static_cast<Eigen::Index>(n)] = twist * mesh.x[n].x() * mesh.x[n].y();
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(held.size());
  const Eigen::VectorXd force = plate.stiffness * deflect(plate, none, held);
  double sum = 0.0;
  for (Eigen::Index n = 0; n < held.size(); ++n)
    if (!std::isnan(held[n])) sum += std::abs(force[n]);
  return 0.25 * sum / (law.twist * twist);
}

/// w = twist x y has no moment across edges, so corner forces of 2 M_12 = D_t twist hold it.
TEST(Plates, TwistedByForcesAtCornersHaveTheirClosedForm) {
  for (const int elements : {6, 12, 24})
    for (const NamedMesh& m : meshes(elements)) {
      const double woven = corner_force_over_theory(m.mesh, weave(2.0, 2.0, 3.0), 0.0);
      const double uneven = corner_force_over_theory(m.mesh, weave(5.0, 0.5, 0.5), 0.0);
      const double turned = corner_force_over_theory(m.mesh, isotropic(), 0.4);
      // 1e-7: constants are exact for quadratics and add up; rounding grows with the matrix
      for (const double found : {woven, uneven, turned})
        EXPECT_NEAR(found, 1.0, 1e-7) << m.name << ", " << elements;
      std::cout << "[ twist    ] " << elements << ' ' << m.name << ": " << woven << ' ' << uneven
                << ' ' << turned << '\n';
    }
}

/// Deflection in the middle, mm.
double middle_of(const BlankMesh& mesh, const Eigen::VectorXd& w) {
  std::vector<int> nearest(mesh.x.size());
  for (std::size_t n = 0; n < nearest.size(); ++n)
    nearest[n] = static_cast<int>(n);
  std::stable_sort(nearest.begin(), nearest.end(), [&](int a, int b) {
    return mesh.x[a].squaredNorm() < mesh.x[b].squaredNorm() - 1e-9;
  });
  if (mesh.x[nearest[0]].norm() < 1e-6) return w[nearest[0]];
  Eigen::Matrix<double, 12, 6> terms; // a parabola through the twelve nearest nodes
  Eigen::Matrix<double, 12, 1> values;
  for (Eigen::Index i = 0; i < 12; ++i) {
    const Vec2& p = mesh.x[nearest[static_cast<std::size_t>(i)]];
    terms.row(i) << 1.0, p.x(), p.y(), p.x() * p.x(), p.y() * p.y(), p.x() * p.y();
    values[i] = w[nearest[static_cast<std::size_t>(i)]];
  }
  return terms.colPivHouseholderQr().solve(values)[0];
}

/// Deflection in the middle under the pressure, nodes within `band` (mm) of the rim held.
double loaded(const BlankMesh& mesh, const BendingLaw& law, double warp, double band,
              double width = side) {
  const StaticPlate plate = make_plate(mesh, law, warp);
  Eigen::VectorXd held = nothing_held(mesh), force(held.size());
  for (std::size_t n = 0; n < mesh.x.size(); ++n) {
    force[static_cast<Eigen::Index>(n)] = pressure * plate.bending.area[n];
    if (from_rim(mesh.x[n], width) <= band) held[static_cast<Eigen::Index>(n)] = 0.0;
  }
  return middle_of(mesh, deflect(plate, force, held));
}

/// Navier's series for a simply supported plate whose yarns lie along its edges.
double navier(const BendingLaw& law, double width) {
  double sum = 0.0;
  const double cross = 2.0 * law.coupling + law.twist;
  for (int m = 1; m < 100; m += 2)
    for (int n = 1; n < 100; n += 2) {
      const double a = m * std::numbers::pi / side, b = n * std::numbers::pi / width;
      const double sign = (m + n) % 4 == 2 ? 1.0 : -1.0; // sin(m pi/2) sin(n pi/2)
      sum += sign * 16.0 * pressure / (std::numbers::pi * std::numbers::pi * m * n) /
             (law.families[0].law.stiffness * std::pow(a, 4) +
              law.families[1].law.stiffness * std::pow(b, 4) + cross * a * a * b * b);
    }
  return sum;
}

TEST(Plates, SimplySupportedUnderAUniformLoadSagAsNaviersSeries) {
  constexpr double rim = 1e-6; // mm
  for (const double width : {side, 0.5 * side})
    for (const int elements : {6, 12, 24})
      for (const NamedMesh& m : meshes(elements, width)) {
        const auto over_theory = [&](const BendingLaw& law, double warp) {
          return loaded(m.mesh, law, warp, rim, width) / navier(law, width);
        };
        const double woven = over_theory(weave(2.0, 2.0, 3.0), 0.0);
        const double uneven = over_theory(weave(5.0, 0.5, 0.5), 0.0);
        const double turned = over_theory(isotropic(), 0.4);
        std::cout << "[ supported] " << side << " x " << width << ", " << elements << ' ' << m.name
                  << ": " << woven << ' ' << uneven << ' ' << turned << '\n';
        if (elements * width < 12 * side) continue; // six elements across: in the table only
        for (const double found : {woven, uneven, turned})
          EXPECT_NEAR(found, 1.0, elements * width < 24 * side ? 0.03 : 0.01)
              << m.name << ", " << elements;
      }
}

/// Nodes on the rim and about one element within are held: the plate bends over the inner ones by
/// what lies half an element on either side of them, so there the clamp lies, half an element
/// outside.
TEST(Plates, ClampedOnesConvergeAndSquaresAreHeldHalfAnElementBehindTheClamp) {
  // Timoshenko and Woinowsky-Krieger, table 35: w = 0.00126 p a^4 / D, here with another digit
  const auto theory = [](double a) { return 0.0012653 * pressure * std::pow(a, 4) / 2.0; };
  std::vector<double> before;
  for (const int elements : {6, 12, 24}) {
    const double element = side / elements;
    std::size_t i = 0;
    for (const NamedMesh& m : meshes(elements)) {
      const double sag = loaded(m.mesh, isotropic(), 0.0, 1.3 * element); // two rows
      const double whole = sag / theory(side), shorter = sag / theory(side - element);
      std::cout << "[ clamped  ] " << elements << ' ' << m.name << ": " << whole
                << ", with the clamp half an element outside " << shorter << '\n';
      if (elements > 12) {
        EXPECT_LE(std::abs(whole - 1.0), 0.65 * std::abs(before[i] - 1.0)) << m.name; // first order
        EXPECT_NEAR(whole, 1.0, 0.25) << m.name;
        if (i < 2) { // nodes in rows, one element apart
          EXPECT_NEAR(shorter, 1.0, 0.01) << m.name;
        }
      }
      if (elements == 6)
        before.push_back(whole);
      else
        before[i] = whole;
      ++i;
    }
  }
}

/// Yarns at an angle, limp ones across, free triangles: none may give way more than its beam.
TEST(Plates, StripsBendAsBeamsOnEveryMesh) {
  constexpr double width = 20.0, force = 1e-5; // mm, N
  for (const int elements : {12, 24})
    for (const NamedMesh& m : meshes(elements, width))
      for (const auto& [law, warp] :
           {std::pair(weave(10.0, 2.0, 4.5), 0.0), std::pair(weave(10.0, 0.5, 1.0), 0.0),
            std::pair(weave(10.0, 10.0, 20.0), 0.5)}) {
        const StaticPlate plate = make_plate(m.mesh, law, warp);
        Eigen::VectorXd held = nothing_held(m.mesh), load = Eigen::VectorXd::Zero(held.size());
        for (std::size_t n = 0; n < m.mesh.x.size(); ++n) { // on its ends, loaded in the middle
          const auto i = static_cast<Eigen::Index>(n);
          if (std::abs(m.mesh.x[n].x()) > 0.5 * side - 1e-6) held[i] = 0.0;
          load[i] = force / (side * width) * plate.bending.area[n];
        }
        const double found = middle_of(m.mesh, deflect(plate, load, held));
        const double beam = 5.0 / 384.0 * force / width * std::pow(side, 3) / 10.0;
        EXPECT_NEAR(found / beam, 1.0, elements == 12 ? 0.03 : 0.01) << m.name << ", " << elements;
        std::cout << "[ strip    ] " << elements << ' ' << m.name << ": " << found / beam << '\n';
      }
}

/// What enters one cell leaves another, so nothing is left on nodes whose neighbours are inside.
TEST(Plates, ConstantMomentsPutNoForceOnInnerNodes) {
  for (const NamedMesh& m : meshes(12)) {
    const StaticPlate plate = make_plate(m.mesh, isotropic(), 0.3);
    Eigen::MatrixXd w(plate.stiffness.rows(), 3);
    for (std::size_t n = 0; n < m.mesh.x.size(); ++n) {
      const Vec2& p = m.mesh.x[n];
      w.row(static_cast<Eigen::Index>(n)) << 0.5 * p.x() * p.x(), 0.5 * p.y() * p.y(),
          p.x() * p.y();
    }
    const Eigen::MatrixXd force = plate.stiffness * w; // N, for curvatures of 1/mm
    double largest = 0.0;
    for (std::size_t n = 0; n < m.mesh.x.size(); ++n)
      if (from_rim(m.mesh.x[n]) > 0.3 * side) // four elements: no stencil reaches the rim
        largest = std::max(largest, force.row(static_cast<Eigen::Index>(n)).cwiseAbs().maxCoeff());
    EXPECT_LE(largest, 1e-10) << m.name; // stencils alone have 2 N mm
  }
}

} // namespace
} // namespace plyform::plate_test
