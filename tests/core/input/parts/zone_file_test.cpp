// SPDX-License-Identifier: GPL-3.0-or-later
// Zones of blanks in case files; wrong ones are in tests/data/broken.
#include "core/mesh/mesh_ply.hpp"
#include "support/case_files.hpp"

#include <gtest/gtest.h>

namespace plyform::zone_file_test {
namespace {

TEST(ZoneFile, ReadsRingsPolygonsAndToolsAsSeenFromTheBlank) {
  const Case c = good_case(data_folder / "good/zones.toml");
  ASSERT_EQ(c.blanks.size(), 1u);
  const std::vector<MeshZone>& zones = c.blanks[0].zones;
  ASSERT_EQ(zones.size(), 3u);
  EXPECT_EQ(zones[0].kind, ZoneKind::circle);
  EXPECT_EQ(zones[0].element_size, 1.5);
  EXPECT_EQ(zones[0].centre, Vec2(-18, 20)); // seen from the blank's centre, as holes are
  EXPECT_EQ(zones[0].radius, 12.0);
  EXPECT_EQ(zones[0].inner_radius, 6.0);
  EXPECT_EQ(zones[1].kind, ZoneKind::polygon);
  ASSERT_EQ(zones[1].outline.size(), 3u);
  EXPECT_EQ(zones[1].outline[0], Vec2(21, 20));
  EXPECT_EQ(zones[2].kind, ZoneKind::tool);
  EXPECT_EQ(zones[2].tool, 1);
  ASSERT_FALSE(zones[2].places.empty());
  EXPECT_EQ(zones[2].places[0].reach, 3.0);
}

/// Size of a square of two triangles as large as those with a corner within 2 mm of p, the largest.
double size_near(const BlankMesh& mesh, const Vec2& p) {
  double largest = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Vec2 &a = mesh.x[at(t[0])], &b = mesh.x[at(t[1])], &c = mesh.x[at(t[2])];
    if (std::min({(a - p).norm(), (b - p).norm(), (c - p).norm()}) > 2.0) continue;
    const Vec2 u = b - a, v = c - a;
    largest = std::max(largest, std::sqrt(u.x() * v.y() - u.y() * v.x()));
  }
  return largest;
}

/// Rings turn with the blank, what lies along a tool does not.
TEST(ZoneFile, MeshesOfPliesHaveTheElementsOfTheirZones) {
  const Case c = good_case(data_folder / "good/zones.toml");
  const BlankMesh mesh = mesh_ply(c, c.plies[0]);
  const Eigen::Rotation2Dd turn(c.plies[0].rotation);
  const double over = std::pow(2.0, 0.25) * (1.0 + 1e-5);
  for (int k = 0; k < 8; ++k) {
    const Eigen::Rotation2Dd around(0.25 * k * std::numbers::pi);
    const double ring = size_near(mesh, turn * (Vec2(-18, 20) + around * Vec2(9, 0)));
    EXPECT_GT(ring, 0.0);
    EXPECT_LE(ring, over * 1.5);
    const double fillet = size_near(mesh, around * Vec2(15, 0));
    EXPECT_GT(fillet, 0.0);
    EXPECT_LE(fillet, over * 2.0);
  }
  EXPECT_LT(mesh.triangles.size(), 4000u);
}

/// The size of a run is told with its zones, and too many triangles are refused before meshing.
TEST(ZoneFile, ZonesCountForTheSizeOfARun) {
  const PreparedCase large = prepare_case(data_folder / "good/zones.toml",
                                          {{"blanks.square.zone.0.element_size", "0.002"}});
  EXPECT_FALSE(large.value);
  EXPECT_NE(all_texts(large).find("triangles"), std::string::npos) << all_texts(large);
}

} // namespace
} // namespace plyform::zone_file_test
