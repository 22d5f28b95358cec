// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles of tools: on the surface, closed and outward by CGAL's judgement, of the asked size.
#include "support/shape_checks.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace plyform::tessellate_test {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
constexpr double pi = std::numbers::pi;

Mesh to_cgal(const TriMesh& s) {
  std::vector<Kernel::Point_3> points;
  for (const Vec3& x : s.x)
    points.emplace_back(x.x(), x.y(), x.z());
  std::vector<std::vector<std::size_t>> faces;
  for (const auto& [a, b, c] : s.triangles)
    faces.push_back({size_t(a), size_t(b), size_t(c)});
  EXPECT_TRUE(PMP::is_polygon_soup_a_polygon_mesh(faces));
  Mesh mesh;
  PMP::polygon_soup_to_polygon_mesh(points, faces, mesh);
  return mesh;
}

struct Solid {
  const char* name;
  ToolShape shape;
  double volume;          ///< mm^3
  double sagitta;         ///< mm, the most a facet may miss the surface for size 2 mm
  bool flat_ends = false; ///< of triangles of any size
};

/// A piece of at most 22.5 degrees or 2 mm on a circle of radius r.
double sagitta(double r) {
  return r * (1.0 - std::cos(std::min(pi / 16.0, 1.0 / r)));
}

/// Volume (mm^3) of a box of outer edges x, y, z rounded by e: Steiner's formula, for all within e
/// of the box of edges a, b, c.
double steiner(double x, double y, double z, double e) {
  const double a = x - 2.0 * e, b = y - 2.0 * e, c = z - 2.0 * e;
  return a * b * c + 2.0 * e * (a * b + b * c + c * a) + pi * e * e * (a + b + c) +
         4.0 / 3.0 * pi * e * e * e;
}

std::vector<Solid> solids() {
  // Volumes by Pappus; the last is a cone of radius 10 and height 20 on a disc.
  const double ring = pi * (45 * 45 - 20 * 20) * 10;
  // What a corner's arc of radius 3 cuts off: area (1 - pi/4) 9, its centroid 3 (10 - 3 pi)/(12 - 3
  // pi) from the sharp corner's sides.
  const double cut = 9.0 * (1.0 - pi / 4.0),
               from_side = 3.0 * (10.0 - 3.0 * pi) / (12.0 - 3.0 * pi);
  const double rounded = ring - 2.0 * cut * 2.0 * pi * ((45.0 - from_side) + (20.0 + from_side));
  // A disc of radius 45 - 4 and height 10 and, outside of it, the section's half disc of radius 4
  // (centroid 16/(3 pi) from its straight side) and the rectangle between the two roundings.
  const double rim = 2.0 * pi * (8.0 * pi * (41.0 + 16.0 / (3.0 * pi)) + 4.0 * 2.0 * 43.0);
  return {
      {"sphere", Sphere{20}, 4.0 / 3.0 * pi * 8000, 2 * sagitta(20)},
      {"cylinder", Cylinder{15, 20}, pi * 225 * 20, sagitta(15)},
      {"rounded cylinder", Cylinder{45, 10, 4}, pi * 41 * 41 * 10 + rim, sagitta(45) + sagitta(4)},
      {"box", Box{Vec3(20, 14, 10)}, 2800, 1e-12},
      // a square of a corner is halved along a diagonal: both sides' sagittas add up
      {"rounded box", Box{Vec3(20, 14, 10), 2}, steiner(20, 14, 10, 2), 2 * sagitta(2)},
      {"box of large roundings", Box{Vec3(40, 41, 42), 19.9}, steiner(40, 41, 42, 19.9),
       2 * sagitta(19.9)},
      {"ring", Annulus{20, 45, 10, 3}, rounded, sagitta(45) + sagitta(3)},
      {"sharp ring", Annulus{20, 45, 10, 0}, ring, sagitta(45)},
      {"disc", Annulus{0, 45, 10, 0}, pi * 45 * 45 * 10, sagitta(45)},
      {"cone", make_profile({{0, 20, 0}, {10, 0, 0}, {0, 0, 0}}), pi * 100 * 20 / 3, sagitta(10)},
      {"blunt cone", make_cone(10, 5, 20, 0), pi * (100 + 50 + 25) * 20 / 3, sagitta(10)},
      {"torus", make_torus(30, 12), 2 * pi * 30 * pi * 144, sagitta(42) + sagitta(12)},
      {"rod", ExtrudedProfile{{{ProfileSegment::Kind::arc, {9, 0}, {9, 0}, {0, 0}, -1}}, 20},
       pi * 81 * 20, sagitta(9), true},
      {"angle", // with a fillet of 4 in the inner corner
       ExtrudedProfile{
           make_profile(
               {{0, 20, 0}, {3, 20, 0}, {3, 3, 4}, {25, 3, 0}, {25, 0, 0}, {0, 0, 0}, {0, 20, 0}})
               .segments,
           30},
       (25 * 3 + 17 * 3 + 16 * (1 - pi / 4)) * 30, sagitta(4), true}};
}

