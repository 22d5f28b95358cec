// SPDX-License-Identifier: GPL-3.0-or-later
// Cones, tori and extrusions against closed forms that share no code with them.
#include "contact/shapes/tool_shape.hpp"
#include "support/shape_checks.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <stdexcept>
#include <string>

namespace plyform::profile_shapes_test {
namespace {

using testing::ask;
using testing::RandomPoints;
using Kind = ProfileSegment::Kind;

const Box3 space(Vec3(-60, -60, -60), Vec3(60, 60, 60));
constexpr double rounding = 1e-12; // mm: a few ulp of 60 mm
constexpr int many = 20000;

TEST(ProfileShapes, TorusIsACircleAboutACircle) {
  const ToolShape torus = make_torus(40.0, 12.0);
  RandomPoints random(1);
  for (int i = 0; i < many; ++i) {
    const Vec3 p = random.in(space);
    const double exact = std::hypot(std::hypot(p.x(), p.y()) - 40.0, p.z()) - 12.0;
    ASSERT_NEAR(ask(torus, p).distance, exact, rounding) << p.transpose();
  }
}

double to_segment(const Vec2& q, const Vec2& a, const Vec2& b) {
  const Vec2 ab = b - a;
  const double s = std::clamp(ab.dot(q - a) / ab.squaredNorm(), 0.0, 1.0);
  return (q - a - s * ab).norm();
}

/// A cone of radii r0 at z = low and r1 at z = high: in the section, the largest distance to its
/// three sides inside, the smallest to their segments outside.
double sharp_cone(double r0, double r1, double low, double high, const Vec3& p) {
  const Vec2 q(std::hypot(p.x(), p.y()), p.z());
  const Vec2 along = Vec2(r1 - r0, high - low).normalized();
  const double flank = along.y() * (q.x() - r0) - along.x() * (q.y() - low);
  const double deepest = std::max({flank, low - q.y(), q.y() - high});
  if (deepest <= 0.0) return deepest;
  return std::min({to_segment(q, {0.0, low}, {r0, low}), to_segment(q, {r0, low}, {r1, high}),
                   to_segment(q, {r1, high + 1e-300}, {0.0, high})});
}

struct ConeCase {
  double radius, top, length, edge;
};

/// A rounded cone is all within `edge` of the cone whose faces lie deeper by `edge`.
TEST(ProfileShapes, ConeIsTheOffsetOfASmallerOne) {
  for (const ConeCase& c :
       {ConeCase{40, 20, 50, 0}, ConeCase{40, 20, 50, 6}, ConeCase{15, 40, 50, 5},
        ConeCase{30, 0, 60, 0}, ConeCase{30, 0, 60, 7}, ConeCase{50, 0, 20, 3}}) {
    SCOPED_TRACE(::testing::Message() << c.radius << " " << c.top << " " << c.edge);
    const ToolShape cone = make_cone(c.radius, c.top, c.length, c.edge);
    const double slope = (c.top - c.radius) / c.length, h = 0.5 * c.length;
    const double inwards = c.edge * std::hypot(c.radius - c.top, c.length) / c.length; // along r
    const double low = -h + c.edge;
    double high = h - c.edge, r1 = c.radius + slope * (high + h) - inwards;
    const double r0 = c.radius + slope * (low + h) - inwards;
    if (c.top == 0.0) high = low - r0 / slope, r1 = 0.0; // the tip of the smaller one
    RandomPoints random(2);
    for (int i = 0; i < many; ++i) {
      const Vec3 p = random.in(space);
      ASSERT_NEAR(ask(cone, p).distance, sharp_cone(r0, r1, low, high, p) - c.edge, 1e-11)
          << p.transpose();
    }
  }
}

TEST(ProfileShapes, ConeTakesTheLargestRoundingThatFits) {
  // On 45 degrees: base and flank share the corner's tan(67.5 degrees).
  const double most = 30.0 * std::tan(M_PI / 8.0);
  EXPECT_NO_THROW(make_cone(30, 20, 10,
                            0.999 * 10.0 * std::sqrt(2.0) /
                                (std::tan(M_PI / 8.0) + 1.0 / std::tan(M_PI / 8.0))));
  EXPECT_NO_THROW(make_cone(30, 0, 30, 0.999 * most));
  try {
    make_cone(30, 0, 30, 1.001 * most);
    ADD_FAILURE() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("must be at most 12.42"), std::string::npos)
        << error.what();
  }
}

TEST(ProfileShapes, ExtrudedRectangleIsABox) {
  const ToolShape box = Box{Vec3(70.0, 50.0, 30.0)};
  const ToolShape prism = ExtrudedProfile{
      round_corners(
          {{0, 15, 0}, {35, 15, 0}, {35, -15, 0}, {-35, -15, 0}, {-35, 15, 0}, {0, 15, 0}}, false,
          {"", "", ""}),
      50.0};
  RandomPoints random(3);
  for (int i = 0; i < many; ++i) {
    const Vec3 p = random.in(space);
    const SurfacePoint a = ask(box, p), b = ask(prism, p);
    ASSERT_NEAR(a.distance, b.distance, rounding) << p.transpose();
    if (a.distance > 0.0) { // inside, on the medial axis, there are several
      ASSERT_NEAR((a.normal - b.normal).norm(), 0.0, 1e-9) << p.transpose();
    }
  }
}

TEST(ProfileShapes, ExtrudedCircleIsACylinder) {
  const ToolShape cylinder = Cylinder{20.0, 50.0};
  const ToolShape rod = ExtrudedProfile{{{Kind::arc, {20, 0}, {20, 0}, {0, 0}, -1}}, 50.0};
  RandomPoints random(4);
  for (int i = 0; i < many; ++i) {
    const Vec3 p = random.in(space);
    ASSERT_NEAR(ask(rod, p).distance, ask(cylinder, Vec3(p.x(), p.z(), p.y())).distance, rounding);
  }
}

Profile channel(bool closed) {
  std::vector<std::array<double, 3>> points{{-50, 0, 0},  {-20, 0, 6}, {-20, -30, 8},
                                            {20, -30, 8}, {20, 0, 6},  {50, 0, 0}};
  if (closed) points.insert(points.end(), {{50, -45, 0}, {-50, -45, 0}, {-50, 0, 0}});
  return round_corners(points, false, {"", "", ""});
}

/// The open channel and the solid one have the same upper side.
TEST(ProfileShapes, OpenAndClosedChannelAgreeAbove) {
  const ToolShape open = ExtrudedProfile{channel(false), 400.0};
  const ToolShape closed = ExtrudedProfile{channel(true), 400.0};
  RandomPoints random(5);
  for (int i = 0; i < many; ++i) {
    const Vec3 p = random.in(Box3(Vec3(-45, -60, -33), Vec3(45, 60, 20)));
    if (ask(closed, p).distance < -4.0) continue; // its outer walls are nearer
    ASSERT_NEAR(ask(open, p).distance, ask(closed, p).distance, rounding) << p.transpose();
  }
  EXPECT_NEAR(ask(open, Vec3(0, 0, -20)).distance, 10.0, rounding);
  EXPECT_NEAR(ask(open, Vec3(0, 200, -40)).distance, 0.0, rounding); // on an end
  EXPECT_NEAR(ask(open, Vec3(0, 203, -26)).distance, 5.0, rounding); // 4 above, 3 beyond
}

TEST(ProfileShapes, NormalIsGradientAndDistanceNoFasterThanTheWay) {
  for (const ToolShape& shape :
       {ToolShape(make_torus(40, 12)), ToolShape(make_cone(40, 20, 50, 6)),
        ToolShape(make_cone(30, 0, 60, 7)), ToolShape(ExtrudedProfile{channel(false), 60.0}),
        ToolShape(ExtrudedProfile{channel(true), 60.0})}) {
    EXPECT_GT(testing::check_gradient(shape, space, 5000, 6), 4500);
    testing::check_lipschitz(shape, space, 10000, 7);
  }
}

TEST(ProfileShapes, SmallestRadius) {
  EXPECT_EQ(smallest_radius(make_torus(40, 12)), 12.0);
  EXPECT_EQ(smallest_radius(make_cone(40, 20, 50, 0)), 0.0);
  EXPECT_NEAR(smallest_radius(make_cone(40, 20, 50, 6)), 6.0, rounding);
  EXPECT_NEAR(smallest_radius(make_cone(30, 0, 60, 7)), 7.0, rounding);
  EXPECT_NEAR(smallest_radius(ExtrudedProfile{channel(false), 60.0}), 6.0, rounding);
  EXPECT_EQ(smallest_radius(ExtrudedProfile{channel(true), 60.0}), 0.0); // its outer corners
}

TEST(ProfileShapes, ClosedChainsRoundEveryCorner) {
  const Profile rim =
      round_corners({{0, 0, 2}, {20, 0, 2}, {20, 10, 2}, {0, 10, 2}}, true, {"point", "x", "y"});
  ASSERT_EQ(rim.size(), 8u);
  for (std::size_t i = 0; i < rim.size(); ++i)
    EXPECT_TRUE(rim[i].b == rim[(i + 1) % rim.size()].a) << i;
  const auto rejected = [](const std::vector<std::array<double, 3>>& points, const char* reason) {
    try {
      round_corners(points, true, {"point", "x", "y"});
      ADD_FAILURE() << "accepted, expected: " << reason;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
    }
  };
  rejected({{0, 0, 0}, {1, 0, 0}}, "at least 3 points are needed, got 2");
  rejected({{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 0, 0}}, "point 0 (x = 0, y = 0) repeats");
  rejected({{0, 0, 6}, {20, 0, 0}, {20, 10, 0}, {0, 10, 6}}, "from point 3 to point 0 take 12 mm");
}

} // namespace
} // namespace plyform::profile_shapes_test
