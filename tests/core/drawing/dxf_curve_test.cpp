// SPDX-License-Identifier: GPL-3.0-or-later
// Ellipses and splines of drawings against their equations. Files of them, as ezdxf writes them:
// tests/python/drawing_test.py.
#include "core/drawing/dxf_curve.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace plyform::dxf_curve_test {
namespace {

constexpr double pi = std::numbers::pi, infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t many = 10000;

double longest(const Profile& chain) {
  double most = 0.0;
  for (const ProfileSegment& s : chain)
    most = std::max(most, (s.b - s.a).norm());
  return most;
}

double area_of(const Profile& ring) {
  double twice = 0.0;
  for (const ProfileSegment& s : ring)
    twice += s.a.x() * s.b.y() - s.a.y() * s.b.x();
  return 0.5 * twice;
}

bool has_point(const Profile& chain, const Vec2& p) {
  return std::any_of(chain.begin(), chain.end(), [&](const ProfileSegment& s) {
    return (s.a - p).norm() < 1e-9 || (s.b - p).norm() < 1e-9;
  });
}

/// Largest turn from one piece to the next, rad.
double largest_turn(const Profile& chain) {
  double most = 0.0;
  for (std::size_t i = 1; i < chain.size(); ++i) {
    const Vec2 a = chain[i - 1].b - chain[i - 1].a, b = chain[i].b - chain[i].a;
    most = std::max(most, std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b))));
  }
  return most;
}

TEST(DxfCurve, WholeEllipseHasItsPointsOnItAndClosesExactly) {
  const DxfEllipse e{{10.0, -5.0}, {60.0, 80.0}, 0.3, 0.0, 2.0 * pi};
  for (const double spacing : {40.0, 10.0, 2.5}) {
    const Profile ring = divided(curve_of(e), spacing, many);
    EXPECT_EQ(ring.front().a, ring.back().b);
    const Vec2 u = e.major.normalized(), v(-u.y(), u.x());
    for (const ProfileSegment& s : ring) {
      const Vec2 p = s.a - e.centre;
      EXPECT_NEAR(std::hypot(p.dot(u) / 100.0, p.dot(v) / 30.0), 1.0, 1e-12);
    }
    EXPECT_LE(longest(ring), spacing);
    // chords of length h lack less than h^2/(12 r) of the area at each place: 2/3 of the sagitta
    const double area = pi * 100.0 * 30.0;
    EXPECT_LT(area_of(ring), area);
    EXPECT_GT(area_of(ring), area - 2.0 * pi * spacing * spacing / 12.0);
  }
  const Profile coarse = divided(curve_of(e), infinity, many);
  EXPECT_GE(coarse.size(), 8u);                     // an eighth of a turn each
  EXPECT_LE(largest_turn(coarse), 0.25 * pi * 1.5); // between the middles of two pieces
}

