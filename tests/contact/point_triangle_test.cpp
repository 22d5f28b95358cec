// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/point_triangle.hpp"

#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <set>

namespace plyform::point_triangle_test {
namespace {

using Exact = CGAL::Exact_rational;
using ExactKernel = CGAL::Simple_cartesian<Exact>;
using ExactPoint = ExactKernel::Point_3;
using Corners = std::array<Vec3, 3>;

ExactPoint exact(const Vec3& x) {
  return {Exact(x.x()), Exact(x.y()), Exact(x.z())};
}

Exact exact_distance2_to_segment(const ExactPoint& p, const ExactPoint& a, const ExactPoint& b) {
  const auto d = b - a;
  Exact t = 0;
  if (d.squared_length() != 0) t = ((p - a) * d) / d.squared_length();
  t = t < 0 ? Exact(0) : t > 1 ? Exact(1) : t;
  return (p - (a + t * d)).squared_length();
}

/// In rational arithmetic, straight from the definition: the foot on the plane if it is inside,
/// else the closest edge.
double exact_distance(const Vec3& p_, const Corners& t) {
  const ExactPoint p = exact(p_), a = exact(t[0]), b = exact(t[1]), c = exact(t[2]);
  const auto n = CGAL::cross_product(b - a, c - a);
  const auto side = [&](const ExactPoint& from, const ExactPoint& to) {
    return CGAL::cross_product(to - from, p - from) * n;
  };
  if (n.squared_length() != 0 && side(a, b) >= 0 && side(b, c) >= 0 && side(c, a) >= 0) {
    const Exact h = (p - a) * n;
    return std::sqrt(CGAL::to_double(Exact(h * h / n.squared_length())));
  }
  const Exact d2 =
      std::min({exact_distance2_to_segment(p, a, b), exact_distance2_to_segment(p, b, c),
                exact_distance2_to_segment(p, c, a)});
  return std::sqrt(CGAL::to_double(d2));
}

Vec3 point_of(const ClosestPoint& q, const Corners& t) {
  return q.w[0] * t[0] + q.w[1] * t[1] + q.w[2] * t[2];
}

double size_of(const Vec3& p, const Corners& t) {
  return std::max({(t[0] - p).norm(), (t[1] - p).norm(), (t[2] - p).norm()});
}

/// Height over length, 1 at most; infinity for exactly degenerate triangles, whose plane is not
/// used.
double slenderness(const Corners& t) {
  const ExactPoint a = exact(t[0]), b = exact(t[1]), c = exact(t[2]);
  const Exact n2 = CGAL::cross_product(b - a, c - a).squared_length();
  const double length =
      std::max({(t[1] - t[0]).norm(), (t[2] - t[1]).norm(), (t[0] - t[2]).norm()});
  if (n2 == 0) return std::numeric_limits<double>::infinity();
  return std::sqrt(CGAL::to_double(n2)) / (length * length);
}

/// Everything that must hold for any p and triangle. Tolerances: a few dozen roundings of numbers
/// no larger than the distance to the furthest corner; rounding tilts the normal of a sliver, which
/// moves the foot along it, but never further than the sliver is high.
void expect_right(const Vec3& p, const Corners& t) {
  const ClosestPoint q = closest_point_on_triangle(p, t[0], t[1], t[2]);
  SCOPED_TRACE(testing::Message() << "p " << p.transpose() << " a " << t[0].transpose() << " b "
                                  << t[1].transpose() << " c " << t[2].transpose() << " feature "
                                  << q.feature);
  const double size = size_of(p, t);
  const double slender = slenderness(t), tilt = std::min(slender, 2.2e-16 / slender);
  EXPECT_NEAR(std::sqrt(q.distance2), exact_distance(p, t), (2e-15 + tilt) * size);
  for (const double w : q.w)
    EXPECT_TRUE(w >= 0.0 && w <= 1.0) << w;
  EXPECT_NEAR(q.w[0] + q.w[1] + q.w[2], 1.0, 1e-15);
  // The weights give the point whose distance was told. Rounding of absolute coordinates adds.
  const double absolute = size + p.cwiseAbs().maxCoeff();
  EXPECT_NEAR((p - point_of(q, t)).norm(), std::sqrt(q.distance2), 1e-14 * absolute);
  // The feature says which weights are zero.
  const std::array<std::array<bool, 3>, 7> used{{{true, true, true},
                                                 {true, false, false},
                                                 {false, true, false},
                                                 {false, false, true},
                                                 {true, true, false},
                                                 {false, true, true},
                                                 {true, false, true}}};
  ASSERT_TRUE(q.feature >= 0 && q.feature <= 6);
  for (int k = 0; k < 3; ++k)
    EXPECT_TRUE(used[q.feature][k] || q.w[k] == 0.0) << "weight " << k << " = " << q.w[k];
}

class PointTriangle : public testing::Test {
protected:
  std::mt19937_64 random{20240611};
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  }
  Vec3 vector(double half) {
    return {uniform(-half, half), uniform(-half, half), uniform(-half, half)};
  }
  Corners corners(double half) { return {vector(half), vector(half), vector(half)}; }
};

TEST_F(PointTriangle, MatchesExactArithmeticAtAnyScale) {
  std::set<int> seen;
  for (int i = 0; i < 5000; ++i) {
    const double scale = std::pow(10.0, uniform(-6.0, 6.0));
    const Corners t = corners(scale);
    const Vec3 p = vector(scale * std::pow(10.0, uniform(-2.0, 2.0)));
    expect_right(p, t);
    seen.insert(closest_point_on_triangle(p, t[0], t[1], t[2]).feature);
  }
  EXPECT_EQ(seen.size(), 7u) << "the sample must visit all regions";
}

TEST_F(PointTriangle, MatchesExactArithmeticFarFromOrigin) {
  for (int i = 0; i < 2000; ++i) {
    const Vec3 far = vector(1e6);
    const Corners t{far + vector(1.0), far + vector(1.0), far + vector(1.0)};
    expect_right(far + vector(2.0), t);
  }
}

TEST_F(PointTriangle, MatchesExactArithmeticOnSlivers) {
  for (int i = 0; i < 5000; ++i) {
    Corners t = corners(1.0);
    const double along = uniform(-0.5, 1.5), height = std::pow(10.0, uniform(-18.0, -2.0));
    t[2] = t[0] + along * (t[1] - t[0]) + height * vector(1.0);
    std::shuffle(t.begin(), t.end(), random);
    const Vec3 near = uniform(-0.2, 1.2) * (t[1] - t[0]) + t[0];
    expect_right(near + std::pow(10.0, uniform(-12.0, 0.0)) * vector(1.0), t);
  }
}

TEST_F(PointTriangle, DegenerateTriangleIsItsSegmentOrPoint) {
  for (int i = 0; i < 500; ++i) {
    // Whole numbers, so that the corners are in line exactly.
    const auto whole = [&] { return Vec3(vector(9.0).array().round()); };
    const Vec3 a = whole(), d = whole(), p = vector(20.0);
    expect_right(p, {a, a, a});
    expect_right(a, {a, a, a});
    expect_right(p, {a, a, d});
    expect_right(p, {a, d, a});
    expect_right(p, {d, a, a});
    expect_right(p, {a, a + d, a + 3.0 * d});
    expect_right(p, {a + d, a - 2.0 * d, a});
    expect_right(a + 2.0 * d, {a, a + d, a + 3.0 * d});
  }
}

TEST_F(PointTriangle, NeverNaN) {
  const double sizes[] = {0.0, 5e-324, 1e-160, 1e-80, 1e-40, 1.0, 1e40, 1e74};
  for (const double s : sizes)
    for (const double r : sizes)
      for (int i = 0; i < 200; ++i) {
        const Corners t = corners(s);
        const ClosestPoint q = closest_point_on_triangle(vector(r), t[0], t[1], t[2]);
        ASSERT_TRUE(std::isfinite(q.distance2) && q.distance2 >= 0.0) << s << " " << r;
        ASSERT_NEAR(q.w[0] + q.w[1] + q.w[2], 1.0, 1e-15) << s << " " << r;
        for (const double w : q.w)
          ASSERT_TRUE(w >= 0.0 && w <= 1.0) << w;
      }
}

TEST_F(PointTriangle, NamesTheSevenRegions) {
  const Vec3 a(0, 0, 0), b(4, 0, 0), c(0, 4, 0);
  const struct {
    Vec3 p;
    int feature;
    std::array<double, 3> w;
    double distance2;
  } cases[] = {{{1, 1, 2}, 0, {0.5, 0.25, 0.25}, 4.0},
               {{-1, -2, 2}, 1, {1, 0, 0}, 9.0},
               {{6, -1, 2}, 2, {0, 1, 0}, 9.0},
               {{-1, 6, 2}, 3, {0, 0, 1}, 9.0},
               {{1, -2, 0}, 4, {0.75, 0.25, 0}, 4.0},
               {{3, 3, 1}, 5, {0, 0.5, 0.5}, 3.0},
               {{-3, 3, 0}, 6, {0.25, 0, 0.75}, 9.0},
               {a, 1, {1, 0, 0}, 0.0},
               {b, 2, {0, 1, 0}, 0.0},
               {c, 3, {0, 0, 1}, 0.0},
               {{2, 0, 0}, 4, {0.5, 0.5, 0}, 0.0},
               {{2, 2, 0}, 5, {0, 0.5, 0.5}, 0.0},
               {{0, 2, 0}, 6, {0.5, 0, 0.5}, 0.0},
               {{1, 1, 0}, 0, {0.5, 0.25, 0.25}, 0.0}};
  for (const auto& [p, feature, w, distance2] : cases) {
    SCOPED_TRACE(testing::Message() << p.transpose());
    const ClosestPoint q = closest_point_on_triangle(p, a, b, c);
    EXPECT_EQ(q.feature, feature);
    for (int k = 0; k < 3; ++k)
      EXPECT_DOUBLE_EQ(q.w[k], w[k]);
    EXPECT_DOUBLE_EQ(q.distance2, distance2);
  }
}

// The closest point of a convex set is a contraction: it moves no further than p does. Steps of
// 1e-3 across all region borders; a wrong region would jump by the triangle's size.
TEST_F(PointTriangle, ClosestPointNeverJumps) {
  for (int i = 0; i < 200; ++i) {
    const Corners t = corners(1.0);
    const Vec3 from = vector(2.0), to = vector(2.0);
    Vec3 last = point_of(closest_point_on_triangle(from, t[0], t[1], t[2]), t);
    const int steps = 1000;
    for (int k = 1; k <= steps; ++k) {
      const Vec3 p = from + (to - from) * (double(k) / steps);
      const Vec3 q = point_of(closest_point_on_triangle(p, t[0], t[1], t[2]), t);
      // 1e-12: the foot on a thin triangle is off along it by rounding over its sine (1e-3).
      ASSERT_LE((q - last).norm(), (to - from).norm() / steps + 1e-12);
      last = q;
    }
  }
}

} // namespace
} // namespace plyform::point_triangle_test
