// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of tools that are meshes: their own mirror images within their deflection, and overlaps of
// whole faces.
#include "contact/shapes/tool_shape.hpp"
#include "core/input/checks/tool_overlap.hpp"
#include "support/case_files.hpp"

#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>

namespace plyform::mesh_tools_test {
namespace {

/// The turned mesh of a sphere: no plane through its middle is one of symmetry of its nodes.
fs::path ball_file() {
  const fs::path file = fs::path(testing::TempDir()) / "plyform_ball.off";
  const TriMesh ball = tessellate(Sphere{60.0}, 5.0, 0.0);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
  std::ofstream out(file);
  out << "OFF\n" << ball.x.size() << " " << ball.triangles.size() << " 0\n";
  for (const Vec3& x : ball.x) {
    const Vec3 p = turn * x;
    out << fmt::format("{:.9g} {:.9g} {:.9g}\n", p.x(), p.y(), p.z());
  }
  for (const auto& [a, b, c] : ball.triangles)
    out << fmt::format("3 {} {} {}\n", a, b, c);
  return file;
}

TEST(MeshTools, AreTheirOwnImagesWithinTheirDeflection) {
  const std::string file = ball_file().string();
  const auto quarter = [&](double x) {
    return prepare_case(data_folder / "several/quarter.toml",
                        {{"tool.0.file", fmt::format("\"{}\"", file)},
                         {"tool.0.position", fmt::format("[{}, 0.0, 60.6]", x)}});
  };
  const PreparedCase fits = quarter(0.0);
  EXPECT_TRUE(fits.value) << all_texts(fits);
  const PreparedCase beside = quarter(0.3); // five times the deflection of its facets
  ASSERT_EQ(beside.errors.size(), 1u);
  EXPECT_NE(beside.errors[0].text().find("is no plane of symmetry of tool punch"),
            std::string::npos);
}

struct Placed {
  Tool tool;
  TriMesh surface;
};

Placed placed(const ToolShape& shape, const Vec3& position) {
  Placed made;
  made.tool.shape = shape;
  made.tool.position = position;
  made.surface = tool_surface(made.tool, 17.0, 100.0);
  return made;
}

double overlap(const Placed& a, const Placed& b) {
  const Eigen::AlignedBox2d area(Vec2(-100, -100), Vec2(100, 100));
  return -deepest_overlap({a.tool, a.surface}, {b.tool, b.surface}, area, 0.01).gap;
}

/// The mesh of a box with two triangles a face.
ToolShape box_mesh(const Vec3& size) {
  return make_mesh_shape(tessellate(Box{size}, 1e6, 0.0), nullptr);
}

TEST(ToolOverlap, IsOfWholeFaces) {
  for (const double wide : {10.0, 1.0, 0.2}) { // bars that cross without a corner in each other
    const Placed along = placed(box_mesh(Vec3(150, wide, wide)), Vec3::Zero()),
                 across = placed(box_mesh(Vec3(wide, 150, wide)), Vec3::Zero());
    EXPECT_NEAR(overlap(along, across), 0.5 * wide, 0.05 * wide) << wide;
    const Placed above = placed(box_mesh(Vec3(wide, 150, wide)), Vec3(0.0, 0.0, 1.01 * wide));
    EXPECT_LT(overlap(along, above), 0.0);
  }
}

TEST(ToolOverlap, IsOfSolidsWhoseSurfacesCoincide) {
  const Placed box = placed(box_mesh(Vec3(60, 60, 60)), Vec3::Zero()),
               next = placed(box_mesh(Vec3(60, 60, 60)), Vec3(0, 0, 50)),
               touching = placed(box_mesh(Vec3(60, 60, 60)), Vec3(0, 0, 60));
  EXPECT_NEAR(overlap(box, next), 10.0, 0.1);
  EXPECT_LT(overlap(box, touching), 0.0);
  EXPECT_GT(overlap(box, box), 10.0);
  const Placed ball = placed(Sphere{60.0}, Vec3::Zero());
  const Placed mesh =
      placed(make_mesh_shape(tessellate(Sphere{60.0}, 5.0, 0.0), nullptr), Vec3::Zero());
  EXPECT_GT(overlap(ball, ball), 10.0);
  EXPECT_GT(overlap(mesh, mesh), 10.0);
}

} // namespace
} // namespace plyform::mesh_tools_test
