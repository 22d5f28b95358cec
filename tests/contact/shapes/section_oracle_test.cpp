// SPDX-License-Identifier: GPL-3.0-or-later
// Distance and normal of profiles and rings against brute force over their section: every piece by
// angles (the code under test uses none), the side by counting crossings of a ray.
#include "contact/shapes/profile.hpp"
#include "support/shape_checks.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace plyform::section_oracle_test {
namespace {

using testing::ask;
using testing::RandomPoints;
using Kind = ProfileSegment::Kind;
constexpr double pi = std::numbers::pi;
constexpr double tolerance = 1e-10; // mm: angles of 1e-15 at 60 mm, and roots of small squares

double angle_of(const Vec2& v) {
  return std::atan2(v.y(), v.x());
}

/// Angles of an arc: from, and the signed way to its end.
std::pair<double, double> arc_angles(const ProfileSegment& s) {
  const double from = angle_of(s.a - s.centre);
  double way = s.turn * (angle_of(s.b - s.centre) - from);
  while (way <= 1e-14)
    way += 2.0 * pi;
  return {from, s.turn * way};
}

Vec2 closest_on(const ProfileSegment& s, const Vec2& q) {
  if (s.kind == Kind::line) {
    const double length = (s.b - s.a).norm();
    const Vec2 e = (s.b - s.a) / length;
    return s.a + std::clamp(e.dot(q - s.a), 0.0, length) * e;
  }
  const auto [from, way] = arc_angles(s);
  double along = (angle_of(q - s.centre) - from) / (way < 0.0 ? -1.0 : 1.0);
  along -= 2.0 * pi * std::floor(along / (2.0 * pi));
  if (along <= std::abs(way) && q != s.centre) {
    const double at = angle_of(q - s.centre);
    return s.centre + (s.a - s.centre).norm() * Vec2(std::cos(at), std::sin(at));
  }
  return (q - s.a).norm() <= (q - s.b).norm() ? s.a : s.b;
}

/// Crossings of the ray from q towards larger r with a piece that only rises or only falls.
template <class R>
bool crosses(const Vec2& a, const Vec2& b, const Vec2& q, const R& r) {
  return (a.y() <= q.y()) != (b.y() <= q.y()) && r() > q.x();
}

int crossings(const ProfileSegment& s, const Vec2& q) {
  if (s.kind == Kind::line)
    return crosses(s.a, s.b, q, [&] {
      return s.a.x() + (q.y() - s.a.y()) / (s.b.y() - s.a.y()) * (s.b.x() - s.a.x());
    });
  const auto [from, way] = arc_angles(s);
  const double radius = (s.a - s.centre).norm(), step = way < 0.0 ? -1.0 : 1.0;
  int count = 0;
  // cut where it turns from rising to falling: at +-90 degrees
  double at = from;
  Vec2 a = s.a;
  for (bool last = false; !last;) {
    double next = step > 0.0 ? pi / 2 + pi * (std::floor((at - pi / 2) / pi + 1e-12) + 1.0)
                             : pi / 2 + pi * (std::ceil((at - pi / 2) / pi - 1e-12) - 1.0);
    last = step * (next - from) >= std::abs(way);
    if (last) next = from + way;
    const Vec2 b = last ? s.b : Vec2(s.centre + radius * Vec2(std::cos(next), std::sin(next)));
    const double right = std::cos(0.5 * (at + next)) > 0.0 ? 1.0 : -1.0;
    count += crosses(a, b, q, [&] {
      const double dz = q.y() - s.centre.y();
      return s.centre.x() + right * std::sqrt(std::max(0.0, radius * radius - dz * dz));
    });
    at = next;
    a = b;
  }
  return count;
}

/// A shape and its section; `closing` completes the border of the material where the profile is
/// open.
struct Turned {
  const char* name;
  ToolShape shape;
  std::vector<ProfileSegment> section, closing;
  Box3 space;
};

Turned turned(const char* name, const RevolvedProfile& profile) {
  return {name, profile, profile.segments, {}, Box3(Vec3(-35, -35, -35), Vec3(35, 35, 35))};
}

std::vector<Turned> shapes() {
  const RevolvedProfile keyhole{{{Kind::arc, {18, -4}, {18, 4}, {15, 0}, -1}, // 286 degrees
                                 {Kind::line, {18, 4}, {30, 4}},
                                 {Kind::line, {30, 4}, {30, -4}},
                                 {Kind::line, {30, -4}, {18, -4}}}};
  const RevolvedProfile die = make_profile({{80, -120, 0}, {80, 0, 10}, {400, 0, 0}});
  std::vector<Turned> all{
      turned(
          "star",
          make_profile({{0, 25, 0}, {6, 6, 0}, {28, 4, 0}, {8, -3, 0}, {25, -20, 0}, {0, -8, 0}})),
      turned("rounded star",
             make_profile(
                 {{0, 25, 0}, {6, 6, 2}, {28, 4, 1}, {8, -3, 3}, {25, -20, 1.5}, {0, -8, 0}})),
      turned("ball", {{{Kind::arc, {0, 20}, {0, -20}, {0, 0}, -1}}}),
      turned("torus", {{{Kind::arc, {25, 0}, {25, 0}, {17, 0}, -1}}}),
      turned("keyhole", keyhole),
      {"die",
       die,
       die.segments,
       {{Kind::line, {400, 0}, {400, -120}}, {Kind::line, {400, -120}, {80, -120}}},
       Box3(Vec3(-250, -250, -110), Vec3(250, 250, 60))}};
  const auto ring = [&](const char* name, const Annulus& a, std::vector<ProfileSegment> section) {
    all.push_back({name, a, std::move(section), {}, Box3(Vec3(-50, -50, -10), Vec3(50, 50, 20))});
  };
  ring("ring", {20, 45, 10, 3},
       {{Kind::line, {23, 10}, {42, 10}},
        {Kind::arc, {42, 10}, {45, 7}, {42, 7}, -1},
        {Kind::line, {45, 7}, {45, 3}},
        {Kind::arc, {45, 3}, {42, 0}, {42, 3}, -1},
        {Kind::line, {42, 0}, {23, 0}},
        {Kind::arc, {23, 0}, {20, 3}, {23, 3}, -1},
        {Kind::line, {20, 3}, {20, 7}},
        {Kind::arc, {20, 7}, {23, 10}, {23, 7}, -1}});
  ring("sharp ring", {20, 45, 10, 0},
       {{Kind::line, {20, 10}, {45, 10}},
        {Kind::line, {45, 10}, {45, 0}},
        {Kind::line, {45, 0}, {20, 0}},
        {Kind::line, {20, 0}, {20, 10}}});
  ring("disc", {0, 45, 10, 4},
       {{Kind::line, {0, 10}, {41, 10}},
        {Kind::arc, {41, 10}, {45, 6}, {41, 6}, -1},
        {Kind::line, {45, 6}, {45, 4}},
        {Kind::arc, {45, 4}, {41, 0}, {41, 4}, -1},
        {Kind::line, {41, 0}, {0, 0}}});
  return all;
}

struct Nearest {
  double distance, next; ///< mm, and that of the second one that is elsewhere
  Vec2 foot;
  bool inside;
};

Nearest brute_force(const Turned& t, const Vec2& q) {
  const double infinity = std::numeric_limits<double>::infinity();
  Nearest best{infinity, infinity, Vec2::Zero(), false};
  std::array<Vec2, 12> feet; // more than any section here has
  int count = 0;
  for (std::size_t i = 0; i < t.section.size(); ++i) {
    feet.at(i) = closest_on(t.section[i], q);
    const double d = (q - feet[i]).norm();
    if (d < best.distance) best.distance = d, best.foot = feet[i];
    count += crossings(t.section[i], q);
  }
  for (const ProfileSegment& s : t.closing)
    count += crossings(s, q);
  best.inside = count % 2 == 1;
  for (std::size_t i = 0; i < t.section.size(); ++i) {
    const ProfileSegment& s = t.section[i];
    if ((feet[i] - best.foot).norm() > 1e-6) best.next = std::min(best.next, (q - feet[i]).norm());
    if (s.kind == Kind::arc && (q - s.centre).norm() < 1e-6) best.next = best.distance;
  }
  return best;
}

double to_nearest_end(const Turned& t, const Vec2& q) {
  double nearest = (q - t.section.front().a).norm();
  for (const ProfileSegment& s : t.section)
    nearest = std::min(nearest, (q - s.b).norm());
  return nearest;
}

/// Everything that must hold at p. Returns whether the normal is known, and was compared.
bool expect_right(const Turned& t, const Vec3& p) {
  const SurfacePoint mine = ask(t.shape, p);
  const Vec2 q(std::hypot(p.x(), p.y()), p.z());
  const Nearest brute = brute_force(t, q);
  EXPECT_NEAR(std::abs(mine.distance), brute.distance, tolerance) << t.name << p.transpose();
  EXPECT_NEAR(mine.normal.norm(), 1.0, 1e-13) << t.name << " at " << p.transpose();
  if (brute.distance > 1e-9) {
    EXPECT_EQ(mine.distance < 0.0, brute.inside) << t.name << " at " << p.transpose();
  }
  const Vec3 foot = p - mine.distance * mine.normal;
  EXPECT_LE(brute_force(t, {std::hypot(foot.x(), foot.y()), foot.z()}).distance, 1e-9)
      << t.name << " at " << p.transpose() << " normal " << mine.normal.transpose();
  if (brute.distance < 1e-6) { // on the surface: out along the normal, in against it
    const auto inside = [&](double step) {
      const Vec3 x = p + step * mine.normal;
      return brute_force(t, {std::hypot(x.x(), x.y()), x.z()}).inside;
    };
    // beside an edge that way may lead through the wall on its other side
    const double edge = to_nearest_end(t, q);
    if (edge > 1e-2 || edge == 0.0) {
      EXPECT_FALSE(inside(1e-4)) << t.name << " at " << p.transpose();
    }
    if (edge > 1e-2) {
      EXPECT_TRUE(inside(-1e-4)) << t.name << " at " << p.transpose();
    }
    return false;
  }
  if (brute.next - brute.distance < 1e-5 || q.x() < 1e-5) return false; // a medial axis
  const Vec2 n = (q - brute.foot) / (brute.inside ? -brute.distance : brute.distance);
  const Vec3 expected(n.x() * p.x() / q.x(), n.x() * p.y() / q.x(), n.y());
  // pieces that join smoothly are as near, up to rounding, some way to both sides of the joint
  EXPECT_LE((mine.normal - expected).norm(), 1e-8 + std::sqrt(1e-14 / brute.distance))
      << t.name << " at " << p.transpose();
  return true;
}

TEST(SectionOracle, DistanceAndNormalAgreeWithBruteForceAtRandomPoints) {
  constexpr int count = 100000;
  for (const Turned& t : shapes()) {
    RandomPoints random(1);
    int compared = 0, inside = 0;
    for (int i = 0; i < count && !::testing::Test::HasFailure(); ++i) {
      Vec3 p = random.in(t.space);
      if (i % 2) { // every other point close to the surface
        const SurfacePoint far = ask(t.shape, p);
        p += (std::pow(10.0, random.in(-5, -1)) * (i % 4 == 1 ? 1.0 : -1.0) - far.distance) *
             far.normal;
        if (!t.space.contains(p)) continue; // beyond what closes an open profile
      }
      compared += expect_right(t, p);
      inside += ask(t.shape, p).distance < 0.0;
    }
    EXPECT_GT(compared, count / 2) << t.name;
    EXPECT_GT(inside, count / 20) << t.name;
  }
}

TEST(SectionOracle, CornersCentresAxisAndSurfaceAgreeWithBruteForce) {
  for (const Turned& t : shapes()) {
    std::vector<Vec2> places;
    for (const ProfileSegment& s : t.section) {
      const Vec2 middle = 0.5 * (s.a + s.b);
      places.insert(places.end(), {s.a, s.b, middle, Vec2(0.0, s.a.y()), Vec2(0.0, middle.y())});
      if (s.kind == Kind::arc) {
        places.push_back(s.centre);
        const auto [from, way] = arc_angles(s);
        for (const double share : {0.25, 0.5, 0.75}) { // on it, and towards its centre
          const double at = from + share * way, radius = (s.a - s.centre).norm();
          for (const double r : {radius, 0.5 * radius, 1.5 * radius})
            places.push_back(s.centre + r * Vec2(std::cos(at), std::sin(at)));
        }
      }
    }
    int points = 0;
    for (const Vec2& at : places)
      for (const double dr : {0.0, 1e-300, 1e-12, 1e-7, -1e-7, 1e-3, -1e-3})
        for (const double dz : {0.0, 1e-12, 1e-7, -1e-7, 1e-3, -1e-3})
          for (const double turn : {0.0, pi / 2, 0.7, pi, -2.3}) {
            const double r = at.x() + dr;
            const Vec3 p(r * std::cos(turn), r * std::sin(turn), at.y() + dz);
            if (t.closing.empty() || t.space.contains(p)) expect_right(t, p), ++points;
            if (::testing::Test::HasFailure()) return;
          }
    EXPECT_GT(points, 1000) << t.name;
  }
}

} // namespace
} // namespace plyform::section_oracle_test
