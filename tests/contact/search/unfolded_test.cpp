// SPDX-License-Identifier: GPL-3.0-or-later
// Where self-contact need not be searched: never where a sheet touches itself, nearly everywhere
// else.
#include "contact/point_triangle.hpp"
#include "contact/search/unfolded.hpp"
#include "support/contact_checks.hpp"

#include <gtest/gtest.h>
#include <numbers>
#include <numeric>

namespace plyform::unfolded_test {
namespace {

constexpr double distance = 0.6, apart = 3.0 * distance, skin = 1.0; // mm

struct Sheet {
  std::vector<Vec3> x0;
  std::vector<Triangle> triangles;
  SheetEdges edges;
  bool convex;
  explicit Sheet(const OwnedSheet& of)
      : x0(of.x), triangles(of.triangles), edges(sheet_edges(triangles, x0)),
        convex(is_convex(x0, triangles)) {}
  std::vector<char> unfolded(std::span<const Vec3> x) const {
    std::vector<char> of_nodes;
    find_unfolded({x0, triangles, convex}, edges, x, distance, skin, of_nodes);
    return of_nodes;
  }
};

int count(const std::vector<char>& marks) {
  return std::accumulate(marks.begin(), marks.end(), 0);
}

/// The sheet bent about lines along y to a curve of this curvature (1/mm) by arc length.
template <class Curvature>
std::vector<Vec3> bent(std::span<const Vec3> x0, const Curvature& curvature) {
  std::vector<Vec3> x;
  for (const Vec3& p : x0) {
    double angle = 0.0, along = 0.0, up = 0.0;
    constexpr int pieces = 400;
    const double ds = p.x() / pieces;
    for (int i = 0; i < pieces; ++i) {
      angle += ds * curvature((i + 0.5) * ds);
      along += ds * std::cos(angle);
      up += ds * std::sin(angle);
    }
    x.emplace_back(along, p.y(), up);
  }
  return x;
}

/// Nodes within the contact distance of a face that is no neighbour of theirs.
std::vector<std::int32_t> touching(const Sheet& sheet, std::span<const Vec3> x) {
  std::vector<std::int32_t> nodes;
  const auto near = [](const Vec3& p, std::span<const Vec3> at, const Triangle& t) {
    return std::sqrt(closest_point_on_triangle(p, at[t[0]], at[t[1]], at[t[2]]).distance2);
  };
  for (std::size_t n = 0; n < x.size(); ++n)
    for (const Triangle& t : sheet.triangles)
      if (near(x[n], x, t) < distance && near(sheet.x0[n], sheet.x0, t) > apart) {
        nodes.push_back(static_cast<std::int32_t>(n));
        break;
      }
  return nodes;
}

TEST(Unfolded, AllOfAFlatSheetAndOfASmoothDome) {
  const Sheet sheet(square_sheet(30, 4.0, 0.0));
  EXPECT_TRUE(sheet.convex);
  EXPECT_EQ(count(sheet.unfolded(sheet.x0)), static_cast<int>(sheet.x0.size()));
  std::vector<Vec3> dome = sheet.x0;
  for (Vec3& p : dome)
    p.z() = -p.squaredNorm() / 600.0; // slopes of up to 16 degrees
  EXPECT_EQ(count(sheet.unfolded(dome)), static_cast<int>(sheet.x0.size()));
}

TEST(Unfolded, NotWhereASheetTouchesItself) {
  const Sheet sheet(square_sheet(30, 4.0, 0.0));
  int touched = 0, spared = 0;
  for (int turn = 0; turn <= 20; ++turn) {
    const double most =
        turn / 20.0 * 200.0 / 180.0 * std::numbers::pi; // layers close at 20 degrees
    const auto hairpin =
        bent(sheet.x0, [most](double s) { return std::abs(s) < 6.0 ? most / 12.0 : 0.0; });
    const auto s_fold = bent(sheet.x0, [most](double s) {
      return std::abs(s + 15.0) < 5.0 ? most / 10.0 : std::abs(s - 15.0) < 5.0 ? -most / 10.0 : 0.0;
    });
    for (const auto& x : {hairpin, s_fold}) {
      const std::vector<char> unfolded = sheet.unfolded(x);
      for (const std::int32_t n : touching(sheet, x)) {
        EXPECT_EQ(unfolded[n], 0) << turn << " node " << n;
        ++touched;
      }
      spared += count(unfolded);
    }
  }
  EXPECT_GT(touched, 100);
  EXPECT_GT(spared, 42 * static_cast<int>(sheet.x0.size()) / 4);
}

TEST(Unfolded, NotWhereTheLipsOfASlitSlideOverEachOther) {
  OwnedSheet whole = square_sheet(30, 4.0, 0.0), slit = whole;
  std::erase_if(slit.triangles, [&](const Triangle& t) { // 4 mm wide, from one side to the middle
    const Vec3 c = (slit.x[t[0]] + slit.x[t[1]] + slit.x[t[2]]) / 3.0;
    return c.x() > 0.0 && std::abs(c.y() - 2.0) < 2.0;
  });
  ASSERT_LT(slit.triangles.size(), whole.triangles.size());
  const Sheet sheet(slit);
  EXPECT_FALSE(sheet.convex);
  std::vector<Vec3> x = sheet.x0;
  for (Vec3& p : x) // the upper lip comes down over the lower one, 0.4 mm above it
    if (p.x() > 0.0 && p.y() >= 3.0) p += std::min(p.x() / 40.0, 1.0) * Vec3(0.0, -13.0, 0.4);
  const std::vector<std::int32_t> lips = touching(sheet, x);
  ASSERT_FALSE(lips.empty());
  const std::vector<char> unfolded = sheet.unfolded(x);
  for (const std::int32_t n : lips)
    EXPECT_EQ(unfolded[n], 0) << sheet.x0[n].transpose();
}

} // namespace
} // namespace plyform::unfolded_test
