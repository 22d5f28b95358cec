// SPDX-License-Identifier: GPL-3.0-or-later
// One family of yarns at several angles to the mesh: no locking, and bundles gape where they must.
// The figures are in docs/verification/locking.md.
#include "core/run/run.hpp"
#include "core/setup/prepare_case.hpp"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <numbers>

namespace plyform::unidirectional_long_test {
namespace {

using Settings = std::vector<std::pair<std::string, std::string>>;

/// A round punch with a flat end in the place of the sphere.
const Settings cone{{"tool.0.shape", "\"cone\""},   {"tool.0.radius", "25.0"},
                    {"tool.0.top_radius", "75.0"},  {"tool.0.length", "90.0"},
                    {"tool.0.edge_radius", "20.0"}, {"tool.0.position", "[0.0, 0.0, 45.34]"}};

Frame formed(double angle, Settings settings) {
  settings.emplace_back("ply.0.angle", fmt::format("{}", angle));
  settings.emplace_back("symmetry", "\"none\""); // at any angle alike
  const PreparedCase reading =
      prepare_case(std::string(PLYFORM_CASES) + "/hemisphere_ud/case.toml", settings);
  for (const CaseError& error : reading.errors)
    ADD_FAILURE() << error.text();
  if (!reading.value) return {};
  const RunResult run = run_case(*reading.value, 2, {});
  EXPECT_TRUE(ended(run.summary.status)) << run.summary.message;
  EXPECT_LT(std::abs(run.last.energy.balance_error()), 0.01);
  return run.last;
}

/// A part of the unformed disc: radii (mm), and angles to the fibres (degrees, up to 90).
struct Zone {
  double inner, outer, from, to;
};
constexpr Zone middle{0.0, 40.0, 0.0, 90.0}, beside{40.0, 90.0, 60.0, 90.0},
    ahead{40.0, 90.0, 0.0, 30.0}, rim_ahead{120.0, 160.0, 0.0, 20.0};

/// Mean of the opening by area before forming, %.
double mean_opening(const PlyFrame& ply, const Zone& zone) {
  const std::vector<double> areas = areas_before(ply);
  double sum = 0.0, area = 0.0;
  for (std::size_t t = 0; t < ply.triangles.size(); ++t) {
    Vec3 c = Vec3::Zero();
    for (const int n : ply.triangles[t])
      c += ply.x0[n] / 3.0;
    const double to_x = std::atan2(c.y(), c.x()) / degree - ply.families[0].angle_deg;
    const double angle = std::abs(std::remainder(to_x, 180.0)), radius = c.head<2>().norm();
    if (radius < zone.inner || radius > zone.outer || angle < zone.from || angle > zone.to)
      continue;
    sum += areas[t] * ply.families[0].opening[t];
    area += areas[t];
  }
  return 100.0 * sum / area;
}

/// A turn of the fibres in a round blank changes nothing but how they lie to the mesh: the load,
/// and where bundles gape, are those of a mesh along them with elements two thirds as large.
void judge(const Settings& settings) {
  Settings fine = settings;
  fine.emplace_back("blanks.disc.mesh", "\"fibres\"");
  fine.emplace_back("blanks.disc.element_size", "5.333");
  const Frame converged = formed(30.0, fine);
  for (const double angle : {0.0, 15.0, 30.0, 45.0}) {
    const Frame last = formed(angle, settings);
    ASSERT_TRUE(!last.plies.empty() && !converged.plies.empty());
    const double load = last.tools[0].force_N / converged.tools[0].force_N;
    fmt::print("{:g} degrees: load {:.3f}, opening %", angle, load);
    EXPECT_NEAR(load, 1.0, 0.05) << angle;
    for (const Zone& zone : {middle, beside, ahead, rim_ahead}) {
      const double found = mean_opening(last.plies[0], zone),
                   wanted = mean_opening(converged.plies[0], zone);
      fmt::print(" {:.1f} ({:.1f})", found, wanted);
      EXPECT_NEAR(found, wanted, 0.5) << angle << " degrees, from " << zone.inner << " mm on";
    }
    fmt::print("\n");
    // a band across the fibres gapes; where fibres are drawn in they come closer
    EXPECT_GT(mean_opening(last.plies[0], beside), 1.5 * mean_opening(last.plies[0], ahead));
    EXPECT_LT(mean_opening(last.plies[0], rim_ahead), -1.0);
  }
}

TEST(UnidirectionalLong, HemisphereAtAnyAngleToTheMesh) {
  judge({});
}

TEST(UnidirectionalLong, ConeAtAnyAngleToTheMesh) {
  judge(cone);
}

} // namespace
} // namespace plyform::unidirectional_long_test
