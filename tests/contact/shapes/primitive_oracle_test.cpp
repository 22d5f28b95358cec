// SPDX-License-Identifier: GPL-3.0-or-later
// Distance and normal of ball, cylinder, box and plane against what FCL says of a small ball there
// (collide with contacts: depth and normal), at random points, near the surface, and on centres,
// axes, corners, edges, rims and faces, where a normal has to be one of several. FCL has no rounded
// edges: there it is asked about the shape that is smaller by the edge radius on every side, whose
// distance is larger by just that radius.
#include "contact/shapes/tool_shape.hpp"
#include "support/fcl_all.hpp"
#include "support/shape_checks.hpp"

#include <functional>
#include <gtest/gtest.h>

namespace plyform::primitive_oracle_test {
namespace {

using testing::ask;
using testing::RandomPoints;

constexpr double tolerance = 1e-11; // mm: rounding of depths of up to 100 mm, and of two roots

/// A shape, the same for FCL, and its support function: the largest n . y of its points y. FCL's
/// and the support function's are smaller than the shape by `rounding` on every side.
struct Primitive {
  const char* name;
  ToolShape shape;
  std::shared_ptr<fcl::CollisionGeometryd> geometry;
  std::function<double(const Vec3&)> support;
  std::vector<double> places; ///< mm, coordinates of what is special
  double rounding = 0.0;      ///< mm
};

std::vector<Primitive> primitives() {
  const double infinity = std::numeric_limits<double>::infinity();
  return {
      {"sphere",
       Sphere{40.0},
       std::make_shared<fcl::Sphered>(40.0),
       [](const Vec3& n) { return 40.0 * n.norm(); },
       {0.0, 24.0, 32.0, 40.0}}, // 24, 32, 0: on it
      {"cylinder",
       Cylinder{35.0, 50.0},
       std::make_shared<fcl::Cylinderd>(35.0, 50.0),
       [](const Vec3& n) { return 35.0 * n.head<2>().norm() + 25.0 * std::abs(n.z()); },
       {0.0, 10.0, 21.0, 25.0, 28.0, 35.0}}, // 21, 28: on the wall; 10: as far from lid and wall
      {"box",
       Box{Vec3(70.0, 50.0, 30.0)},
       std::make_shared<fcl::Boxd>(70.0, 50.0, 30.0),
       [](const Vec3& n) {
         return 35.0 * std::abs(n.x()) + 25.0 * std::abs(n.y()) + 15.0 * std::abs(n.z());
       },
       {0.0, 10.0, 15.0, 20.0, 25.0, 35.0}}, // 20, 10, 0: as far from three faces
      {"rounded cylinder",
       Cylinder{35.0, 50.0, 10.0},
       std::make_shared<fcl::Cylinderd>(25.0, 30.0),
       [](const Vec3& n) { return 25.0 * n.head<2>().norm() + 15.0 * std::abs(n.z()); },
       {0.0, 10.0, 15.0, 20.0, 21.0, 25.0, 28.0, 35.0}, // 15, 20, 25: where the rounding starts
       10.0},
      {"rounded box",
       Box{Vec3(70.0, 50.0, 30.0), 10.0},
       std::make_shared<fcl::Boxd>(50.0, 30.0, 10.0),
       [](const Vec3& n) {
         return 25.0 * std::abs(n.x()) + 15.0 * std::abs(n.y()) + 5.0 * std::abs(n.z());
       },
       {0.0, 5.0, 10.0, 15.0, 25.0, 35.0}, // 25, 15, 5: where the rounding starts
       10.0},
      {"plane",
       Plane{},
       std::make_shared<fcl::Halfspaced>(Vec3::UnitZ(), 0.0),
       [=](const Vec3& n) { return n == Vec3::UnitZ() ? 0.0 : infinity; },
       {0.0, 20.0}}};
}

/// What FCL says of a ball about p that reaches into FCL's shape: signed distance of p to the
/// rounded one, and normal.
SurfacePoint fcl_answer(const Primitive& primitive, const Vec3& p, double radius) {
  const fcl::Sphered ball(radius);
  fcl::CollisionRequestd request(1, true);
  fcl::CollisionResultd result;
  const fcl::Transform3d at(fcl::Translation3d{p});
  fcl::collide(primitive.geometry.get(), fcl::Transform3d::Identity(), &ball, at, request, result);
  if (result.numContacts() == 0) return {std::numeric_limits<double>::quiet_NaN(), Vec3::Zero()};
  const fcl::Contactd& contact = result.getContact(0);
  return {radius - contact.penetration_depth - primitive.rounding,
          contact.normal}; // from the first body to the second
}

/// Everything that must hold of an answer at p. Returns whether FCL's normal is the same.
bool expect_right(const Primitive& primitive, const Vec3& p) {
  const SurfacePoint mine = ask(primitive.shape, p);
  const double s = mine.distance;
  // any ball that touches tells the same distance: one that reaches in by 1 mm
  const double rounding = primitive.rounding;
  const SurfacePoint fcl = fcl_answer(primitive, p, std::max(0.0, s + rounding) + 1.0);
  EXPECT_NEAR(s, fcl.distance, tolerance) << primitive.name << " at " << p.transpose();
  EXPECT_NEAR(mine.normal.norm(), 1.0, 1e-14) << primitive.name << " at " << p.transpose();
  const Vec3 foot = p - s * mine.normal;
  // the foot is on the surface (FCL), and outside, no point of the solid lies beyond it along the
  // normal: then it is the closest point, and the normal one of those that its edge or corner has
  EXPECT_NEAR(fcl_answer(primitive, foot, 1.0 + rounding).distance, 0.0, tolerance)
      << primitive.name << " at " << p.transpose() << " normal " << mine.normal.transpose();
  if (s > -1e-12) {
    EXPECT_NEAR(mine.normal.dot(foot), primitive.support(mine.normal) + rounding, tolerance)
        << primitive.name << " at " << p.transpose() << " normal " << mine.normal.transpose();
  }
  // both are ways to a foot, FCL's on its smaller shape: rounded more the shorter they are
  return (mine.normal - fcl.normal).norm() < 1e-9 + 1e-13 / std::abs(s + rounding);
}

TEST(PrimitiveOracle, DistanceAndNormalAgreeWithFclAtRandomPoints) {
  const Box3 space(Vec3(-60, -60, -60), Vec3(60, 60, 60));
  constexpr int count = 100000;
  for (const Primitive& primitive : primitives()) {
    RandomPoints random(1);
    int same_normal = 0, outside = 0;
    for (int i = 0; i < count && !::testing::Test::HasFailure(); ++i) {
      Vec3 p = random.in(space);
      if (i % 2) { // every other point close to the surface
        const SurfacePoint far = ask(primitive.shape, p);
        p += (std::pow(10.0, random.in(-9, -1)) * (i % 4 == 1 ? 1.0 : -1.0) - far.distance) *
             far.normal;
      }
      same_normal += expect_right(primitive, p);
      outside += ask(primitive.shape, p).distance > 0.0;
    }
    EXPECT_GT(same_normal, count - count / 100) << primitive.name; // all but next to a medial axis
    EXPECT_GT(outside, count / 4) << primitive.name;
    EXPECT_LT(outside, count - count / 20) << primitive.name;
  }
}

TEST(PrimitiveOracle, CentresAxesCornersEdgesRimsAndFacesAgreeWithFcl) {
  for (const Primitive& primitive : primitives()) {
    std::vector<double> places;
    for (const double at : primitive.places)
      for (const double off : {0.0, 1e-300, 1e-15, 1e-9, 1e-3, -1e-9, -1e-3})
        places.insert(places.end(), {at + off, -at - off});
    int points = 0, touching = 0;
    for (const double x : places)
      for (const double y : places)
        for (const double z : places) {
          if (::testing::Test::HasFailure()) return;
          if (points++ % 5) continue; // one in five of them all
          expect_right(primitive, Vec3(x, y, z));
          touching += std::abs(ask(primitive.shape, Vec3(x, y, z)).distance) < 1e-12;
        }
    EXPECT_GT(touching, 100) << primitive.name;
  }
}

} // namespace
} // namespace plyform::primitive_oracle_test