TEST(Tessellate, SolidsAreClosedOutwardAndFreeOfSelfIntersections) {
  for (const Solid& solid : solids()) {
    SCOPED_TRACE(solid.name);
    const Mesh mesh = to_cgal(tessellate(solid.shape, 2.0, 0.0));
    EXPECT_TRUE(CGAL::is_closed(mesh));
    EXPECT_TRUE(PMP::is_outward_oriented(mesh));
    EXPECT_FALSE(PMP::does_self_intersect(mesh));
    for (const Mesh::Face_index f : mesh.faces())
      ASSERT_GT(PMP::face_area(f, mesh), 1e-6);
    // Inscribed chords of 2 mm lose at most 1 % of these volumes, and gain where the ring is
    // hollow.
    EXPECT_NEAR(PMP::volume(mesh) / solid.volume, 1.0, 0.01);
    EXPECT_EQ(mesh.number_of_vertices(), tessellate(solid.shape, 2.0, 0.0).x.size());
  }
}

TEST(Tessellate, KnowsTheSizeOfAShapeFromItsCoarsestFacets) {
  for (const Solid& solid : solids()) {
    Box3 box;
    for (const Vec3& x : tessellate(solid.shape, 0.5, 0.0).x)
      box.extend(x);
    EXPECT_NEAR(diagonal_of(solid.shape, 0.0) / box.diagonal().norm(), 1.0, 1e-3) << solid.name;
  }
  EXPECT_NEAR(diagonal_of(Plane{}, 100.0), 200.0 * std::sqrt(2.0), 1e-9);
}

TEST(Tessellate, FacetsStayWithinTheSagitta) {
  for (const Solid& solid : solids()) {
    SCOPED_TRACE(solid.name);
    const TriMesh s = tessellate(solid.shape, 2.0, 0.0);
    for (const Vec3& x : s.x)
      ASSERT_NEAR(testing::ask(solid.shape, x).distance, 0.0, 1e-12);
    for (const auto& [a, b, c] : s.triangles) {
      const Vec3 &x = s.x[size_t(a)], &y = s.x[size_t(b)], &z = s.x[size_t(c)];
      for (const Vec3& p :
           {Vec3((x + y + z) / 3.0), Vec3((x + y) / 2.0), Vec3((y + z) / 2.0), Vec3((z + x) / 2.0)})
        ASSERT_TRUE(std::abs(testing::ask(solid.shape, p).distance) <= solid.sagitta + 1e-12)
            << p.transpose() << ": " << testing::ask(solid.shape, p).distance;
      if (solid.flat_ends && std::abs((y - x).cross(z - x).normalized().y()) > 0.999) continue;
      // Sides along rings and sections are at most `size` long, and diagonals join two of them.
      ASSERT_LT(std::max({(x - y).norm(), (y - z).norm(), (z - x).norm()}),
                2.0 * std::sqrt(2.0) + 1e-9);
    }
  }
}

TEST(Tessellate, FacetNormalsAgreeWithTheShape) {
  std::vector<ToolShape> shapes{Plane{}, make_profile({{80, -120, 0}, {80, 0, 10}, {400, 0, 0}})};
  for (const Solid& solid : solids())
    shapes.push_back(solid.shape);
  for (const ToolShape& shape : shapes) {
    SCOPED_TRACE(shape.index());
    const TriMesh s = tessellate(shape, shape.index() > 2 ? 8.0 : 1.5, 50.0);
    ASSERT_FALSE(s.triangles.empty());
    for (const auto& [a, b, c] : s.triangles) {
      const Vec3 &x = s.x[size_t(a)], &y = s.x[size_t(b)], &z = s.x[size_t(c)];
      const Vec3 n = (y - x).cross(z - x).normalized();
      // Nearly all of the 22.5 degrees of a piece, times two for triangles in a curved corner.
      ASSERT_GT(n.dot(testing::ask(shape, (x + y + z) / 3.0).normal), 0.9);
    }
  }
}

TEST(Tessellate, PlaneIsCutToItsExtent) {
  const TriMesh s = tessellate(Plane{}, 10.0, 35.0);
  Box3 box;
  for (const Vec3& x : s.x)
    box.extend(x);
  EXPECT_TRUE(box.min() == Vec3(-35, -35, 0) && box.max() == Vec3(35, 35, 0));
  EXPECT_EQ(s.triangles.size(), 2u * 7u * 7u);
}

TEST(Tessellate, OpenProfileGivesAnOpenSurface) {
  const TriMesh s = tessellate(make_profile({{80, -120, 0}, {80, 0, 10}, {400, 0, 0}}), 20.0, 0.0);
  const Mesh mesh = to_cgal(s);
  EXPECT_FALSE(CGAL::is_closed(mesh));
  EXPECT_FALSE(PMP::does_self_intersect(mesh));
}

TEST(Tessellate, SizeMustBeAboveZero) {
  EXPECT_THROW(tessellate(Sphere{1}, 0.0, 1.0), std::invalid_argument);
}

} // namespace
} // namespace plyform::tessellate_test
