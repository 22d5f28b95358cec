// SPDX-License-Identifier: GPL-3.0-or-later
// Where boundaries put their nodes, and along which axes. Whole scenes:
// tests/scenes/boundary_test.cpp.
#include "core/model/boundary.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace plyform::boundary_test {
namespace {

constexpr double pi = std::numbers::pi;

Boundary frame_of(const Vec2& p0, const Vec2& u, const Vec2& v, double stroke = 0.0) {
  HingedFrame f;
  f.hinges = {p0, p0 + u, p0 + u + v, p0 + v};
  f.stroke = stroke;
  return {"frame", -1, f};
}

/// A square, a rhombus that is open already, a parallelogram, and that one listed clockwise.
std::vector<Boundary> frames() {
  const Vec2 u(40, 5), v(10, 60);
  return {frame_of({-50, -50}, {100, 0}, {0, 100}),
          frame_of({1, 2}, {50, 0}, {50 * std::cos(2.0), 50 * std::sin(2.0)}),
          frame_of({3, -2}, u, v), frame_of({3, -2}, v, u)};
}

Vec3 flat(const Vec2& p, double z) {
  return {p.x(), p.y(), z};
}

/// Displacements from none to nearly all that the bars allow.
std::vector<double> strokes_of(const Boundary& frame) {
  const double most = longest_stroke(frame.as<HingedFrame>());
  return {0.0, 1e-6 * most, 0.3 * most, 0.7 * most, 0.99 * most};
}

TEST(Boundary, BarsOfAFrameKeepTheirLengths) {
  for (const Boundary& frame : frames())
    for (const double d : strokes_of(frame))
      for (std::size_t k = 0; k < 4; ++k) {
        const auto& hinges = frame.as<HingedFrame>().hinges;
        const Vec3 a = flat(hinges[k], 4.0), b = flat(hinges[(k + 1) % 4], 4.0);
        const double before = (b - a).norm();
        for (const double s : {0.25, 1.0}) { // from the hinge to a point of the bar
          const Vec3 p = prescribed_position(frame, a, d),
                     q = prescribed_position(frame, a + s * (b - a), d);
          EXPECT_NEAR((q - p).norm(), s * before, 1e-12 * 100) << d; // rounding of 100 mm
          EXPECT_EQ(p.z(), 4.0);
        }
      }
}

TEST(Boundary, FirstHingeOfAFrameStaysAndTheThirdGoesAlongTheDiagonal) {
  for (const Boundary& frame : frames())
    for (const double d : strokes_of(frame)) {
      const auto& hinges = frame.as<HingedFrame>().hinges;
      const Vec3 p0 = flat(hinges[0], 0.0), p2 = flat(hinges[2], 0.0);
      EXPECT_NEAR((prescribed_position(frame, p0, d) - p0).norm(), 0.0, 1e-12);
      const Vec3 wanted = p2 + d * (p2 - p0).normalized();
      EXPECT_NEAR((prescribed_position(frame, p2, d) - wanted).norm(), 0.0, 1e-12 * 100);
    }
}

TEST(Boundary, SlopeIsTheDerivativeOfThePlace) {
  std::vector<Boundary> all = frames();
  Grip grip;
  grip.direction = Vec3(0.6, 0.0, -0.8);
  all.push_back({"grip", -1, grip});
  all.push_back({"plane", -1, SymmetryPlane{}});
  for (const Boundary& b : all)
    for (const double share : {0.1, 0.5, 0.9}) {
      const auto* frame = std::get_if<HingedFrame>(&b.kind);
      const double d = share * (frame ? longest_stroke(*frame) : 10.0), h = 1e-4;
      const Vec3 hinge = frame ? flat(frame->hinges[1], 0.0) : Vec3(Vec3::Zero());
      for (const Vec3& X : {Vec3(7, 11, 3), Vec3(-20, 30, 0), hinge}) {
        const Vec3 difference =
            (prescribed_position(b, X, d + h) - prescribed_position(b, X, d - h)) / (2.0 * h);
        // h^2 times the third derivative, and 1e-14 of 100 mm over h
        EXPECT_NEAR((prescribed_slope(b, X, d) - difference).norm(), 0.0, 1e-7) << share;
      }
    }
}

TEST(Boundary, SquareFrameShearsByTheClosedForm) {
  const double a = 100.0;
  const Boundary frame = frames()[0];
  for (const double degrees : {0.0, 5.0, 30.0, 50.0, 80.0}) {
    const double gamma = degrees * pi / 180.0;
    const double d = 2.0 * a * std::cos(0.5 * (0.5 * pi - gamma)) - a * std::numbers::sqrt2;
    const Vec3 p0 = prescribed_position(frame, {-50, -50, 0}, d);
    const Vec3 u = prescribed_position(frame, {50, -50, 0}, d) - p0,
               v = prescribed_position(frame, {-50, 50, 0}, d) - p0;
    EXPECT_NEAR(std::asin(u.dot(v) / (a * a)), gamma, 1e-12) << degrees;
    EXPECT_GT(u.cross(v).z(), 0.0); // not turned over
  }
  EXPECT_NEAR(longest_stroke(frame.as<HingedFrame>()), (2.0 - std::numbers::sqrt2) * a, 1e-12);
}

Boundary grip_on(const Vec2& a, const Vec2& b, std::array<bool, 3> held = {true, true, true}) {
  Grip grip;
  grip.place = {true, {a, b}};
  grip.held = held;
  return {"grip", -1, grip};
}

Boundary plane_through(const Vec2& point, const Vec2& normal) {
  return {"plane", -1, SymmetryPlane{point, normal.normalized()}};
}

TEST(Boundary, HoldsWhatLiesInItsBoxOnItsEdgeOrOnItsPlane) {
  Boundary box{"box", -1, Grip{}}; // corners in any order
  box.as<Grip>().place.ends = {Vec2(4, -1), Vec2(-2, 3)};
  EXPECT_TRUE(holds(box, 0, {0, 0}));
  EXPECT_TRUE(holds(box, 7, {4, 3}));       // the rim, any ply
  EXPECT_TRUE(holds(box, 0, {4.00005, 0})); // rounding
  EXPECT_FALSE(holds(box, 0, {4.001, 0}));
  box.ply = 1;
  EXPECT_FALSE(holds(box, 0, {0, 0}));
  EXPECT_TRUE(holds(box, 1, {0, 0}));
  const Boundary edge = grip_on({0, 0}, {30, 40});
  EXPECT_TRUE(holds(edge, 0, {30, 40}));
  EXPECT_TRUE(holds(edge, 0, {3, 4}));
  EXPECT_FALSE(holds(edge, 0, {3, 4.001}));
  EXPECT_FALSE(holds(edge, 0, {33, 44})); // beyond its end
  const Boundary frame = frames()[0];
  EXPECT_TRUE(holds(frame, 0, {-50, 12}));
  EXPECT_FALSE(holds(frame, 0, {0, 0}));
  const Boundary plane = plane_through({1, 0}, {1, 1});
  EXPECT_TRUE(holds(plane, 0, {101, -100}));
  EXPECT_FALSE(holds(plane, 0, {0, 0}));
}

/// The axes of the one node that is held; fails if they are not orthonormal.
PrescribedNode only_node(const std::vector<Boundary>& boundaries) {
  const std::vector<Vec3> x0{{0, 0, 5}, {1000, 700, 5}};
  const std::vector<PrescribedNode> held = prescribed_nodes(boundaries, 2, x0);
  EXPECT_EQ(held.size(), 1u);
  if (held.size() != 1) return {};
  const PrescribedNode& node = held[0];
  EXPECT_EQ(node.ply, 2);
  EXPECT_EQ(node.node, 0);
  for (int i = 0; i < node.count; ++i)
    for (int j = 0; j < node.count; ++j)
      EXPECT_NEAR(node.axis[i].dot(node.axis[j]), i == j ? 1.0 : 0.0, 1e-14);
  return node;
}

/// How much of a direction is held: 1 all, 0 none.
double held_share(const PrescribedNode& node, const Vec3& direction) {
  double sum = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(node.count); ++i)
    sum += std::pow(node.axis[i].dot(direction), 2);
  return sum / direction.squaredNorm();
}

