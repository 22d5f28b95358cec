// SPDX-License-Identifier: GPL-3.0-or-later
// Draw-in of squares that are formed by a matrix, against closed forms, and of plies with holes.
#include "core/results/draw_in.hpp"
#include "support/ply_sheets.hpp"

#include <gtest/gtest.h>

namespace plyform::draw_in_test {
namespace {

using sheets::sheet;

constexpr double rounding = 1e-9; // mm, of lengths of some 100 mm

/// Of a square of half side `half` round its middle, formed by a matrix.
double of_square(double half, const Eigen::Matrix2d& matrix, double direction_deg) {
  const double a = direction_deg * std::numbers::pi / 180.0;
  const Vec2 u(std::cos(a), std::sin(a)), border = u * (half / u.cwiseAbs().maxCoeff());
  return border.norm() - (matrix * border).norm();
}

TEST(DrawIn, OfASquareThatIsNotRoundTheOrigin) {
  PlyFrame ply = sheet(10, 10, 20.0, 0.0, sheets::flat);
  const Vec3 off(30.0, -70.0, 0.0);
  for (std::size_t i = 0; i < ply.x.size(); ++i) {
    ply.x[i] = off + Vec3(0.9 * ply.x0[i].x(), 0.8 * ply.x0[i].y(), -25.0);
    ply.x0[i] += off;
  }
  const DrawIn told = draw_in(ply);
  ASSERT_EQ(told.unknown, "");
  const double diagonal = 100.0 * (std::hypot(1.0, 1.0) - std::hypot(0.9, 0.8));
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(told.yarns[k], k % 2 ? 20.0 : 10.0, rounding);
    EXPECT_NEAR(told.bisectors[k], diagonal, rounding);
    EXPECT_NEAR(told.yarns_deg[k], 90.0 * static_cast<double>(k), rounding);
    EXPECT_NEAR(told.bisectors_deg[k], 45.0 + 90.0 * static_cast<double>(k), rounding);
  }
  EXPECT_NEAR(told.mean(), 0.5 * (15.0 + diagonal), rounding);
  EXPECT_NEAR(told.largest(), diagonal, rounding);
}

TEST(DrawIn, OfAPlyThatOnlyMovesIsWhatOneEndComesNearer) {
  PlyFrame ply = sheet(10, 10, 20.0, 0.0, sheets::flat);
  for (Vec3& x : ply.x)
    x.x() += 5.0;
  const DrawIn told = draw_in(ply);
  const double side = 100.0 - std::hypot(100.0, 5.0);
  const double expected[] = {-5.0, side, 5.0, side};
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(told.yarns[k], expected[k], rounding);
}

TEST(DrawIn, OfYarnsAtAnyAngleToTheMeshAndToEachOther) {
  const Eigen::Matrix2d matrix{{0.8, 0.1}, {-0.05, 0.9}};
  PlyFrame ply = sheet(7, 7, 200.0 / 7.0, 0.0, [&](const Vec2& p) -> Vec3 {
    return {(matrix * p).x(), (matrix * p).y(), 0.0};
  });
  ply.families[0].angle_deg = 20.0;
  ply.families[1].angle_deg = 90.0;
  const DrawIn told = draw_in(ply);
  for (std::size_t k = 0; k < 4; ++k) {
    const double yarn[] = {20.0, 90.0, 200.0, 270.0};
    EXPECT_NEAR(told.yarns[k], of_square(100.0, matrix, yarn[k]), rounding);
    EXPECT_NEAR(told.bisectors[k], of_square(100.0, matrix, 55.0 + 90.0 * static_cast<double>(k)),
                rounding);
  }
}

/// The sheet without the triangles that `away` takes, with nodes numbered anew.
PlyFrame without(PlyFrame ply, const std::function<bool(const Vec2&)>& away) {
  PlyFrame left = ply;
  left.triangles.clear(), left.x0.clear(), left.x.clear();
  std::vector<std::int32_t> number(ply.x0.size(), -1);
  for (std::size_t t = 0; t < ply.triangles.size(); ++t) {
    if (away(sheets::centre(ply, t))) continue;
    Triangle renumbered{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto old = static_cast<std::size_t>(ply.triangles[t][k]);
      if (number[old] < 0) {
        number[old] = static_cast<std::int32_t>(left.x0.size());
        left.x0.push_back(ply.x0[old]), left.x.push_back(ply.x[old]);
      }
      renumbered[k] = number[old];
    }
    left.triangles.push_back(renumbered);
  }
  return left;
}

TEST(DrawIn, WalksOverHolesAndEndsAtNotches) {
  const PlyFrame whole = sheet(10, 10, 10.0, 0.0, [](const Vec2& p) -> Vec3 {
    return {0.9 * p.x(), 0.9 * p.y(), 0.0};
  });
  const DrawIn over_hole =
      draw_in(without(whole, [](const Vec2& p) { return p.cwiseAbs().maxCoeff() < 30.0; }));
  ASSERT_EQ(over_hole.unknown, "");
  const DrawIn at_notch = draw_in(
      without(whole, [](const Vec2& p) { return std::abs(p.x() - 20.0) < 10.0 && p.y() > -20.0; }));
  const double notched[] = {1.0, 5.0, 5.0, 5.0};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(over_hole.yarns[k], 5.0, rounding);
    EXPECT_NEAR(at_notch.yarns[k], notched[k], rounding);
  }
}

TEST(DrawIn, SaysWhyThereIsNone) {
  const PlyFrame whole = sheet(4, 4, 25.0, 0.0, sheets::flat);
  const auto corner = [](const Vec2& p) { return p.x() > -20.0 && p.y() > -20.0; };
  EXPECT_EQ(draw_in(without(whole, corner)).unknown, "the middle of its bounding box is outside");
  const auto touching = [](const Vec2& p) { return p.x() * p.y() > 0.0; };
  EXPECT_EQ(draw_in(without(whole, touching)).unknown, "its border meets itself");
}

} // namespace
} // namespace plyform::draw_in_test
