// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of outlines on one side of a line.
#include "core/mesh/cut_outline.hpp"
#include "core/mesh/mesh_blank.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace plyform::cut_outline_test {
namespace {

constexpr double slant = std::numbers::sqrt2 / 2.0;

Outline square() {
  return {{{-50, -30}, {50, -30}, {50, 30}, {-50, 30}}, {}};
}

double area_beyond(const Outline& outline, const Vec2& point, const Vec2& normal) {
  const std::optional<Outline> part = cut_outline(outline, point, normal);
  return part ? area_of(*part) : -1.0;
}

TEST(CutOutline, HalvesARectangleThroughSidesAndCorners) {
  EXPECT_NEAR(area_beyond(square(), {0, 0}, Vec2::UnitX()), 3000.0, 1e-9);
  EXPECT_NEAR(area_beyond(square(), {10, 0}, Vec2::UnitX()), 2400.0, 1e-9);
  EXPECT_NEAR(area_beyond(square(), {0, 0}, Vec2(slant, slant)), 3000.0, 1e-9);
  Outline diamond{{{-40, 0}, {0, -40}, {40, 0}, {0, 40}}, {}};
  EXPECT_NEAR(area_beyond(diamond, {0, 0}, Vec2::UnitX()), 1600.0, 1e-9);
  EXPECT_NEAR(area_beyond(diamond, {0, 0}, Vec2(slant, slant)), 1600.0, 1e-9);
  const std::optional<Outline> half = cut_outline(square(), {0, 0}, Vec2::UnitY());
  ASSERT_TRUE(half);
  EXPECT_EQ(half->boundary.size(), 4u);
}

TEST(CutOutline, KeepsArcsAndHoles) {
  Outline ring;
  append_circle(ring, Vec2::Zero(), 50.0);
  append_circle(ring, Vec2::Zero(), 20.0);
  append_circle(ring, Vec2(0.0, 35.0), 5.0);
  append_circle(ring, Vec2(0.0, -35.0), 5.0);
  const double whole = area_of(ring);
  EXPECT_NEAR(whole, std::numbers::pi * (2500.0 - 400.0 - 50.0), 1e-6);
  for (const double angle : {0.0, 0.1, 0.7, 1.0}) {
    const Vec2 normal(std::cos(angle), std::sin(angle));
    EXPECT_NEAR(area_beyond(ring, Vec2::Zero(), normal), 0.5 * whole, 1e-6) << angle;
  }
  const std::optional<Outline> upper = cut_outline(ring, Vec2::Zero(), Vec2::UnitY());
  ASSERT_TRUE(upper);
  EXPECT_EQ(upper->holes.size(), 1u);
  const std::optional<Outline> right = cut_outline(ring, Vec2::Zero(), Vec2::UnitX());
  ASSERT_TRUE(right); // all holes are open at the line
  EXPECT_TRUE(right->holes.empty());
  for (const OutlineArc& arc : right->arcs) { // both ends on their circles
    const Vec2 &from = right->boundary[arc.side],
               &to = right->boundary[(arc.side + 1) % right->boundary.size()];
    EXPECT_NEAR((from - arc.centre).norm(), (to - arc.centre).norm(), 1e-9);
  }
}

TEST(CutOutline, AndItsOtherHalfAreTheWhole) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> number(0.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    Outline star; // seen from its middle each corner, so that a line through it leaves two pieces
    for (int k = 0; k < 12; ++k) {
      const double angle = (k + 0.8 * number(random)) * std::numbers::pi / 6.0;
      star.boundary.push_back((30.0 + 5.0 * number(random)) *
                              Vec2(std::cos(angle), std::sin(angle)));
    }
    const double angle = 7.0 * number(random);
    const Vec2 normal(std::cos(angle), std::sin(angle));
    const double one = area_beyond(star, Vec2::Zero(), normal),
                 other = area_beyond(star, Vec2::Zero(), -normal);
    ASSERT_GT(one, 0.0);
    EXPECT_NEAR(one + other, area_of(star), 1e-9 * one);
  }
}

TEST(CutOutline, IsNothingWhereNothingOrSeveralPiecesAreLeft) {
  EXPECT_FALSE(cut_outline(square(), {60, 0}, Vec2::UnitX()));
  EXPECT_NEAR(area_beyond(square(), {-60, 0}, Vec2::UnitX()), 6000.0, 1e-9);
  const Outline comb{{{0, 0}, {50, 0}, {50, 40}, {35, 40}, {35, 10}, {15, 10}, {15, 40}, {0, 40}},
                     {}};
  EXPECT_FALSE(cut_outline(comb, {0, 20}, Vec2::UnitY()));
  EXPECT_NEAR(area_beyond(comb, {0, 20}, -Vec2::UnitY()), 800.0, 1e-9);
}

} // namespace
} // namespace plyform::cut_outline_test