TEST(Boundary, CornerOfGripAndPlaneIsHeldAlongEachAxisOnce) {
  const Boundary plane = plane_through({0, 0}, {1, 0});
  const Boundary whole = grip_on({0, 0}, {5, 0});
  // The grip has all three, also when the plane comes first.
  PrescribedNode node = only_node({plane, whole});
  EXPECT_EQ(node.count, 3);
  for (const int boundary : node.boundary)
    EXPECT_EQ(boundary, 1);
  // A grip that leaves x free: the plane holds it.
  node = only_node({plane, grip_on({0, 0}, {5, 0}, {false, true, true})});
  EXPECT_EQ(node.count, 3);
  EXPECT_EQ(node.boundary, (std::array<int, 3>{1, 1, 0}));
  EXPECT_NEAR(std::abs(node.axis[2].x()), 1.0, 1e-15);
  // A grip that holds the plane's direction only: the rest is free.
  node = only_node({plane, grip_on({0, 0}, {5, 0}, {true, false, false})});
  EXPECT_EQ(node.count, 1);
  EXPECT_EQ(node.boundary[0], 1);
}

TEST(Boundary, PlanesAtAnyAngleHoldTheirCornerAcrossBoth) {
  for (const double angle : {0.5 * pi, 0.25 * pi, 0.1}) {
    const PrescribedNode node = only_node(
        {plane_through({0, 0}, {0, 1}), plane_through({0, 0}, {std::sin(angle), std::cos(angle)})});
    EXPECT_EQ(node.count, 2) << angle;
    EXPECT_NEAR(held_share(node, Vec3::UnitX()), 1.0, 1e-14);
    EXPECT_NEAR(held_share(node, Vec3::UnitY()), 1.0, 1e-14);
    EXPECT_EQ(held_share(node, Vec3::UnitZ()), 0.0);
  }
  // The same plane twice is one.
  EXPECT_EQ(only_node({plane_through({0, 0}, {3, 1}), plane_through({0, 0}, {-3, -1})}).count, 1);
  // A slanted plane beside a grip along x: both directions in the plane of the ply.
  const PrescribedNode node =
      only_node({plane_through({0, 0}, {1, 1}), grip_on({0, 0}, {5, 0}, {true, false, false})});
  EXPECT_EQ(node.count, 2);
  EXPECT_NEAR(held_share(node, Vec3(1, 1, 0)), 1.0, 1e-14);
}

TEST(Boundary, OfOtherPliesHoldsNothing) {
  Boundary grip = grip_on({0, 0}, {5, 0});
  grip.ply = 1;
  const std::vector<Vec3> x0{{0, 0, 0}};
  EXPECT_TRUE(prescribed_nodes({grip}, 0, x0).empty());
  EXPECT_EQ(prescribed_nodes({grip}, 1, x0).size(), 1u);
}

} // namespace
} // namespace plyform::boundary_test