TEST(DxfCurve, ArcOfAnEllipseGoesFromItsFirstToItsSecondParameter) {
  DxfEllipse e{{0.0, 0.0}, {50.0, 0.0}, 0.4, 1.5 * pi, 0.5 * pi}; // through the end of the axis
  const Profile right = divided(curve_of(e), 1.0, many);
  EXPECT_NEAR((right.front().a - Vec2(0.0, -20.0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((right.back().b - Vec2(0.0, 20.0)).norm(), 0.0, 1e-9);
  double most = 0.0;
  for (const ProfileSegment& s : right)
    most = std::max(most, s.a.x());
  EXPECT_NEAR(most, 50.0, 0.01);
  e.from_below = true; // the other way round
  EXPECT_NEAR((divided(curve_of(e), 1.0, many).front().a - Vec2(0.0, 20.0)).norm(), 0.0, 1e-9);
}

TEST(DxfCurve, CubicSplineOfOneSpanIsBeziersCurve) {
  const Vec2 p[] = {{0, 0}, {10, 40}, {60, -20}, {80, 30}};
  DxfSpline s{3, {0, 0, 0, 0, 2, 2, 2, 2}, {}};
  for (const Vec2& x : p)
    s.points.emplace_back(x.x(), x.y(), 1.0);
  ASSERT_EQ(fault_of(s), "");
  const DxfCurve curve = curve_of(s);
  for (const double t : {0.0, 0.1, 0.5, 0.9, 1.0}) {
    const double r = 1.0 - t;
    const Vec2 wanted =
        r * r * r * p[0] + 3 * r * r * t * p[1] + 3 * r * t * t * p[2] + t * t * t * p[3];
    EXPECT_NEAR((curve.at(2.0 * t) - wanted).norm(), 0.0, 1e-12) << t;
  }
}

TEST(DxfCurve, SplineWithWeightsIsACircle) {
  // nine points, degree 2, four quarters of a circle of 30 mm: weights of cos 45 at the corners
  DxfSpline s{2, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}, {}};
  const Vec2 corners[] = {{1, 0},   {1, 1},  {0, 1},  {-1, 1}, {-1, 0},
                          {-1, -1}, {0, -1}, {1, -1}, {1, 0}};
  for (std::size_t i = 0; i < 9; ++i) {
    const double w = i % 2 == 0 ? 1.0 : M_SQRT1_2;
    s.points.emplace_back(30.0 * w * corners[i].x(), 30.0 * w * corners[i].y(), w);
  }
  ASSERT_EQ(fault_of(s), "");
  const Profile ring = divided(curve_of(s), 5.0, many);
  EXPECT_EQ(ring.front().a, ring.back().b);
  for (const ProfileSegment& x : ring)
    EXPECT_NEAR(x.a.norm(), 30.0, 1e-12);
  EXPECT_LE(longest(ring), 5.0);
  EXPECT_GT(longest(ring), 4.0);
}

TEST(DxfCurve, CornersOfASplineArePoints) {
  // two straight pieces of degree 3 that meet in a corner, by a knot of three
  DxfSpline s{3, {0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 2}, {}};
  for (const Vec2& x : {Vec2(0, 0), Vec2(10, 0), Vec2(20, 0), Vec2(31, 0), Vec2(31, 10),
                        Vec2(31, 20), Vec2(31, 33)})
    s.points.emplace_back(x.x(), x.y(), 1.0);
  ASSERT_EQ(fault_of(s), "");
  EXPECT_TRUE(has_point(divided(curve_of(s), 7.0, many), {31.0, 0.0}));
  // of degree 1 every control point is a corner
  const DxfSpline line{1, {0, 0, 1, 2, 2}, {{0, 0, 1}, {10, 5, 1}, {20, 0, 1}}};
  ASSERT_EQ(fault_of(line), "");
  EXPECT_EQ(divided(curve_of(line), infinity, many).size(), 2u);
}

TEST(DxfCurve, FaultsAreNamed) {
  const std::vector<Vec3> four{{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  const auto says = [](const std::string& fault, const char* part) {
    return fault.find(part) != std::string::npos;
  };
  EXPECT_TRUE(says(fault_of(DxfSpline{3, {}, {}}), "no control points"));
  EXPECT_TRUE(says(fault_of(DxfSpline{3, {0, 0, 0, 1, 1, 1, 1}, four}), "7 knots"));
  EXPECT_TRUE(says(fault_of(DxfSpline{0, {0, 1, 2, 3, 4}, four}), "degree 0"));
  EXPECT_TRUE(says(fault_of(DxfSpline{3, {0, 0, 0, 1, 0, 1, 1, 1}, four}), "do not ascend"));
  EXPECT_TRUE(says(fault_of(DxfSpline{3, {0, 0, 0, 0, 0, 0, 0, 0}, four}), "do not ascend"));
  std::vector<Vec3> weightless = four;
  weightless[1].z() = 0.0;
  EXPECT_TRUE(says(fault_of(DxfSpline{3, {0, 0, 0, 0, 1, 1, 1, 1}, weightless}), "weight"));
  EXPECT_TRUE(says(fault_of(DxfEllipse{{0, 0}, {0, 0}, 0.5, 0, 6}), "no length"));
  EXPECT_TRUE(says(fault_of(DxfEllipse{{0, 0}, {1, 0}, 0.0, 0, 6}), "ratio"));
}

TEST(DxfCurve, FinerThanManyPiecesIsCutOff) {
  const DxfEllipse e{{0, 0}, {100.0, 0.0}, 0.5, 0.0, 2.0 * pi};
  EXPECT_EQ(divided(curve_of(e), 1e-9, 500).size(), 500u);
}

/// Points of a circle, each once.
std::vector<Vec3> eight_points() {
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i)
    points.emplace_back(150.0 * std::cos(0.25 * std::numbers::pi * i),
                        150.0 * std::sin(0.25 * std::numbers::pi * i), 1.0);
  return points;
}

TEST(DxfCurve, AClosedSplineWhosePointsAreNotRepeatedGoesRound) {
  DxfSpline s{3, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}, eight_points(), true};
  const DxfCurve curve = curve_of(s);
  EXPECT_TRUE(curve.closed);
  // the uniform cubic spline over the points of a regular polygon has its symmetry
  const double radius = curve.at(3.0).norm();
  EXPECT_NEAR(radius, 150.0 * (4.0 + 2.0 * std::cos(0.25 * std::numbers::pi)) / 6.0, 1e-9);
  for (int i = 0; i <= 8; ++i)
    EXPECT_NEAR(curve.at(3.0 + i).norm(), radius, 1e-9) << i;
  EXPECT_LT((curve.at(11.0) - curve.at(3.0)).norm(), 1e-9);
  // the same curve with points and knots repeated, as others write it
  DxfSpline repeated = s;
  for (int i = 0; i < 3; ++i) {
    repeated.points.push_back(s.points[static_cast<std::size_t>(i)]);
    repeated.knots.push_back(12.0 + i);
  }
  for (const bool marked : {false, true}) {
    repeated.closed = marked;
    EXPECT_TRUE(curve_of(repeated).closed);
    EXPECT_EQ(curve_of(repeated).at(5.3), curve.at(5.3));
  }
  s.knots = repeated.knots; // all knots, the points once
  EXPECT_EQ(curve_of(s).at(5.3), curve.at(5.3));
}

TEST(DxfCurve, AFlagAloneClosesNoSpline) {
  DxfSpline s{3, {0, 0, 0, 0, 1, 2, 3, 4, 5, 5, 5, 5}, eight_points(), true};
  EXPECT_FALSE(curve_of(s).closed);
  EXPECT_EQ(curve_of(s).at(0.0), Vec2(150.0, 0.0));
  s.knots = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  s.closed = false;
  EXPECT_FALSE(curve_of(s).closed);
}

} // namespace
} // namespace plyform::dxf_curve_test
