// SPDX-License-Identifier: GPL-3.0-or-later
// Boxes and cylinders with rounded edges against the sharp shapes that they come from, and against
// fine triangles of themselves.
#include "support/shape_checks.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>

namespace plyform::rounded_shape_test {
namespace {

using testing::ask;
using testing::RandomPoints;

constexpr double rounding = 1e-12; // mm: some ulp of coordinates of up to 100 mm

/// A rounded shape, the sharp one of the same outer dimensions, and that which is smaller by the
/// edge radius on every side.
struct Rounded {
  const char* name;
  ToolShape shape, sharp, inner;
  double edge;
};

Rounded rounded(const char* name, const Vec3& size, double e) {
  return {name, Box{size, e}, Box{size}, Box{size - Vec3::Constant(2.0 * e)}, e};
}

Rounded rounded(const char* name, double radius, double length, double e) {
  return {name, Cylinder{radius, length, e}, Cylinder{radius, length},
          Cylinder{radius - e, length - 2.0 * e}, e};
}

std::vector<Rounded> shapes() {
  return {rounded("box", {70.0, 50.0, 30.0}, 8.0),
          rounded("punch", {100.0, 100.0, 60.0}, 10.0),
          rounded("nearly a ball", {40.0, 41.0, 42.0}, 19.9),
          rounded("nearly sharp", {70.0, 50.0, 30.0}, 1e-3),
          rounded("thin plate", {70.0, 50.0, 2.0}, 0.9),
          rounded("cylinder", 35.0, 50.0, 6.0),
          rounded("coin", 45.0, 10.0, 4.9),
          rounded("rod", 5.0, 80.0, 4.9)};
}

const Box3 space(Vec3(-70, -70, -70), Vec3(70, 70, 70));

/// Calls `check` for random points of which every other one is near the surface.
template <class Check>
void visit_points(const Rounded& r, int count, unsigned seed, const Check& check) {
  RandomPoints random(seed);
  for (int i = 0; i < count && !::testing::Test::HasFailure(); ++i) {
    Vec3 p = random.in(space);
    if (i % 2) {
      const SurfacePoint far = ask(r.shape, p);
      p += (random.in(-1.5 * r.edge, r.edge) - far.distance) * far.normal;
    }
    check(p);
  }
}

TEST(RoundedShape, IsTheSmallerSharpShapeAndAllWithinTheRadiusOfIt) {
  for (const Rounded& r : shapes()) {
    SCOPED_TRACE(r.name);
    int inside = 0;
    visit_points(r, 20000, 1, [&](const Vec3& p) {
      const SurfacePoint here = ask(r.shape, p), inner = ask(r.inner, p);
      EXPECT_NEAR(here.distance, inner.distance - r.edge, rounding) << p.transpose();
      // a way of length d to the inner shape has rounding / d in its direction
      if (std::abs(inner.distance) > 1e-6) {
        EXPECT_LT((here.normal - inner.normal).norm(), 1e-9 + rounding / std::abs(inner.distance))
            << p.transpose();
      }
      inside += here.distance < 0.0;
    });
    EXPECT_GT(inside, 2000);
  }
}

TEST(RoundedShape, LiesWithinTheSharpOneAndKeepsItsFlatFaces) {
  for (const Rounded& r : shapes()) {
    SCOPED_TRACE(r.name);
    int flat = 0, off = 0;
    visit_points(r, 20000, 2, [&](const Vec3& p) {
      const double here = ask(r.shape, p).distance, sharp = ask(r.sharp, p).distance;
      const double inner = ask(r.inner, p).distance;
      EXPECT_GE(here, sharp - rounding) << p.transpose();
      // farthest apart at the corner of a box: the diagonal of a cube of edge e, minus e
      EXPECT_LE(here, sharp + (std::sqrt(3.0) - 1.0) * r.edge + rounding) << p.transpose();
      if (inner < 0.0) {
        EXPECT_NEAR(here, sharp, rounding) << p.transpose();
        ++flat;
      }
      off += here > sharp + 1e-3 * r.edge;
    });
    EXPECT_GT(off, 100);
    if (r.edge < 4.0) { // else too little of the volume for points at random
      EXPECT_GT(flat, 0);
    }
  }
}

/// As before there was a radius, to the bit: results of old cases stay what they were.
TEST(RoundedShape, WithoutRadiusIsThePlainSharpFormulaToTheBit) {
  const Vec3 size(70.0, 50.0, 30.0);
  const Box box{size};
  visit_points(rounded("box", size, 3.0), 20000, 3, [&](const Vec3& p) {
    const Vec3 q = p.cwiseAbs() - 0.5 * size;
    const bool face = (q.array() > 0.0).count() < 2;
    EXPECT_EQ(ask(box, p).distance, face ? q.maxCoeff() : q.cwiseMax(0.0).norm());
  });
  const std::array<int, 3> n{24, 17, 10}; // pieces of at most 3 mm
  const TriMesh surface = tessellate(box, 3.0, 0.0);
  EXPECT_EQ(surface.triangles.size(), 4u * (24 * 17 + 17 * 10 + 10 * 24));
  for (const Vec3& x : surface.x)
    for (int k = 0; k < 3; ++k) {
      const int cells = n[k];
      const double i = std::round((x[k] / size[k] + 0.5) * cells);
      ASSERT_EQ(x[k], size[k] * (i / cells - 0.5));
    }
}

/// Nodes lie on the surface, so that the triangles lie inside by at most the sagitta of a diagonal.
TEST(RoundedShape, DistanceIsThatToItsFineTriangles) {
  constexpr double size = 0.5; // mm
  for (const Rounded& r :
       {rounded("box", {20.0, 14.0, 10.0}, 3.0),
        rounded("large roundings", {20.0, 14.0, 10.0}, 4.9), rounded("cylinder", 9.0, 14.0, 3.0)}) {
    SCOPED_TRACE(r.name);
    const ToolShape mesh = make_mesh_shape(tessellate(r.shape, size, 0.0), nullptr);
    const double sag = 2.0 * size * size / (8.0 * r.edge); // chords along both sides of a square
    RandomPoints random(4);
    int inside = 0;
    for (int i = 0; i < 5000; ++i) {
      const Vec3 p = random.in(Box3(Vec3(-14, -14, -14), Vec3(14, 14, 14)));
      const double exact = ask(r.shape, p).distance, drawn = ask(mesh, p).distance;
      ASSERT_GE(drawn, exact - rounding) << p.transpose();
      ASSERT_LE(drawn, exact + sag + rounding) << p.transpose();
      inside += exact < 0.0;
    }
    EXPECT_GT(inside, 300);
  }
}

TEST(RoundedShape, HasKnownDistancesAtEdgesAndCorners) {
  const Box box{Vec3(100.0, 100.0, 60.0), 10.0};
  EXPECT_NEAR(ask(box, Vec3(0, 0, -30)).distance, 0.0, rounding);   // face
  EXPECT_NEAR(ask(box, Vec3(46, 48, 0)).distance, 0.0, rounding);   // edge: (6, 8) from (40, 40)
  EXPECT_NEAR(ask(box, Vec3(43, 44, 0)).distance, -5.0, rounding);  // half way
  EXPECT_NEAR(ask(box, Vec3(42, 43, 26)).distance, -3.0, rounding); // corner: (2, 3, 6)
  EXPECT_NEAR(ask(box, Vec3(50, 50, 30)).distance, 10.0 * (std::sqrt(3.0) - 1.0), rounding);
  EXPECT_NEAR(ask(box, Vec3(0, 0, 0)).distance, -30.0, rounding);
  const Vec3 n = ask(box, Vec3(-42, 43, -26)).normal;
  EXPECT_LT((n - Vec3(-2, 3, -6) / 7.0).norm(), rounding);
  const Cylinder rod{20.0, 50.0, 5.0};
  EXPECT_NEAR(ask(rod, Vec3(0, 18, 24)).distance, 0.0, rounding); // rim: (3, 4) from (15, 20)
  EXPECT_NEAR(ask(rod, Vec3(0, 0, 24)).distance, -1.0, rounding);
}

TEST(RoundedShape, TakesNoLargerRadiusThanFits) {
  RandomPoints random(5);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p = random.in(space);
    const double ball = ask(Sphere{20.0}, p).distance;
    EXPECT_NEAR(ask(Box{Vec3(40, 40, 40), 25.0}, p).distance, ball, rounding);
    EXPECT_NEAR(ask(Cylinder{20.0, 40.0, 25.0}, p).distance, ball, rounding);
  }
}

} // namespace
} // namespace plyform::rounded_shape_test
