// SPDX-License-Identifier: GPL-3.0-or-later
// The tightest radius of a mesh is that of the surface that it stands for.
#include "contact/shapes/mesh_curvature.hpp"
#include "contact/shapes/tool_shape.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace plyform::mesh_curvature_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The mesh of a shape as a binary STL file has it: turned, and rounded to single precision.
ToolShape meshed(const ToolShape& shape, double size) {
  TriMesh surface = tessellate(shape, size, 100.0);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
  for (Vec3& x : surface.x)
    x = (turn * x).cast<float>().cast<double>();
  return make_mesh_shape(surface, nullptr);
}

/// A height over a grid of 60 x 60 mm, every other column shifted, normals up.
template <class Height>
TriMesh over_grid(int cells, const Height& height) {
  TriMesh surface;
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) {
      const double x = 60.0 * i / cells - 30.0,
                   y = 60.0 * (j + (i % 2 && j > 0 && j < cells ? 0.3 : 0.0)) / cells - 30.0;
      surface.x.emplace_back(x, y, height(x, y));
    }
  const auto at = [&](int i, int j) { return j * (cells + 1) + i; };
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      surface.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      surface.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return surface;
}

TEST(MeshCurvature, OfASphereIsItsRadiusHoweverCoarse) {
  for (const double size : {3.0, 10.0, 23.0}) { // the last: 8 rings, turns of 22.5 degrees
    EXPECT_NEAR(smallest_radius(meshed(Sphere{60.0}, size)), 60.0, 0.6) << size;
    EXPECT_NEAR(radius_near(meshed(Sphere{60.0}, size), {10.0, 50.0, 30.0}), 60.0, 0.6) << size;
  }
}

TEST(MeshCurvature, OfFilletsIsTheirRadius) {
  // within the 5 % that the ends of fillets of few facets need
  for (const double size : {3.0, 6.0, 12.0}) {
    EXPECT_NEAR(smallest_radius(meshed(Cylinder{60.0, 80.0, 20.0}, size)), 20.0, 1.0) << size;
    EXPECT_NEAR(smallest_radius(meshed(Box{Vec3(100, 80, 60), 20.0}, size)), 20.0, 1.0) << size;
    EXPECT_NEAR(smallest_radius(meshed(make_torus(40.0, 12.0), size)), 12.0, 0.6) << size;
  }
}

TEST(MeshCurvature, OfSharpEdgesIsNone) {
  EXPECT_EQ(smallest_radius(meshed(Box{Vec3(100, 80, 60)}, 10.0)), 0.0);
  EXPECT_EQ(smallest_rounding(meshed(Box{Vec3(100, 80, 60)}, 10.0)), infinity);
  const ToolShape rod = meshed(Cylinder{60.0, 80.0}, 5.0); // flat ends: only its wall is round
  EXPECT_EQ(smallest_radius(rod), 0.0);
  EXPECT_NEAR(smallest_rounding(rod), 60.0, 1.0);
}

TEST(MeshCurvature, OfFlatAndHollowMeshesIsInfinite) {
  EXPECT_EQ(
      smallest_radius(make_mesh_shape(over_grid(13, [](double, double) { return 1.0; }), nullptr)),
      infinity);
  const auto bowl = [](double x, double y) { return 80.0 - std::sqrt(6400.0 - x * x - y * y); };
  EXPECT_GT(smallest_radius(make_mesh_shape(over_grid(20, bowl), nullptr)), 1e4);
}

TEST(MeshCurvature, OfASaddleIsThatOfItsConvexWay) {
  const auto saddle = [](double x, double y) { return -x * x / 80.0 + y * y / 40.0; }; // 40 and 20
  // (3) is exact on spheres; here the nodes lie askew, and neighbours above and below differ
  EXPECT_NEAR(smallest_radius(make_mesh_shape(over_grid(30, saddle), nullptr)), 40.0, 8.0);
}

TEST(MeshCurvature, GivesTheDeflectionOfFacets) {
  // an equilateral facet with sides e on a sphere is e^2 / (6 R) below it; others differ somewhat
  const TriMesh surface = tessellate(Sphere{60.0}, 6.0, 0.0);
  const MeshCurvature curvature = mesh_curvature(surface);
  for (std::size_t f = 0; f < surface.triangles.size(); ++f) {
    const auto& [a, b, c] = surface.triangles[f];
    const double below = 60.0 - (surface.x[a] + surface.x[b] + surface.x[c]).norm() / 3.0;
    EXPECT_GE(1.5 * curvature.deflection[f], below);
    EXPECT_LE(curvature.deflection[f], 4.0 * below + 0.02);
  }
}

TEST(DividesSides, WithoutMovingTheSurface) {
  TriMesh surface = tessellate(Box{Vec3(100, 80, 60)}, 1000.0, 0.0);
  divide_sides(surface, 7.0);
  double area = 0.0;
  for (const auto& [a, b, c] : surface.triangles) {
    const Vec3 u = surface.x[b] - surface.x[a], v = surface.x[c] - surface.x[a];
    area += 0.5 * u.cross(v).norm();
    EXPECT_LE(std::max({u.norm(), v.norm(), (u - v).norm()}), 7.0);
  }
  EXPECT_NEAR(area, 2.0 * (100 * 80 + 100 * 60 + 80 * 60), 1e-6);
}

} // namespace
} // namespace plyform::mesh_curvature_test
