// SPDX-License-Identifier: GPL-3.0-or-later
// Tools of a case file: places, motions, shapes and mesh files.
#include "core/setup/prepare_case.hpp"
#include "support/case_files.hpp"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <numbers>

namespace plyform::tool_file_test {
namespace {

constexpr double pi = std::numbers::pi;

TEST(ToolFile, ReadsPlacesAndMotionsOfTools) {
  const Case c = good_case(data_folder / "good/every_shape.toml");
  ASSERT_EQ(c.tools.size(), 8u);
  const Tool &ball = c.tools[0], &roll = c.tools[1], &block = c.tools[2], &coin = c.tools[4];
  EXPECT_EQ(ball.motion, Motion::driven);
  EXPECT_DOUBLE_EQ(ball.stroke, 2.0);
  EXPECT_EQ(ball.direction, Vec3(0, 0, -1)); // given as (0, 0, -2)
  EXPECT_EQ(ball.position, Vec3(0, 0, 10));
  EXPECT_TRUE(ball.rotation.isIdentity(0.0));
  EXPECT_EQ(c.tools[3].motion, Motion::fixed);
  EXPECT_EQ(coin.motion, Motion::force);
  EXPECT_DOUBLE_EQ(coin.force, 300.0);
  EXPECT_DOUBLE_EQ(coin.mass, 2.5e-3); // t
  EXPECT_EQ(c.tools[5].mass, 0.0);     // the default
  // Rotations are products of sines and cosines: some rounding.
  EXPECT_TRUE((roll.rotation * Vec3::UnitZ()).isApprox(Vec3::UnitY(), 1e-14));
  EXPECT_TRUE((roll.rotation * Vec3::UnitX()).isApprox(Vec3::UnitX(), 1e-14)); // shortest way
  EXPECT_TRUE((block.rotation * Vec3::UnitX()).isApprox(Vec3::UnitY(), 1e-14));
  EXPECT_TRUE((coin.rotation * Vec3::UnitZ()).isApprox(-Vec3::UnitZ(), 1e-14));
  for (const Tool& tool : c.tools)
    EXPECT_NEAR(tool.rotation.determinant(), 1.0, 1e-14);
}

TEST(ToolFile, ReadsShapesOfTools) {
  const Case c = good_case(data_folder / "good/every_shape.toml");
  ASSERT_EQ(c.tools.size(), 8u);
  EXPECT_DOUBLE_EQ(std::get<Sphere>(c.tools[0].shape).radius, 5.0);
  EXPECT_DOUBLE_EQ(std::get<Cylinder>(c.tools[1].shape).length, 40.0);
  EXPECT_DOUBLE_EQ(std::get<Cylinder>(c.tools[1].shape).edge_radius, 2.0);
  EXPECT_EQ(std::get<Box>(c.tools[2].shape).size, Vec3(4, 5, 6));
  EXPECT_DOUBLE_EQ(std::get<Box>(c.tools[2].shape).edge_radius, 1.5);
  EXPECT_TRUE(std::holds_alternative<Plane>(c.tools[3].shape));
  const Annulus disc = std::get<Annulus>(c.tools[4].shape),
                ring = std::get<Annulus>(c.tools[5].shape);
  EXPECT_DOUBLE_EQ(disc.inner_radius, 0.0);
  EXPECT_DOUBLE_EQ(disc.edge_radius, 0.0);
  EXPECT_DOUBLE_EQ(ring.inner_radius, 12.0);
  EXPECT_DOUBLE_EQ(ring.edge_radius, 1.0);
  const auto distance = [&](std::size_t tool, const Vec3& p) {
    SurfaceHint hint;
    return signed_distance(c.tools[tool].shape, p, hint).distance;
  };
  // Middles of the arc and of the fillet, 2 mm about (14, -2) and (28, -2), and 1 mm above each.
  const double near = 2.0 / std::numbers::sqrt2, far = 3.0 / std::numbers::sqrt2;
  EXPECT_NEAR(distance(6, {14 - near, 0, -2 + near}), 0.0, 1e-12);
  EXPECT_NEAR(distance(6, {14 - far, 0, -2 + far}), 1.0, 1e-12);
  EXPECT_NEAR(distance(6, {28 + near, 0, -2 + near}), 0.0, 1e-12);
  EXPECT_NEAR(distance(6, {28 + far, 0, -2 + far}), 1.0, 1e-12);
  // The tetrahedron, its face at z = 1 scaled to 3 mm.
  EXPECT_NEAR(distance(7, {0.1, 0, 5}), 2.0, 1e-12);
}

TEST(ToolFile, LoadsEachMeshOfToolsOnceAndNamesThoseThatItCannot) {
  const fs::path file = data_folder / "several/mesh_tools.toml";
  const PreparedCase reading = prepare_case(file, {});
  ASSERT_EQ(reading.errors.size(), 2u) << all_texts(reading);
  EXPECT_EQ(reading.errors[0].item, "tool.1.file");
  EXPECT_NE(reading.errors[0].text().find("there is no such file"), std::string::npos);
  EXPECT_EQ(reading.errors[1].item, "tool.3.file");
  EXPECT_NE(reading.errors[1].text().find("no faces"), std::string::npos);

  const std::string sound =
      fmt::format("\"{}\"", (data_folder / "meshes/tetrahedron.off").string());
  const PreparedCase mended = prepare_case(file, {{"tool.1.file", sound}, {"tool.3.file", sound}});
  ASSERT_TRUE(mended.value) << all_texts(mended);
  const auto mesh = [&](std::size_t i) {
    return std::get<MeshShapePtr>(mended.value->tools[i].shape);
  };
  EXPECT_EQ(mesh(0), mesh(2));
  EXPECT_EQ(mesh(1), mesh(3));
  EXPECT_NE(mesh(0), mesh(1)); // another scale
}

TEST(ToolFile, ReadsConesToriAndExtrusions) {
  const Case c = good_case(data_folder / "good/profile_shapes.toml");
  ASSERT_EQ(c.tools.size(), 4u);
  const auto distance = [&](std::size_t tool, const Vec3& p) {
    SurfaceHint hint;
    return signed_distance(c.tools[tool].shape, p, hint).distance;
  };
  EXPECT_NEAR(distance(0, {0, 0, 3}), 1.0, 1e-12);   // above the top
  EXPECT_NEAR(distance(0, {3.5, 0, 0}), 0.0, 1e-12); // middle of the flank
  EXPECT_NEAR(smallest_radius(c.tools[0].shape), 0.5, 1e-12);
  EXPECT_NEAR(distance(1, {0, 0, 2}), 0.0, 1e-12); // the tip
  EXPECT_NEAR(distance(2, {0, 12, 4}), 1.0, 1e-12);
  EXPECT_NEAR(distance(3, {0, 0, -15}), 3.0, 1e-12); // the trough is round, 10 mm about (0, -8)
  EXPECT_NEAR(distance(3, {20, 24, 2}), 2.0, 1e-12);
  EXPECT_NEAR(distance(3, {20, 26, -3}), 1.0, 1e-12); // beyond an end
}

} // namespace
} // namespace plyform::tool_file_test
