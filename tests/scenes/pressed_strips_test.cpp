// SPDX-License-Identifier: GPL-3.0-or-later
// Pressures on strips against closed forms, at rest: between two edges, and over a groove.
#include "core/run/run.hpp"
#include "core/solver/scene.hpp"
#include "support/pressure_scenes.hpp"
#include "support/strip_scenes.hpp"

#include <gtest/gtest.h>

namespace plyform::pressed_strips_test {
namespace {

using namespace pressure_scenes;

// ---- a strip between two edges ----

/// L = 100 mm between its held edges, 20 mm wide, kept plane across. A sheet, or yarns along it.
Case inflated_strip(bool yarns, double pressure, PlyFace side) {
  Case data = stack_of({0.0}, rectangle(100.0, 20.0, 2.5));
  data.plies[0].z = 0.0;
  if (!yarns) data.fabrics = {film()};
  data.boundaries = {hold("left", {-50, -10}, {-50, 10}, Vec3::UnitX(), 0.0),
                     hold("right", {50, -10}, {50, 10}, Vec3::UnitX(), 0.0)};
  hold_all(data, {false, true, false});
  inflate(data, pressure, 0.03, 1000.0);
  data.loads[0].side = side;
  data.solver.fibre_softening = yarns ? 100.0 : 1.0;
  return data;
}

/// Half the angle (rad) of the arc that a strip is blown to, stretched by angle/sin(angle), T = p
/// r.
template <class Law>
double half_angle(double p, const Law& tension) {
  return root(1e-4, 1.5,
              [&](double a) { return tension(a / std::sin(a)) - p * 50.0 / std::sin(a); });
}

/// The radius of the circle through points (x, z), by least squares, and their largest distance
/// from it over the radius.
std::pair<double, double> circle_through(const std::vector<Vec3>& points) {
  Eigen::MatrixXd m(points.size(), 3);
  Eigen::VectorXd v(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3& x = points[i];
    m.row(static_cast<Eigen::Index>(i)) << 2.0 * x.x(), 2.0 * x.z(), 1.0;
    v[static_cast<Eigen::Index>(i)] = x.x() * x.x() + x.z() * x.z();
  }
  const Eigen::Vector3d c = m.colPivHouseholderQr().solve(v);
  const double r = std::sqrt(c[2] + c[0] * c[0] + c[1] * c[1]);
  double off = 0.0;
  for (const Vec3& x : points)
    off = std::max(off, std::abs(std::hypot(x.x() - c[0], x.z() - c[1]) / r - 1.0));
  return {r, off};
}

TEST(Pressure, StripBetweenTwoEdgesIsAnArcWithItsTension) {
  for (const bool yarns : {false, true})
    for (const PlyFace side : {PlyFace::below, PlyFace::above}) {
      const double p = yarns ? 0.02 : 0.05;
      const Case data = inflated_strip(yarns, p, side);
      const RunResult run = run_case(data, 1, {});
      expect_rest(run);
      const double up = side == PlyFace::below ? 1.0 : -1.0;
      double low = 0.0, high = 0.0;
      for (const Vec3& x : run.last.plies[0].x)
        low = std::min(low, up * x.z()), high = std::max(high, up * x.z());
      EXPECT_GT(low, -1e-9);
      const auto [r, off] = circle_through(run.last.plies[0].x);
      EXPECT_LT(off, 0.002);
      const BoundaryFrame& right = run.last.boundaries[1];
      const double tension = right.force.norm() / 20.0; // N/mm
      const Fabric& f = data.fabrics[0];
      const double angle = half_angle(p, [&](double l) {
        if (yarns)
          return f.families[0].density * f.families[0].tension.stiffness / 100.0 * (l - 1.0);
        return l * stretch_stiffness / (1.0 - nu * nu) * 0.5 * (l * l - 1.0);
      });
      const double theory = 50.0 / std::sin(angle);
      fmt::print("{} {}: r {:.2f} mm ({:.4f} of theory), T {:.4f} N/mm, T / (p r) {:.4f}, half "
                 "angle {:.3f}\n",
                 yarns ? "yarns" : "sheet", up, r, r / theory, tension, tension / (p * r), angle);
      EXPECT_NEAR(tension, p * r, 0.02 * p * r);
      EXPECT_NEAR(r, theory, 0.02 * theory);
      EXPECT_NEAR(high, theory * (1.0 - std::cos(angle)), 0.02 * high);
    }
}

// ---- a strip over a groove ----
//
// Half of it: `half_strip` from the middle to the held end, flat land from there to the fillet,
// which the mid-surface follows with the radius rf about (c, -rf) by the angle a, then an arc of
// radius r across the groove: (r + rf) sin a = c. Without friction T is the same all along, and
//   stretch = ((r + rf) a + half_strip - c) / half_strip,   T(stretch) = p r                  (G)

constexpr double half_strip = 80.0, half_groove = 30.0, groove_fillet = 5.0; // mm

Case strip_over_groove(double pressure, double friction, double size) {
  Case data = stack_of({0.0}, rectangle(2.0 * half_strip, 4.0 * size, size));
  data.fabrics = {film()};
  data.plies[0].z = 0.25;
  Tool land;
  land.name = "land";
  land.shape = ExtrudedProfile{round_corners({{-200, 0, 0},
                                              {-half_groove, 0, groove_fillet},
                                              {-half_groove, -100, groove_fillet},
                                              {half_groove, -100, groove_fillet},
                                              {half_groove, 0, groove_fillet},
                                              {200, 0, 0}},
                                             false, {"", "", ""}),
                               100.0};
  data.tools = {land};
  const double side = 2.0 * size;
  data.boundaries = {hold("left", {-80, -side}, {-80, side}, Vec3::UnitX(), 0.0),
                     hold("right", {80, -side}, {80, side}, Vec3::UnitX(), 0.0)};
  hold_all(data, {false, true, false});
  inflate(data, pressure, 0.05, 1000.0);
  data.loads[0].side = PlyFace::above;
  data.solver.dwell = 1.0;
  set_friction(data, friction);
  return data;
}

double tension_of_strip(double stretch) {
  return stretch * stretch_stiffness / (1.0 - nu * nu) * 0.5 * (stretch * stretch - 1.0);
}

/// r of (G), mm.
double radius_over_groove(double p) {
  const double c = half_groove + groove_fillet, rf = groove_fillet + 0.25;
  const double angle = root(1e-3, 1.5, [&](double a) {
    return tension_of_strip((c / std::sin(a) * a + half_strip - c) / half_strip) -
           p * (c / std::sin(a) - rf);
  });
  return c / std::sin(angle) - rf;
}

TEST(Pressure, StripOverAGrooveHasTheRadiusOfTensionOverPressure) {
  for (const double friction : {0.0, 0.2}) {
    double before = 1e9;
    for (const double p : {0.04, 0.1}) {
      const RunResult run = run_case(strip_over_groove(p, friction, 2.5), 1, {});
      expect_rest(run);
      const PlyFrame& ply = run.last.plies[0];
      std::vector<Vec3> across;
      for (std::size_t n = 0; n < ply.x.size(); ++n)
        if (std::abs(ply.x[n].x()) < half_groove - 2.5) across.push_back(ply.x[n]);
      const auto [r, off] = circle_through(across);
      double stretch = 0.0;
      int count = 0;
      for (std::size_t t = 0; t < ply.triangles.size(); ++t)
        if (std::abs(ply.x0[at(ply.triangles[t][0])].x()) < 20.0)
          stretch += 1.0 + ply.families[0].strain[t], ++count;
      const double tension = tension_of_strip(stretch / count), theory = radius_over_groove(p),
                   end = run.last.boundaries[1].force.norm() / 10.0;
      fmt::print("friction {}, {} N/mm2: r {:.2f} mm ({:.4f} of T / p, {:.4f} of theory without "
                 "friction), T {:.3f} N/mm, {:.4f} of it at the end, balance {:.1e}\n",
                 friction, p, r, r * p / tension, r / theory, tension, end / tension,
                 run.last.energy.balance_error());
      EXPECT_LT(off, 0.005);
      EXPECT_NEAR(r, tension / p, 0.02 * r);
      EXPECT_LT(std::abs(run.last.energy.balance_error()), 0.005);
      if (friction == 0.0) {
        EXPECT_NEAR(r, theory, 0.02 * theory);
        EXPECT_NEAR(end, tension, 0.02 * tension);
      } else {
        EXPECT_LT(end, 0.9 * tension); // the land holds some of it
      }
      EXPECT_LT(r, before); // more pressure, a smaller radius
      before = r;
    }
  }
}

} // namespace
} // namespace plyform::pressed_strips_test
