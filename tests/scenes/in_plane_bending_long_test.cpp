// SPDX-License-Identifier: GPL-3.0-or-later
// Whole runs of strips whose yarns bend in their plane, against closed forms: the boundary layer of
// shear at a clamp, and the loads under which a strip pressed along its yarns gives way sideways
// and, as Euler's strut, out of its plane.
#include "support/static_bias.hpp"
#include "support/strip_scenes.hpp"

#include <cmath>

namespace plyform::in_plane_bending_long_test {
namespace {

constexpr double shear_stiffness = 0.25 * 0.25 * 0.37044; // N/mm, n_c Cs'(0) of glass_weave()

TEST(InPlaneBendingLong, ShearComesUpFromAClampOverTheWidthOfItsLayer) {
  for (const double in_plane : {2.0, 8.0}) { // N mm
    const Strip strip{100.0, 12.0, 2.0, in_plane, 0.0, 46.0};
    const double layer = std::sqrt(in_plane / shear_stiffness); // mm: 9.3 and 18.6
    const double half = 0.5 * (strip.free_length + strip.size); // mm
    const double gamma = 1e-3; // rad, far from the clamps; yarns stretch by gamma^2/2
    Case data = strip_case(strip);
    Grip& right = data.boundaries[1].as<Grip>();
    right.direction = Vec3::UnitY();
    right.stroke = 2.0 * gamma * (half - layer * std::tanh(half / layer));
    hold_all(data, {true, false, true}); // else the wefts turn, as sections of a beam do
    data.solver.mass_damping = 400.0;    // 1/s: critical for the strip's first sway
    data.solver.duration = 0.2;          // s
    const RunResult run = run_case(data, 1, {});
    ASSERT_EQ(run.summary.status, "done") << run.summary.message;
    const PlyFrame& ply = run.last.plies[0];
    double largest = 0.0;
    for (std::size_t e = 0; e < ply.triangles.size(); ++e) {
      double low = 1e9, high = -1e9;
      for (const int n : ply.triangles[e]) {
        low = std::min(low, ply.x0[n].x());
        high = std::max(high, ply.x0[n].x());
      }
      const double x = 0.5 * (low + high); // constant over a column of squares
      if (std::abs(x) > 0.5 * strip.free_length) continue;
      const double theory = gamma * (1.0 - std::cosh(x / layer) / std::cosh(half / layer));
      const double found = std::abs(ply.shear_deg[e]) * degree;
      largest = std::max(largest, std::abs(found - theory));
    }
    // 2 %: (h/l)^2/24 = 0.2 % of the mesh, inertia
    EXPECT_LE(largest, 0.02 * gamma);
    const double load = right_load(run) / (strip.width * shear_stiffness * gamma);
    EXPECT_NEAR(load, 1.0, 0.02);
    fmt::print("layer of {:.1f} mm: shear within {:.2f} %, load {:.4f} of theory, {} steps\n",
               layer, 100.0 * largest / gamma, load, run.summary.steps);
  }
}

/// N/mm, what a strip bears that is started as a cosine of 0.01 mm along `sideways` and pressed
/// along its yarns by 0.4 % more than `theory` (N/mm) takes. Held flat unless sideways is z.
double buckling_load(const Strip& strip, const Vec3& sideways, double theory) {
  Case data = strip_case(strip);
  const double yarns = 0.25 * strip.yarn; // N/mm
  data.boundaries[1].as<Grip>().stroke = -(theory / yarns + 0.004) * strip.free_length;
  if (sideways.z() == 0.0) hold_all(data, {false, false, true});
  data.solver.mass_damping = 400.0;     // 1/s
  data.solver.duration = 0.3;           // s
  data.solver.max_balance_error = 10.0; // while the cosine's energy is all there is
  Scene scene = make_scene(data);
  const double length = strip.free_length + strip.size;
  for (Vec3& x : scene.plies[0].x)
    if (std::abs(x.x()) < 0.5 * strip.free_length)
      x += 0.005 * (1.0 + std::cos(2.0 * std::numbers::pi * x.x() / length)) * sideways;
  const RunResult run = run_scene(scene, 1, {});
  EXPECT_EQ(run.summary.status, "done") << run.summary.message;
  double way = 0.0;
  for (std::size_t n = 0; n < run.last.plies[0].x.size(); ++n)
    way = std::max(way, std::abs((run.last.plies[0].x[n] - run.last.plies[0].x0[n]).dot(sideways)));
  fmt::print("gave way by {:.2f} mm, {} steps, balance {:.1e}\n", way, run.summary.steps,
             run.last.energy.balance_error());
  EXPECT_GE(way, 0.01 * strip.free_length);
  return -right_load(run) / strip.width;
}

TEST(InPlaneBendingLong, PressedStripHeldFlatGivesWaySidewaysUnderItsLoad) {
  for (const double in_plane : {2.0, 8.0}) { // N mm
    const Strip strip{57.0, 12.0, 3.0, in_plane, 0.0, 150.0};
    const double length = strip.free_length + strip.size; // mm, of the one wave
    const double theory =
        shear_stiffness + 4.0 * std::pow(std::numbers::pi / length, 2) * in_plane; // N/mm
    // 2 %: 1.5 % of the part of shear by the third power of its law at slopes of 0.13; the mesh,
    // (2 pi h/L)^2/12 = 0.8 %; the cosine, 0.4 %
    const double load = buckling_load(strip, Vec3::UnitY(), theory);
    EXPECT_NEAR(load, theory, 0.02 * theory);
    fmt::print("sideways: {:.4f} N/mm, {:.3f} of theory\n", load, load / theory);
  }
}

TEST(InPlaneBendingLong, FreeStripBucklesAsEulersStrut) {
  for (const double bending : {1.0, 2.0}) { // N mm; 8 N mm in the plane, where it stays straight
    // wide: the rows of nodes on free rims are softer than the inner ones (0.96 at a width of 12
    // mm)
    const Strip strip{57.0, 36.0, 3.0, 8.0, bending, 150.0};
    const double length = strip.free_length + strip.size;
    const double theory = 4.0 * std::pow(std::numbers::pi / length, 2) * bending; // N/mm
    // 2 %: the mesh 0.8 % and the cosine 0.4 %, both as above
    const double load = buckling_load(strip, Vec3::UnitZ(), theory);
    EXPECT_NEAR(load, theory, 0.02 * theory);
    fmt::print("out of its plane: {:.4f} N/mm, {:.3f} of theory\n", load, load / theory);
  }
}

/// Load over (40) of a strip of 300 x 100 mm at rest with D_g of both families, at 10 and 30
/// degrees.
std::vector<double> bias_shares(double in_plane, double size) {
  constexpr double length = 300.0, width = 100.0; // mm
  const std::vector<double> angles{10.0 * degree, 30.0 * degree};
  Fabric fabric = glass_weave();
  for (YarnFamily& family : fabric.families)
    family.in_plane_bending = in_plane;
  std::vector<double> shares =
      bias_loads(strip_mesh({MeshKind::crossed, size, 0.0, 0.0}, length, width), fabric, length,
                 width, ElementKind::plain, angles, 1e-9);
  const ShearTest test = shear_test(BiasSpecimen{length, width});
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const double drawn = std::numbers::sqrt2 * std::cos(0.25 * std::numbers::pi - 0.5 * angles[i]);
    shares[i] /= test_load(test, fabric, (length - width) * (drawn - 1.0));
  }
  fmt::print("D_g {} N mm: {:.3f} and {:.3f} of (40) at 10 and 30 degrees\n", in_plane, shares[0],
             shares[1]);
  return shares;
}

TEST(InPlaneBendingLong, LayersBetweenItsZonesAddToTheLoadOfTheBiasTest) {
  const double size = 12.5; // mm, as in the shipped case
  const std::vector<double> none = bias_shares(0.0, size), soft = bias_shares(2.0, size),
                            stiff = bias_shares(8.0, size);
  // found: 0.99; 1.05 and 1.03; 1.14 and 1.12, the same as in runs of the shipped case to 0.003.
  // With squares of 6.25 mm 1.06 and 1.05; 1.16 and 1.15: layers of 9 mm want finer ones yet.
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(none[i], 0.99, 0.01);
    EXPECT_NEAR(soft[i], 1.04, 0.02);
    EXPECT_NEAR(stiff[i], 1.13, 0.02);
  }
  // what identify takes off, between half and all of the layers of a net of inextensible yarns
  Fabric fabric = glass_weave();
  for (YarnFamily& family : fabric.families)
    family.in_plane_bending = 8.0;
  const BendingShare share = in_plane_bending_share(shear_test(BiasSpecimen{300.0, 100.0}), fabric);
  const std::vector<double> fine = bias_shares(8.0, 0.5 * size);
  for (std::size_t i = 0; i < 2; ++i) { // over the load at the same angle without layers
    const double found = fine[i] / none[i];
    EXPECT_GT(found, 1.0 + share.least);
    EXPECT_LT(found, 1.0 + share.most);
    EXPECT_NEAR(found, 1.0 + share.mean(), 0.04); // the law is as wrong: 0.16 without
  }
}

} // namespace
} // namespace plyform::in_plane_bending_long_test
