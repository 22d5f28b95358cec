// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces of revolution against dense sampling, winding numbers and values worked out by hand.
#include "contact/shapes/profile.hpp"
#include "support/shape_checks.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

namespace plyform::profile_test {
namespace {

using testing::ask;
using testing::RandomPoints;
using Kind = ProfileSegment::Kind;
using Points = std::vector<std::array<double, 3>>;
constexpr double pi = std::numbers::pi;

RevolvedProfile die() {
  return make_profile({{80, -120, 0}, {80, 0, 10}, {400, 0, 0}});
}

/// Points of the profile `spacing` apart, by angles (the code under test uses none).
std::vector<Vec2> sampled(const RevolvedProfile& profile, double spacing) {
  std::vector<Vec2> points;
  for (const ProfileSegment& s : profile.segments) {
    if (s.kind == Kind::line) {
      const int n = int(std::ceil((s.b - s.a).norm() / spacing));
      for (int i = 0; i < n; ++i)
        points.push_back(s.a + (s.b - s.a) * i / n);
      continue;
    }
    const double radius = (s.a - s.centre).norm();
    const double from = std::atan2(s.a.y() - s.centre.y(), s.a.x() - s.centre.x());
    double to = std::atan2(s.b.y() - s.centre.y(), s.b.x() - s.centre.x());
    while (s.turn * (to - from) <= 1e-12)
      to += s.turn * 2.0 * pi;
    const int n = int(std::ceil(std::abs(to - from) * radius / spacing));
    for (int i = 0; i < n; ++i) {
      const double t = from + (to - from) * i / n;
      points.push_back(s.centre + radius * Vec2(std::cos(t), std::sin(t)));
    }
  }
  points.push_back(profile.segments.back().b);
  return points;
}

double sampled_distance(const std::vector<Vec2>& points, const Vec2& q) {
  double best = std::numeric_limits<double>::infinity();
  for (const Vec2& p : points)
    best = std::min(best, (p - q).squaredNorm());
  return std::sqrt(best);
}

/// Turns of the chain, closed by its mirror image or by itself, about q.
bool inside(std::vector<Vec2> chain, bool ring, const Vec2& q) {
  if (!ring)
    for (std::size_t i = chain.size(); i-- > 0;)
      chain.emplace_back(-chain[i].x(), chain[i].y());
  double angle = 0.0;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const Vec2 u = chain[i] - q, v = chain[(i + 1) % chain.size()] - q;
    angle += std::atan2(u.x() * v.y() - u.y() * v.x(), u.dot(v));
  }
  return std::abs(angle) > pi;
}

void expect_sampling_agrees(const RevolvedProfile& profile, const Box3& box, int count) {
  constexpr double spacing = 0.02;
  const std::vector<Vec2> points = sampled(profile, spacing);
  const std::vector<Vec2> outline =
      sampled(profile, 0.1); // within 1e-3 mm of arcs of radius > 1 mm
  const bool closed = is_closed(profile);
  RandomPoints random(1);
  for (int i = 0; i < count; ++i) {
    const Vec3 p = random.in(box);
    const Vec2 q(p.head<2>().norm(), p.z());
    const double s = ask(profile, p).distance, near = sampled_distance(points, q);
    // The nearest sample lies within spacing/2 of the closest point; near it the way is longer by
    // less than that.
    ASSERT_TRUE(std::abs(s) <= near + 1e-10 && std::abs(s) >= near - 0.5 * spacing)
        << q.transpose() << " s = " << s << " sampled " << near;
    if (closed && std::abs(s) > 2e-3) {
      ASSERT_EQ(s < 0.0, inside(outline, is_ring(profile.segments), q))
          << q.transpose() << " s = " << s;
    }
  }
}

struct Named {
  const char* name;
  RevolvedProfile profile;
};

/// Sharp, blunt, concave, rounded, with arcs of more than half a turn, with tips on the axis.
std::vector<Named> closed_profiles() {
  const RevolvedProfile keyhole{{{Kind::arc, {18, -4}, {18, 4}, {15, 0}, -1}, // 286 degrees
                                 {Kind::line, {18, 4}, {30, 4}},
                                 {Kind::line, {30, 4}, {30, -4}},
                                 {Kind::line, {30, -4}, {18, -4}}}};
  return {
      {"double cone", make_profile({{0, 20, 0}, {15, 0, 0}, {0, -20, 0}})},
      {"star",
       make_profile({{0, 25, 0}, {6, 6, 0}, {28, 4, 0}, {8, -3, 0}, {25, -20, 0}, {0, -8, 0}})},
      {"rounded star",
       make_profile({{0, 25, 0}, {6, 6, 2}, {28, 4, 1}, {8, -3, 3}, {25, -20, 1.5}, {0, -8, 0}})},
      {"hourglass", make_profile({{0, 20, 0}, {20, 20, 4}, {2, 0, 1}, {20, -20, 4}, {0, -20, 0}})},
      {"ball", {{{Kind::arc, {0, 20}, {0, -20}, {0, 0}, -1}}}},
      {"torus", {{{Kind::arc, {25, 0}, {25, 0}, {17, 0}, -1}}}},
      {"keyhole", keyhole},
      {"ring", make_profile({{10, 5, 0}, {20, 8, 2}, {25, 0, 0}, {9, -7, 1}, {10, 5, 0}})}};
}

const Box3 around(Vec3(-35, -35, -35), Vec3(35, 35, 35));

TEST(Profile, ClosedProfilesAgreeWithSamplingAndWindingNumbers) {
  for (const auto& [name, profile] : closed_profiles()) {
    SCOPED_TRACE(name);
    ASSERT_TRUE(is_closed(profile));
    expect_sampling_agrees(profile, around, 2000);
  }
}

TEST(Profile, NormalIsGradient) {
  for (const auto& [name, profile] : closed_profiles()) {
    SCOPED_TRACE(name);
    EXPECT_GT(testing::check_gradient(profile, around, 5000, 2), 4500);
  }
}

TEST(Profile, DistanceChangesNoFasterThanTheWay) {
  for (const auto& [name, profile] : closed_profiles()) {
    SCOPED_TRACE(name);
    testing::check_lipschitz(profile, around, 10000, 3);
  }
}

TEST(Profile, DieAgreesWithSampling) {
  expect_sampling_agrees(die(), Box3(Vec3(-300, -300, -110), Vec3(300, 300, 100)), 500);
}

TEST(Profile, DieIsMadeOfWallFilletAndFlat) {
  const auto s = die().segments;
  ASSERT_EQ(s.size(), 3u);
  EXPECT_TRUE(s[0].a == Vec2(80, -120) && s[2].b == Vec2(400, 0));
  EXPECT_TRUE(s[0].b.isApprox(Vec2(80, -10)) && s[1].a == s[0].b);
  EXPECT_TRUE(s[1].b.isApprox(Vec2(90, 1e-300)) && s[2].a == s[1].b);
  EXPECT_TRUE(s[1].centre.isApprox(Vec2(90, -10)));
  EXPECT_EQ(s[1].turn, -1);
  EXPECT_NEAR(sweep(s[1]), pi / 2, 1e-14);
  EXPECT_NEAR(smallest_radius(die()), 10.0, 1e-12);
}

TEST(Profile, DieGivesTheDistancesWorkedOutByHand) {
  const ToolShape shape = die();
  const double d = std::sqrt(0.5);
  const auto expect = [&](const Vec3& p, double s, const Vec3& n) {
    const SurfacePoint at = ask(shape, p);
    EXPECT_NEAR(at.distance, s, 1e-12) << p.transpose(); // a few ulp of 100 mm
    EXPECT_TRUE((at.normal - n).norm() < 1e-12) << p.transpose() << ": " << at.normal.transpose();
  };
  expect({200, 0, 3}, 3, {0, 0, 1});                        // above the flat
  expect({0, 200, -3}, -3, {0, 0, 1});                      // in the material under it
  expect({75, 0, -50}, 5, {-1, 0, 0});                      // in the hole, from the wall
  expect({0, -82, -50}, -2, {0, 1, 0});                     // in the wall
  expect({90 - 12 * d, 0, -10 + 12 * d}, 2, {-d, 0, d});    // off the fillet
  expect({90 - 7 * d, 0, -10 + 7 * d}, -3, {-d, 0, d});     // under its skin
  expect({80, 0, 0}, 10 * std::sqrt(2.0) - 10, {-d, 0, d}); // the corner that was cut off
  expect({80, 0, -10}, 0, {-1, 0, 0});                      // where wall and fillet meet
  expect({90, 0, 0}, 0, {0, 0, 1});
  expect({400, 0, 0}, 0, {0, 0, 1});     // its outer end
  expect({403, 0, 4}, 5, {0.6, 0, 0.8}); // past it: free above, material below
  expect({403, 0, -4}, -5, {-0.6, 0, 0.8});
  expect({77, 0, -124}, 5, {-0.6, 0, -0.8}); // past the lower end: free towards the axis
}

TEST(Profile, PointsNextToSharedVerticesGetTheRightSide) {
  // Random walls meeting at (20, 0): the right answer is the side of the bisecting normal cone.
  RandomPoints random(5);
  for (int i = 0; i < 10000; ++i) {
    const double in = random.in(-pi, pi), turn = random.in(-3.1, 3.1);
    const Vec2 u(std::cos(in), std::sin(in)), v(std::cos(in + turn), std::sin(in + turn));
    const Vec2 corner(20, 0);
    const RevolvedProfile walls{
        {{Kind::line, corner - 10 * u, corner}, {Kind::line, corner, corner + 10 * v}}};
    const double at = random.in(-pi, pi), size = std::pow(10.0, random.in(-8, 0));
    const Vec2 d = size * Vec2(std::cos(at), std::sin(at));
    // Free is left of both walls at a left turn, left of either at a right turn.
    const bool left_u = u.x() * d.y() - u.y() * d.x() > 0,
               left_v = v.x() * d.y() - v.y() * d.x() > 0;
    const bool is_free = turn > 0 ? left_u && left_v : left_u || left_v;
    const Vec2 q = corner + d;
    const double s = section_distance(walls.segments, q).distance;
    if (std::abs(s) < 1e-12) continue; // on a wall
    ASSERT_EQ(s > 0, is_free) << "in " << in << " turn " << turn << " d " << d.transpose() << " s "
                              << s;
  }
}

TEST(Profile, SmallestRadiusSeesArcsSharpEdgesAndTips) {
  EXPECT_EQ(smallest_radius(make_profile({{80, -120, 0}, {80, 0, 0}, {400, 0, 0}})), 0.0);
  EXPECT_EQ(smallest_radius(make_profile({{0, 20, 0}, {30, 0, 0}})), 0.0); // a cone's tip
  EXPECT_EQ(smallest_radius(make_profile({{30, 0, 0}, {0, -20, 0}})), 0.0);
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(smallest_radius(make_profile({{0, 0, 0}, {30, 20, 0}})), infinity); // a funnel
  EXPECT_EQ(smallest_radius(make_profile({{0, 0, 0}, {30, 0, 0}, {40, 20, 0}})), infinity);
  EXPECT_NEAR(smallest_radius(make_profile({{0, 0, 0}, {30, 0, 4}, {30, 20, 0}})), 4.0, 1e-12);
}

TEST(Profile, FilletsThatShareASideMeetInOnePoint) {
  const auto s = make_profile({{10, 0, 0}, {10, 10, 5}, {20, 10, 5}, {20, 0, 0}}).segments;
  ASSERT_EQ(s.size(), 4u);
  for (std::size_t i = 0; i + 1 < s.size(); ++i)
    EXPECT_TRUE(s[i].b == s[i + 1].a) << i;
}

TEST(Profile, AFilletOnAStraightLineChangesNothing) {
  const RevolvedProfile profile = make_profile({{10, 0, 0}, {20, 0, 5}, {30, 0, 0}});
  for (const ProfileSegment& s : profile.segments)
    EXPECT_EQ(s.kind, Kind::line);
}

void expect_rejected(const Points& points, const std::string& reason) {
  try {
    make_profile(points);
    ADD_FAILURE() << "accepted, expected: " << reason;
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
  }
}

TEST(Profile, MistakesAreRejectedWithPointAndReason) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_rejected({{10, 0, 0}}, "at least 2 points are needed, got 1");
  expect_rejected({{10, 0, 0}, {-1, 5, 0}},
                  "profile point 1 (r = -1, z = 5): r must be at least 0");
  expect_rejected({{10, 0, 0}, {10, 0, 0}, {20, 0, 0}}, "profile point 1 (r = 10, z = 0) repeats");
  expect_rejected({{10, 0, 0}, {10, 10, -1}, {20, 10, 0}}, "fillet radius -1 must be at least 0");
  expect_rejected({{10, 0, 2}, {10, 10, 0}}, "no corner for its fillet radius 2");
  expect_rejected({{10, 0, 0}, {10, 10, 11}, {40, 10, 0}},
                  "profile point 1 (r = 10, z = 10): its fillet radius 11 does not fit");
  expect_rejected({{10, 0, 0}, {10, 10, 3}, {16, 10, 4}, {16, 0, 0}},
                  "point 2 take 7 mm of its 6 mm");
  expect_rejected({{10, 0, 0}, {10, 10, 3}, {10, 2, 0}}, "turns straight back");
  expect_rejected({{10, nan, 0}, {10, 10, 0}}, "finite");
}

} // namespace
} // namespace plyform::profile_test
