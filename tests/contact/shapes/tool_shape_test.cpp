// SPDX-License-Identifier: GPL-3.0-or-later
// Closed-form shapes against FCL (collide with a ball) and against each other.
#include "contact/shapes/tool_shape.hpp"
#include "support/fcl_all.hpp"
#include "support/shape_checks.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <memory>

namespace plyform::tool_shape_test {
namespace {

using testing::ask;
using testing::RandomPoints;

const Box3 space(Vec3(-60, -60, -60), Vec3(60, 60, 60));

bool touches_ball(const fcl::CollisionGeometryd& geometry, const Vec3& p, double radius) {
  const fcl::Sphered ball(radius);
  fcl::CollisionRequestd request;
  fcl::CollisionResultd result;
  return fcl::collide(&geometry, fcl::Transform3d::Identity(), &ball,
                      fcl::Transform3d(fcl::Translation3d(p)), request, result) > 0;
}

/// Outside, a ball about p of radius s - e must miss the shape and one of s + e must hit it; inside
/// (and within e of the surface both ways) a ball of radius e stands for the point. e = 1e-4 mm is
/// what GJK's tolerance of 1e-6 is sure to tell apart.
void expect_fcl_agrees(const ToolShape& shape, const fcl::CollisionGeometryd& geometry, int count) {
  constexpr double e = 1e-4;
  RandomPoints random(1);
  int outside = 0, inside = 0;
  for (int i = 0; i < count; ++i) {
    Vec3 p = random.in(space);
    if (i % 2) { // every other point close to the surface
      const SurfacePoint far = ask(shape, p);
      p += (random.in(-0.01, 0.01) - far.distance) * far.normal;
    }
    const double s = ask(shape, p).distance;
    if (std::abs(s) < 2.0 * e) continue;
    if (s < 0.0) {
      ++inside;
      ASSERT_TRUE(touches_ball(geometry, p, e)) << p.transpose() << " s = " << s;
    } else {
      ++outside;
      ASSERT_FALSE(touches_ball(geometry, p, s - e)) << p.transpose() << " s = " << s;
      ASSERT_TRUE(touches_ball(geometry, p, s + e)) << p.transpose() << " s = " << s;
    }
  }
  EXPECT_GT(outside, count / 4);
  EXPECT_GT(inside, count / 20);
}

TEST(ToolShape, SphereAgreesWithFcl) {
  expect_fcl_agrees(Sphere{40.0}, fcl::Sphered(40.0), 100000);
}

TEST(ToolShape, CylinderAgreesWithFcl) {
  expect_fcl_agrees(Cylinder{35.0, 50.0}, fcl::Cylinderd(35.0, 50.0), 100000);
}

TEST(ToolShape, BoxAgreesWithFcl) {
  expect_fcl_agrees(Box{Vec3(70.0, 50.0, 30.0)}, fcl::Boxd(70.0, 50.0, 30.0), 100000);
}

TEST(ToolShape, PlaneAgreesWithFcl) {
  expect_fcl_agrees(Plane{}, fcl::Halfspaced(Vec3::UnitZ(), 0.0), 100000);
}

/// Shortest way to densely sampled section boundary: an upper bound within `spacing` of the truth.
double sampled_section_distance(const Annulus& a, const Vec2& q, double spacing) {
  const double e = a.edge_radius, ri = a.inner_radius, ro = a.outer_radius, h = a.thickness;
  double best = std::numeric_limits<double>::infinity();
  const auto add = [&](double r, double z) { best = std::min(best, (q - Vec2(r, z)).norm()); };
  for (double r = (ri > 0 ? ri + e : 0.0); r <= ro - e; r += spacing)
    add(r, 0), add(r, h);
  for (double z = e; z <= h - e; z += spacing) {
    add(ro, z);
    if (ri > 0) add(ri, z);
  }
  for (double t = 0; t <= M_PI / 2 && e > 0; t += spacing / e)
    for (const double z : {e - e * std::sin(t), h - e + e * std::sin(t)}) {
      add(ro - e + e * std::cos(t), z);
      if (ri > 0) add(ri + e - e * std::cos(t), z);
    }
  return best;
}

bool inside_section(const Annulus& a, const Vec2& q) {
  const double e = a.edge_radius;
  if (q.x() < a.inner_radius || q.x() > a.outer_radius || q.y() < 0 || q.y() > a.thickness)
    return false;
  const bool low = q.y()<e, high = q.y()> a.thickness - e;
  const bool out = q.x() > a.outer_radius - e,
             in = a.inner_radius > 0 && q.x() < a.inner_radius + e;
  if (!(low || high) || !(out || in)) return true;
  const Vec2 c(out ? a.outer_radius - e : a.inner_radius + e, low ? e : a.thickness - e);
  return (q - c).norm() < e;
}

TEST(ToolShape, AnnulusAgreesWithItsSampledSection) {
  constexpr double spacing = 0.05;
  for (const Annulus& a : {Annulus{20, 45, 10, 3}, Annulus{20, 45, 10, 0}, Annulus{0, 45, 10, 4},
                           Annulus{20, 30, 10, 5}}) {
    RandomPoints random(2);
    for (int i = 0; i < 3000; ++i) {
      const Vec3 p = random.in(Box3(Vec3(-60, -60, -10), Vec3(60, 60, 20)));
      const Vec2 q(p.head<2>().norm(), p.z());
      const double s = ask(a, p).distance, sampled = sampled_section_distance(a, q, spacing);
      ASSERT_TRUE(std::abs(s) <= sampled + 1e-12) << p.transpose();
      ASSERT_TRUE(std::abs(s) >= sampled - spacing) << p.transpose();
      ASSERT_EQ(s < 0.0, inside_section(a, q)) << p.transpose();
    }
  }
}

/// The same solid as a chain of lines and arcs takes wholly different code.
TEST(ToolShape, AnnulusEqualsItsProfile) {
  const Annulus a{20, 45, 10, 3};
  const RevolvedProfile ring =
      make_profile({{30, 10, 0}, {45, 10, 3}, {45, 0, 3}, {20, 0, 3}, {20, 10, 3}, {30, 10, 0}});
  RandomPoints random(3);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 p = random.in(Box3(Vec3(-60, -60, -10), Vec3(60, 60, 20)));
    // 1e-12: a few ulp of 60 mm
    ASSERT_NEAR(ask(a, p).distance, ask(ring, p).distance, 1e-12) << p.transpose();
  }
}

std::vector<ToolShape> closed_forms() {
  return {Sphere{40.0},
          Cylinder{35.0, 50.0},
          Box{Vec3(70.0, 50.0, 30.0)},
          Cylinder{35.0, 50.0, 6.0},
          Box{Vec3(70.0, 50.0, 30.0), 8.0},
          Plane{},
          Annulus{20.0, 45.0, 10.0, 3.0},
          Annulus{0.0, 45.0, 10.0, 4.0},
          make_profile({{0, 30, 0}, {40, 20, 5}, {25, 0, 3}, {40, -20, 0}, {0, -30, 0}})};
}

TEST(ToolShape, NormalIsGradient) {
  for (const ToolShape& shape : closed_forms()) {
    SCOPED_TRACE(shape.index());
    EXPECT_GT(testing::check_gradient(shape, space, 5000, 4), 4500);
  }
}

TEST(ToolShape, DistanceChangesNoFasterThanTheWay) {
  for (const ToolShape& shape : closed_forms()) {
    SCOPED_TRACE(shape.index());
    testing::check_lipschitz(shape, space, 10000, 5);
  }
}

TEST(ToolShape, CentresAxesCornersAndEdgesHaveUnitNormals) {
  for (const ToolShape& shape : closed_forms())
    for (const Vec3& p : {Vec3(0, 0, 0), Vec3(0, 0, 10), Vec3(0, 0, 25), Vec3(0, 0, -7),
                          Vec3(35, 0, 25), Vec3(35, 25, 15), Vec3(35, 10, 15), Vec3(-0.0, -0.0, 5),
                          Vec3(32.5, 0, 5), Vec3(40, 0, 0), Vec3(1e-300, 0, 0), Vec3(1e9, 0, 1)}) {
      const SurfacePoint at = ask(shape, p);
      EXPECT_TRUE(std::isfinite(at.distance)) << shape.index() << ": " << p.transpose();
      EXPECT_NEAR(at.normal.norm(), 1.0, 1e-12) << shape.index() << ": " << p.transpose();
    }
  EXPECT_EQ(ask(Sphere{40}, Vec3::Zero()).distance, -40.0);
  EXPECT_EQ(ask(Cylinder{35, 50}, Vec3::Zero()).distance, -25.0);
  EXPECT_EQ(ask(Cylinder{35, 50}, Vec3(35, 0, 25)).distance, 0.0);
  EXPECT_EQ(ask(Box{Vec3(70, 50, 30)}, Vec3(35, 25, 15)).distance, 0.0);
}

TEST(ToolShape, SmallestRadius) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(smallest_radius(Sphere{75}), 75.0);
  EXPECT_EQ(smallest_radius(Cylinder{75, 10}), 0.0);
  EXPECT_EQ(smallest_radius(Box{Vec3(1, 2, 3)}), 0.0);
  EXPECT_EQ(smallest_radius(Cylinder{75, 10, 2}), 2.0);
  EXPECT_EQ(smallest_radius(Cylinder{3, 10, 4}), 3.0); // no more than fits
  EXPECT_EQ(smallest_radius(Box{Vec3(10, 20, 30), 2}), 2.0);
  EXPECT_EQ(smallest_radius(Box{Vec3(10, 20, 30), 7}), 5.0); // no more than fits
  EXPECT_EQ(smallest_radius(Plane{}), infinity);
  EXPECT_EQ(smallest_radius(Annulus{92, 300, 10, 2}), 2.0);
  EXPECT_EQ(smallest_radius(Annulus{92, 300, 10, 0}), 0.0);
  EXPECT_EQ(smallest_radius(Annulus{92, 300, 3, 2}), 1.5); // no more than fits the thickness
}

} // namespace
} // namespace plyform::tool_shape_test
