// SPDX-License-Identifier: GPL-3.0-or-later
// Mesh tools against closed forms of the same solid, and against brute force over all triangles:
// CGAL's squared distance, and the sign by the solid angle (van Oosterom and Strackee 1983).
#include "contact/shapes/mesh_shape.hpp"
#include "support/shape_checks.hpp"

#include <CGAL/Simple_cartesian.h>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>

namespace plyform::mesh_shape_test {
namespace {

using testing::ask;
using testing::RandomPoints;
constexpr double pi = std::numbers::pi;

const Vec3& corner(const TriMesh& s, const Triangle& t, std::size_t k) {
  return s.x[t[k]];
}

double brute_force_distance(const TriMesh& s, const Vec3& p) {
  using K = CGAL::Simple_cartesian<double>;
  const auto to = [](const Vec3& x) { return K::Point_3(x.x(), x.y(), x.z()); };
  double best = std::numeric_limits<double>::infinity();
  for (const Triangle& t : s.triangles)
    best = std::min(
        best, CGAL::squared_distance(to(p), K::Triangle_3(to(corner(s, t, 0)), to(corner(s, t, 1)),
                                                          to(corner(s, t, 2)))));
  return std::sqrt(best);
}

/// Turns of the surface about p: 1 inside, 0 outside.
double winding(const TriMesh& s, const Vec3& p) {
  double angle = 0.0;
  for (const Triangle& t : s.triangles) {
    const Vec3 a = corner(s, t, 0) - p, b = corner(s, t, 1) - p, c = corner(s, t, 2) - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    angle += 2.0 * std::atan2(a.dot(b.cross(c)),
                              la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return angle / (4.0 * pi);
}

/// A ball whose every node is pushed in or out: sharp ridges, valleys, saddles and spikes.
TriMesh urchin(unsigned seed) {
  TriMesh s = tessellate(Sphere{1.0}, 0.5, 0.0);
  RandomPoints random(seed);
  for (Vec3& x : s.x)
    x *= random.in(5.0, 20.0);
  return s;
}

/// An L: inner edges and corners.
TriMesh bracket() {
  const std::vector<Vec2> outline{{0, 0}, {30, 0}, {30, 10}, {10, 10}, {10, 30}, {0, 30}};
  TriMesh s;
  for (const double z : {0.0, 10.0})
    for (const Vec2& q : outline)
      s.x.emplace_back(q.x(), q.y(), z);
  for (const Triangle& t : {Triangle{0, 1, 3}, {1, 2, 3}, {0, 3, 5}, {3, 4, 5}}) {
    s.triangles.push_back({t[2], t[1], t[0]});
    s.triangles.push_back({t[0] + 6, t[1] + 6, t[2] + 6});
  }
  for (int i = 0; i < 6; ++i) {
    const int j = (i + 1) % 6;
    s.triangles.push_back({i, j, j + 6});
    s.triangles.push_back({i, j + 6, i + 6});
  }
  return s;
}

/// Sharp along y: its large faces, 3 degrees apart, share an edge.
TriMesh blade() {
  TriMesh s;
  for (const double y : {0.0, 20.0})
    s.x.insert(s.x.end(), {{0, y, 0}, {24, y, -0.6}, {24, y, 0.6}});
  s.triangles = {{0, 3, 4}, {0, 4, 1}, {0, 2, 5}, {0, 5, 3},
                 {1, 4, 5}, {1, 5, 2}, {0, 1, 2}, {3, 5, 4}};
  return s;
}

std::vector<TriMesh> solids() {
  return {tessellate(Box{Vec3(20, 14, 10)}, 5.0, 0.0), bracket(), urchin(1), urchin(2),
          tessellate(Annulus{8, 20, 6, 2}, 3.0, 0.0),  blade()};
}

const Box3 around(Vec3(-25, -25, -25), Vec3(35, 35, 25));

/// Random points, those of the mesh's nodes, edges and faces, and near them.
std::vector<Vec3> telling_points(const TriMesh& s, int count, unsigned seed) {
  RandomPoints random(seed);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    points.push_back(random.in(around));
    const Triangle& t = s.triangles[random.engine() % s.triangles.size()];
    double u = random.in(0, 1), v = random.in(0, 1);
    if (i % 3 == 0) u = 0.0;
    if (i % 6 == 0) v = i % 12 ? 0.0 : 0.5;
    if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
    const Vec3 on = corner(s, t, 0) + u * (corner(s, t, 1) - corner(s, t, 0)) +
                    v * (corner(s, t, 2) - corner(s, t, 0));
    points.push_back(on);
    points.push_back(on + std::pow(10.0, random.in(-9, 0)) * Vec3::Random());
  }
  return points;
}

TEST(MeshShape, BoxMeshEqualsClosedForm) {
  const Box box{Vec3(20, 14, 10)};
  for (const double size : {50.0, 5.0, 2.5}) {
    MeshReport report;
    const TriMesh surface = tessellate(box, size, 0.0);
    const ToolShape mesh = make_mesh_shape(surface, &report);
    EXPECT_TRUE(report.closed);
    EXPECT_FALSE(report.flipped);
    EXPECT_EQ(report.faces, surface.triangles.size());
    for (const Vec3& p : telling_points(surface, 5000, 1))
      // 1e-12: some hundred ulp of 35 mm
      ASSERT_NEAR(ask(mesh, p).distance, ask(box, p).distance, 1e-12) << p.transpose();
  }
}

TEST(MeshShape, AgreesWithBruteForce) {
  int negative = 0, positive = 0;
  for (const TriMesh& surface : solids()) {
    const ToolShape mesh = make_mesh_shape(surface, nullptr);
    for (const Vec3& p : telling_points(surface, 1000, 2)) {
      const double s = ask(mesh, p).distance;
      // CGAL's distance to a point that all but lies on the triangle has rounding of 1e-8 mm
      // (squares); further off of 1e-12 mm.
      const double brute = brute_force_distance(surface, p);
      ASSERT_NEAR(std::abs(s), brute, brute < 1e-6 ? 1e-7 : 1e-10) << p.transpose();
      if (brute < 1e-7) continue;
      const double turns = winding(surface, p);
      ASSERT_TRUE(std::abs(turns - (s < 0.0 ? 1.0 : 0.0)) < 0.4)
          << p.transpose() << " s = " << s << " turns " << turns;
      ++(s < 0.0 ? negative : positive);
    }
  }
  EXPECT_GT(negative, 1500);
  EXPECT_GT(positive, 1500);
}

TEST(MeshShape, NormalIsGradient) {
  for (const TriMesh& surface : solids())
    EXPECT_GT(testing::check_gradient(make_mesh_shape(surface, nullptr), around, 2000, 3), 1800);
}

TEST(MeshShape, NormalsAreUnitEverywhere) {
  for (const TriMesh& surface : solids()) {
    const ToolShape mesh = make_mesh_shape(surface, nullptr);
    for (const Vec3& p : telling_points(surface, 1000, 4))
      ASSERT_NEAR(ask(mesh, p).normal.norm(), 1.0, 1e-12) << p.transpose();
  }
}

TEST(MeshShape, NormalsOfNodesAndFacesPointOut) {
  for (const TriMesh& surface : solids()) {
    const ToolShape mesh = make_mesh_shape(surface, nullptr);
    std::vector<Vec3> points = surface.x;
    for (const Triangle& t : surface.triangles)
      points.push_back((corner(surface, t, 0) + corner(surface, t, 1) + corner(surface, t, 2)) /
                       3.0);
    for (const Vec3& p : points) {
      const SurfacePoint at = ask(mesh, p);
      ASSERT_NEAR(at.distance, 0.0, 1e-13);
      // A small step along the normal leaves the solid, a step back enters it.
      ASSERT_GT(ask(mesh, p + 1e-4 * at.normal).distance, 0.0) << p.transpose();
      ASSERT_LT(ask(mesh, p - 1e-4 * at.normal).distance, 0.0) << p.transpose();
    }
  }
}

TEST(MeshShape, DistanceChangesNoFasterThanTheWay) {
  for (const TriMesh& surface : solids())
    testing::check_lipschitz(make_mesh_shape(surface, nullptr), around, 3000, 5);
}

bool same_bits(const SurfacePoint& a, const SurfacePoint& b) {
  return a.distance == b.distance && a.normal == b.normal;
}

TEST(MeshShape, AnswerDoesNotDependOnHint) {
  for (const TriMesh& surface : solids()) {
    const ToolShape mesh = make_mesh_shape(surface, nullptr);
    std::vector<Vec3> points = telling_points(surface, 500, 7);
    for (int i = -4; i <= 4; ++i) // equally far from several faces
      for (int j = -4; j <= 4; ++j)
        points.insert(points.end(), {Vec3(i, j, 0), Vec3(i, j, 3), Vec3(i, i, j)});
    RandomPoints random(8);
    const auto faces = static_cast<int>(surface.triangles.size());
    for (const Vec3& p : points) {
      SurfaceHint found;
      const SurfacePoint unaided = signed_distance(mesh, p, found);
      ASSERT_TRUE(found.facet >= 0 && found.facet < faces);
      for (int k = 0; k < 8; ++k) {
        SurfaceHint hint;
        hint.facet = k == 0   ? found.facet
                     : k == 1 ? faces + 5
                              : static_cast<int>(random.in(0, faces));
        ASSERT_TRUE(same_bits(signed_distance(mesh, p, hint), unaided)) << p.transpose();
        ASSERT_EQ(hint.facet, found.facet) << p.transpose();
      }
    }
  }
}

TEST(MeshShape, PointThatSlidesGetsTheSameAnswersWithFewerSearches) {
  for (const TriMesh& surface : solids()) {
    const ToolShape mesh = make_mesh_shape(surface, nullptr);
    RandomPoints random(9);
    int searches = 0, steps = 0;
    const auto points = telling_points(surface, 60, 10);
    for (std::size_t start = 0; start < points.size(); ++start) {
      const Vec3 step(random.in(-0.004, 0.004), random.in(-0.004, 0.004), random.in(-0.004, 0.004));
      SurfaceHint kept;
      for (int i = 0; i < 200; ++i) {
        const Vec3 p = points[start] + i * step, before(kept.at[0], kept.at[1], kept.at[2]);
        const double least = least_distance(kept, (p - before).norm());
        SurfaceHint fresh;
        const SurfacePoint found = signed_distance(mesh, p, fresh);
        ASSERT_LE(least, found.distance) << p.transpose();
        ASSERT_TRUE(same_bits(signed_distance(mesh, p, kept), found)) << p.transpose();
        if (start % 3 != 0) continue; // begins on an edge, or on the surface
        searches += Vec3(kept.at[0], kept.at[1], kept.at[2]) != before ? 1 : 0;
        ++steps;
      }
    }
    EXPECT_LT(searches, steps / 4);
  }
}

TEST(MeshShape, ThreadsGetTheSameAnswers) {
  const TriMesh surface = urchin(3);
  const ToolShape mesh = make_mesh_shape(surface, nullptr); // the threads are the first to ask
  const std::vector<Vec3> points = telling_points(surface, 2000, 9);
  std::vector<std::vector<SurfacePoint>> answers(4);
  std::vector<std::thread> threads;
  for (auto& answer : answers)
    threads.emplace_back([&] {
      SurfaceHint hint;
      for (const Vec3& p : points)
        answer.push_back(signed_distance(mesh, p, hint));
    });
  for (std::thread& thread : threads)
    thread.join();
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t k = 1; k < answers.size(); ++k)
      ASSERT_TRUE(same_bits(answers[k][i], answers[0][i]));
}

TEST(MeshShape, OpenMeshTakesTheSideOfItsTriangles) {
  MeshReport report;
  const ToolShape sheet = make_mesh_shape(tessellate(Plane{}, 5.0, 20.0), &report);
  EXPECT_FALSE(report.closed);
  EXPECT_FALSE(report.flipped);
  RandomPoints random(10);
  for (int i = 0; i < 10000; ++i) {
    const Vec3 p = random.in(Box3(Vec3(-20, -20, -9), Vec3(20, 20, 9)));
    const SurfacePoint at = ask(sheet, p);
    ASSERT_NEAR(at.distance, p.z(), 1e-13);
    ASSERT_TRUE((at.normal - Vec3::UnitZ()).norm() < 1e-13);
  }
  EXPECT_NEAR(ask(sheet, Vec3(23, 0, -4)).distance, -5.0, 1e-13); // past its edge
  EXPECT_NEAR(ask(sheet, Vec3(23, 0, 4)).distance, 5.0, 1e-13);
}

TEST(MeshShape, InwardMeshIsTurnedOutward) {
  TriMesh inward = bracket();
  for (Triangle& t : inward.triangles)
    std::swap(t[1], t[2]);
  MeshReport report;
  const ToolShape mesh = make_mesh_shape(inward, &report);
  EXPECT_TRUE(report.closed);
  EXPECT_TRUE(report.flipped);
  EXPECT_NEAR(ask(mesh, Vec3(5, 5, 5)).distance, -5.0, 1e-13);
}

TEST(MeshShape, MixedOrientationAndUnmergedCornersAreRepaired) {
  const TriMesh good = urchin(4);
  TriMesh soup; // every triangle with its own corners, every third turned over
  for (std::size_t f = 0; f < good.triangles.size(); ++f) {
    const auto n = static_cast<std::int32_t>(soup.x.size());
    for (std::size_t k = 0; k < 3; ++k)
      soup.x.push_back(corner(good, good.triangles[f], k));
    soup.triangles.push_back(f % 3 ? Triangle{n, n + 1, n + 2} : Triangle{n, n + 2, n + 1});
  }
  soup.triangles.push_back({0, 0, 1}); // and one that is none
  MeshReport report;
  const ToolShape mesh = make_mesh_shape(soup, &report), reference = make_mesh_shape(good, nullptr);
  EXPECT_TRUE(report.closed);
  EXPECT_EQ(report.vertices, good.x.size());
  EXPECT_EQ(report.faces, good.triangles.size());
  EXPECT_EQ(report.removed_degenerate, 1u);
  for (const Vec3& p : telling_points(good, 1000, 11))
    ASSERT_NEAR(ask(mesh, p).distance, ask(reference, p).distance, 1e-12);
}

TEST(MeshShape, AHollowPartIsEmptyInside) {
  TriMesh both = tessellate(Box{Vec3(20, 20, 20)}, 50.0, 0.0);
  const TriMesh hole = tessellate(Box{Vec3(10, 10, 10)}, 50.0, 0.0);
  const auto n = static_cast<std::int32_t>(both.x.size());
  both.x.insert(both.x.end(), hole.x.begin(), hole.x.end());
  for (const Triangle& t : hole.triangles)
    both.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  const ToolShape mesh = make_mesh_shape(both, nullptr);
  EXPECT_NEAR(ask(mesh, Vec3::Zero()).distance, 5.0, 1e-13);
  EXPECT_NEAR(ask(mesh, Vec3(7, 0, 0)).distance, -2.0, 1e-13);
  EXPECT_NEAR(ask(mesh, Vec3(12, 0, 0)).distance, 2.0, 1e-13);
}

TEST(MeshShape, AFlatFaceInAClosedMeshLeavesItClosed) {
  TriMesh s; // a tetrahedron with a node in the middle of one edge, used by one of its two faces
  s.x = {Vec3(0, 0, 0), Vec3(10, 0, 0), Vec3(0, 10, 0), Vec3(0, 0, 10), Vec3(5, 0, 0)};
  s.triangles = {{0, 2, 4}, {4, 2, 1}, {0, 1, 3}, {0, 4, 1}, {1, 2, 3}, {0, 3, 2}};
  MeshReport report;
  const ToolShape mesh = make_mesh_shape(s, &report);
  EXPECT_TRUE(report.closed);
  EXPECT_EQ(report.removed_degenerate, 1u);
  EXPECT_NEAR(ask(mesh, Vec3(5, 0.25, 1)).distance, -0.25, 1e-13);
  EXPECT_NEAR(ask(mesh, Vec3(5, -0.25, 1)).distance, 0.25, 1e-13);
}

void expect_rejected(const TriMesh& surface, const std::string& reason) {
  try {
    make_mesh_shape(surface, nullptr);
    ADD_FAILURE() << "accepted, expected: " << reason;
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
  }
}

TEST(MeshShape, MoebiusStripIsRejected) {
  TriMesh strip;
  constexpr int n = 24;
  for (int i = 0; i < n; ++i)
    for (const double w : {-3.0, 3.0}) {
      const double t = 2.0 * pi * i / n, r = 20.0 + w * std::cos(0.5 * t);
      strip.x.emplace_back(r * std::cos(t), r * std::sin(t), w * std::sin(0.5 * t));
    }
  for (int i = 0; i < n; ++i) {
    const bool last = i + 1 == n; // joined upside down
    const int a = 2 * i, b = a + 1, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
    strip.triangles.push_back({a, c, b});
    strip.triangles.push_back({b, c, d});
  }
  expect_rejected(strip, "not orientable: it is a one-sided surface");
}

TEST(MeshShape, BrokenMeshesAreRejectedWithTheReason) {
  TriMesh fin = bracket(); // a third face on one edge
  fin.x.emplace_back(-5, -5, -5);
  fin.triangles.push_back({0, 1, 12});
  expect_rejected(fin, "not orientable: 3 faces share the edge from (");

  TriMesh crossing = bracket();
  for (const TriMesh& other : {bracket()}) {
    for (const Vec3& x : other.x)
      crossing.x.push_back(x + Vec3(3, 4, 5));
    for (const Triangle& t : other.triangles)
      crossing.triangles.push_back({t[0] + 12, t[1] + 12, t[2] + 12});
  }
  expect_rejected(crossing, "crosses or touches itself at");

  TriMesh infinite = bracket();
  infinite.x[3].y() = std::numeric_limits<double>::quiet_NaN();
  expect_rejected(infinite, "a coordinate of point 3 is not a finite number");

  TriMesh wrong = bracket();
  wrong.triangles[2][1] = 99;
  expect_rejected(wrong, "face 2 names point 99, but there are only 12");
  wrong.triangles[2][1] = -1;
  expect_rejected(wrong, "face 2 names point ");

  expect_rejected(TriMesh{}, "it holds no faces");
  expect_rejected(TriMesh{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0)}, {{0, 1, 2}}},
                  "none of its faces has an area");
  expect_rejected(TriMesh{{Vec3(0, 0, 0), Vec3(1, 0, 0)}, {{0, 1, 1}}},
                  "none of its faces has an area");
}

} // namespace
} // namespace plyform::mesh_shape_test
