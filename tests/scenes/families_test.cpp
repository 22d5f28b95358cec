// SPDX-License-Identifier: GPL-3.0-or-later
// Fabrics of one family and of three: what theory says of them in the plane, and whole scenes.
#include "core/run/output_state.hpp"
#include "core/run/run.hpp"
#include "support/kill_checks.hpp"
#include "support/membrane_checks.hpp"
#include "support/scene_checks.hpp"
#include "support/thread_checks.hpp"

#include <gtest/gtest.h>

namespace plyform::families_test {
namespace {

constexpr double width = 40.0; // mm, of the square that is strained

/// Energy per area (N/mm) of a square that is stretched by `along` in the direction at `angle`
/// (rad) and by `across` square to it.
double energy_of_strain(const Fabric& fabric, double angle, double along, double across) {
  const BlankMesh mesh = mesh_blank(rectangle(width, width, 5.0), 0.0, 0.5 * std::numbers::pi);
  const Membrane m = make_membrane(mesh, fabric, 0.0, ElementKind::averaged);
  const Vec2 e(std::cos(angle), std::sin(angle)), n(-e.y(), e.x());
  std::vector<Vec3> x;
  for (const Vec2& p : mesh.x) {
    const Vec2 q = (1.0 + along) * p.dot(e) * e + (1.0 + across) * p.dot(n) * n;
    x.emplace_back(q.x(), q.y(), 0.0);
  }
  const MembraneEnergy energy = membrane_energy(m, x);
  return (energy.fibre + energy.shear) / (width * width);
}

/// Three equal families at 60 degrees are isotropic for small strains, as any hexagonal net is:
/// E = d C per width with Poisson's ratio 1/3, so 9/16 d C eps^2 for a strain in one
/// direction, whichever it is.
TEST(Families, ThreeAtSixtyDegreesAreIsotropic) {
  Fabric f;
  for (int a = 0; a < 3; ++a) {
    YarnFamily& family = f.families.emplace_back();
    family.angle = a * std::numbers::pi / 3.0;
    family.density = 0.25;
    family.tension.stiffness = family.tension.compression = 40000.0;
  }
  f.surface_density = 6e-10, f.thickness = 0.6;
  constexpr double strain = 1e-5, per_width = 0.25 * 40000.0; // N/mm
  const double expected = 9.0 / 16.0 * per_width * strain * strain;
  for (const double angle : {0.0, 0.2, 0.7, 1.3, 2.5}) {
    EXPECT_NEAR(energy_of_strain(f, angle, strain, 0.0), expected, 1e-4 * expected) << angle;
    // at Poisson's ratio nothing is left but E eps^2 / 2
    EXPECT_NEAR(energy_of_strain(f, angle, strain, -strain / 3.0),
                0.5 * per_width * strain * strain, 1e-4 * expected);
  }
}

/// Along its one family a tape has the yarns' stiffness and the sheet's, across them the sheet's.
TEST(Families, OneHasTheSheetAlongAndAcross) {
  const Fabric f = unidirectional();
  const IsotropicLaw& sheet = std::get<IsotropicLaw>(*f.sheet);
  const double angle = f.families[0].angle, strain = 1e-5;
  const double of_sheet =
      0.5 * sheet.modulus / (1.0 - sheet.poissons_ratio * sheet.poissons_ratio) * strain * strain;
  const double of_yarns = 0.5 * 0.5 * 46000.0 * strain * strain;
  EXPECT_NEAR(energy_of_strain(f, angle, strain, 0.0), of_yarns + of_sheet, 1e-4 * of_yarns);
  EXPECT_NEAR(energy_of_strain(f, angle, 0.0, strain), of_sheet, 1e-4 * of_sheet);
}

/// Shear that is shown without a crossing: of a square angle between the fibres and the line across
/// them; of crossings behind the first columns of their own.
TEST(Families, ShowTheShearOfWhatCrosses) {
  Case data = coarse_hemisphere({0.0, 0.3});
  data.fabrics.push_back(triaxial());
  data.fabrics[0] = unidirectional();
  data.fabrics[0].families[0].angle = 0.0;
  data.plies[1].fabric = 1;
  Scene s = make_scene(data);
  for (PlyBody& ply : s.plies)
    for (Vec3& x : ply.x) // sheared by tan(gamma) = 0.2, seen from x
      x.x() += 0.2 * x.y();
  ThreadPool pool(1);
  const Frame frame = make_frame(s, tool_surfaces(s, pool), {}, pool);
  EXPECT_NEAR(frame.plies[0].shear_deg[0], std::atan(0.2) * 180.0 / std::numbers::pi, 1e-9);
  ASSERT_EQ(frame.plies[1].crossings.size(), 2u);
  EXPECT_EQ(frame.plies[1].crossings[1].suffix, "third_weft");
  EXPECT_EQ(frame.plies[1].families.size(), 3u);
  EXPECT_EQ(frame.plies[0].families.size(), 1u);
}

/// The distance of neighbouring yarns across: stretched across a tape they are that much further
/// apart, along it not at all; sheared along the yarns they slide, sheared across them they come
/// nearer by what the yarns grow longer, since the area stays. A weave has no such column.
TEST(Families, OpenAcrossByAreaOverLength) {
  Case data = coarse_hemisphere({0.0});
  data.fabrics[0] = unidirectional();
  const auto opening = [&](double angle, const Eigen::Matrix2d& f) {
    data.fabrics[0].families[0].angle = angle;
    Scene s = make_scene(data);
    for (Vec3& x : s.plies[0].x)
      x.head<2>() = Vec2(f * x.head<2>());
    ThreadPool pool(1);
    return make_frame(s, tool_surfaces(s, pool), {}, pool).plies[0].families[0].opening.at(7);
  };
  const double right = 0.5 * std::numbers::pi;
  const Eigen::Matrix2d wider = Vec2(1.0, 1.1).asDiagonal();
  EXPECT_NEAR(opening(0.0, wider), 0.1, 1e-12);
  EXPECT_NEAR(opening(right, wider), 0.0, 1e-12);
  Eigen::Matrix2d sheared;
  sheared << 1.0, 0.2, 0.0, 1.0;
  EXPECT_NEAR(opening(0.0, sheared), 0.0, 1e-12);
  EXPECT_NEAR(opening(right, sheared), 1.0 / std::sqrt(1.04) - 1.0, 1e-12);
  data.fabrics[0] = glass_weave();
  Scene s = make_scene(data);
  ThreadPool pool(1);
  const std::vector<TriMesh> surfaces = tool_surfaces(s, pool);
  EXPECT_TRUE(make_frame(s, surfaces, {}, pool).plies[0].families[0].opening.empty());
  data.fabrics[0].families[1].opening_limit = 0.05;
  Scene limited = make_scene(data);
  const PlyFrame ply = make_frame(limited, surfaces, {}, pool).plies[0];
  EXPECT_TRUE(ply.families[0].opening.empty());
  EXPECT_EQ(ply.families[1].opening.size(), ply.triangles.size());
}

/// Plies of one family and of three in one stack: energy is closed, bits are the same on any number
/// of threads, and a run that is killed ends as one that is not.
TEST(Families, FormInOneStack) {
  Case data = coarse_hemisphere({0.0, 0.25 * std::numbers::pi});
  data.fabrics = {unidirectional(), triaxial()};
  for (Fabric& fabric : data.fabrics)
    stiffen_yarns(fabric);
  data.plies[1].fabric = 1;
  data.tools[0].stroke = 25.0;
  data.solver.duration = 0.02;
  const Energies last = expect_sound_and_repeatable(data, 2);
  EXPECT_GT(last.fibre, 0.0);
  EXPECT_GT(last.bending, 0.0);
}

} // namespace
} // namespace plyform::families_test
