// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/point_triangle.hpp"
#include "contact/search/sheet_bvh.hpp"
#include "support/sheet_grid.hpp"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <ostream>
#include <random>
#include <stdexcept>
#include <thread>

namespace plyform {

static void PrintTo(const Candidate& c, std::ostream* out) {
  *out << "(" << c.node << ", " << c.face << ")";
}

} // namespace plyform

namespace plyform::sheet_bvh_test {
namespace {

/// nx x ny cells of size h from the origin, lifted to z(x, y).
TriMesh lifted(int nx, int ny, double h, const std::function<double(double, double)>& z) {
  return grid(nx, ny, h, [&](double x, double y) { return Vec3(x, y, z(x, y)); });
}

auto flat(double z) {
  return [z](double, double) { return z; };
}
auto dome(double top) {
  return [top](double x, double y) {
    return top - 0.04 * ((x - 10.0) * (x - 10.0) + (y - 10.0) * (y - 10.0));
  };
}

std::vector<Candidate> every_pair(const TriMesh& master, std::span<const Vec3> nodes,
                                  double reach) {
  std::vector<Candidate> all;
  for (int i = 0; i < int(nodes.size()); ++i)
    for (int t = 0; t < int(master.triangles.size()); ++t) {
      const auto [a, b, c] = master.triangles[t];
      const ClosestPoint q =
          closest_point_on_triangle(nodes[i], master.x[a], master.x[b], master.x[c]);
      if (q.distance2 <= reach * reach) all.push_back({i, t});
    }
  return all;
}

std::vector<Candidate> candidates(const SheetTree& tree, std::span<const Vec3> nodes,
                                  double reach) {
  std::vector<Candidate> found;
  tree.candidates(nodes, reach, found);
  return found;
}

void expect_every_pair(const TriMesh& master, const TriMesh& slave, double reach,
                       bool some = true) {
  const std::vector<Candidate> expected = every_pair(master, slave.x, reach);
  EXPECT_EQ(!expected.empty(), some) << "the oracle must have something to say";
  const SheetTree tree(master.x, master.triangles);
  EXPECT_EQ(candidates(tree, slave.x, reach), expected);
}

TEST(Candidates, EqualBruteForceOnFlatStack) {
  const TriMesh lower = lifted(20, 20, 1.0, flat(0.0)), upper = lifted(20, 20, 1.0, flat(0.3));
  for (const double reach : {0.3, 0.31, 1.0, 2.5}) {
    expect_every_pair(lower, upper, reach);
    expect_every_pair(upper, lower, reach);
  }
  expect_every_pair(lower, upper, 0.299, false);
}

TEST(Candidates, EqualBruteForceOnCurvedStack) {
  const TriMesh lower = lifted(20, 20, 1.0, dome(5.0)), upper = lifted(17, 17, 1.2, dome(5.4));
  expect_every_pair(lower, upper, 0.5);
  expect_every_pair(lower, upper, 1.5);
  expect_every_pair(upper, lower, 1.0);
}

TEST(Candidates, EqualBruteForceOnTouchingCoplanarAndCrossingSheets) {
  const TriMesh lower = lifted(20, 20, 1.0, flat(0.0));
  const TriMesh coplanar = lifted(9, 9, 1.7, flat(0.0));
  const TriMesh touching = lifted(20, 20, 1.0, [](double x, double) { return std::abs(x - 7.0); });
  const TriMesh crossing =
      lifted(20, 20, 1.0, [](double x, double y) { return 0.21 * (x - 9.3) + 0.1 * (y - 8.1); });
  for (const double reach : {0.0, 0.4, 1.0}) {
    expect_every_pair(lower, coplanar, reach);
    expect_every_pair(lower, touching, reach);
    expect_every_pair(lower, crossing, reach, reach > 0.0);
    expect_every_pair(lower, lower, reach); // its own triangles come too
  }
}

TEST(Candidates, EqualBruteForceForFineSheetOverCoarse) {
  const TriMesh coarse = lifted(3, 3, 7.0, dome(5.0)), fine = lifted(60, 60, 0.34, dome(5.2));
  expect_every_pair(coarse, fine, 0.6);
  expect_every_pair(fine, coarse, 0.6);
}

TEST(Candidates, EqualBruteForceAfterManyRefits) {
  const TriMesh flat_sheet = lifted(20, 20, 1.0, flat(0.0));
  TriMesh lower = flat_sheet;
  const TriMesh upper = lifted(20, 20, 1.0, dome(4.5));
  SheetTree tree(lower.x, lower.triangles);
  std::mt19937 random(7);
  std::normal_distribution<double> shake(0.0, 0.2);
  std::size_t found = 0;
  for (int step = 0; step <= 40; ++step) {
    // Drawn over the dome and turned a full round on the way, shaken anew at every step.
    const Eigen::AngleAxisd turn(step * M_PI / 20.0, Vec3(1.0, 2.0, 3.0).normalized());
    for (std::size_t i = 0; i < lower.x.size(); ++i) {
      const Vec3& x0 = flat_sheet.x[i];
      const Vec3 draped(x0.x(), x0.y(), dome(4.2)(x0.x(), x0.y()) * step / 40.0);
      lower.x[i] = turn * draped + Vec3(shake(random), shake(random), shake(random));
    }
    tree.refit(lower.x);
    const auto expected = every_pair(lower, upper.x, 0.9);
    ASSERT_EQ(candidates(tree, upper.x, 0.9), expected) << "step " << step;
    found += expected.size();
    Box3 box;
    for (const Vec3& x : lower.x)
      box.extend(x);
    ASSERT_EQ(tree.bounds().min(), box.min());
    ASSERT_EQ(tree.bounds().max(), box.max());
  }
  EXPECT_GT(found, 1000u);
}

TEST(Candidates, RefittedTreeAnswersLikeANewOne) {
  const TriMesh start = lifted(15, 15, 1.0, flat(0.0)), end = lifted(15, 15, 1.0, dome(6.0));
  SheetTree refitted(start.x, start.triangles);
  refitted.refit(end.x);
  const SheetTree fresh(end.x, end.triangles);
  const TriMesh nodes = lifted(15, 15, 1.0, dome(6.5));
  const auto answer = candidates(fresh, nodes.x, 1.0);
  EXPECT_GT(answer.size(), 100u);
  EXPECT_EQ(candidates(refitted, nodes.x, 1.0), answer);
}

TEST(Candidates, SingleTriangleSheet) {
  TriMesh master{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  const TriMesh slave{{{0.2, 0.2, 0.5}, {0.2, 0.2, 0.6}, {-0.5, 0, 0}, {-0.4, -0.4, 0}}, {}};
  const std::vector<Candidate> first{{0, 0}, {2, 0}}; // the corner node is 0.57 away
  EXPECT_EQ(candidates(SheetTree(master.x, master.triangles), slave.x, 0.5), first);
  SheetTree tree(master.x, master.triangles);
  for (Vec3& x : master.x)
    x.z() = 0.6;
  tree.refit(master.x);
  const std::vector<Candidate> second{{0, 0}, {1, 0}};
  EXPECT_EQ(candidates(tree, slave.x, 0.5), second);
}

TEST(Candidates, DegenerateTrianglesAreTheirSegmentOrPoint) {
  const TriMesh master{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 5, 5}, {5, 5, 5}, {5, 5, 5}},
                       {{0, 1, 2}, {0, 2, 1}, {3, 4, 5}, {0, 0, 2}, {3, 3, 3}}};
  const TriMesh slave{{{1.5, 0.5, 0}, {5, 5, 5.5}, {2.6, 0, 0}}, {}};
  const std::vector<Candidate> expected{{0, 0}, {0, 1}, {0, 3}, {1, 2}, {1, 4}};
  EXPECT_EQ(candidates(SheetTree(master.x, master.triangles), slave.x, 0.5), expected);
  EXPECT_EQ(every_pair(master, slave.x, 0.5), expected);
}

// Many triangles in one place give the tree's splitter nothing to separate.
TEST(Candidates, EqualBruteForceForCoincidentTriangles) {
  TriMesh master = lifted(2, 2, 1.0, flat(0.0));
  const std::vector<Triangle> once = master.triangles;
  for (int k = 0; k < 200; ++k)
    master.triangles.insert(master.triangles.end(), once.begin(), once.end());
  expect_every_pair(master, lifted(3, 3, 0.7, flat(0.1)), 0.2);
}

TEST(Candidates, ReachZeroFindsExactTouchOnly) {
  const TriMesh master = lifted(4, 4, 1.0, flat(0.0));
  const SheetTree tree(master.x, master.triangles);
  const std::vector<Vec3> nodes{
      {1.5, 1.25, 0.0}, {1.5, 1.25, 1e-9}, {1.5, 1.5, 0.0}, {-1e-9, 1.5, 0.0}, {2.0, 2.0, 0.0}};
  const std::vector<Candidate> found = candidates(tree, nodes, 0.0);
  EXPECT_EQ(found, every_pair(master, nodes, 0.0));
  std::array<int, 5> count{};
  for (const Candidate& c : found)
    ++count[c.node];
  EXPECT_EQ(count, (std::array<int, 5>{1, 0, 2, 0, 6})); // inside, above, on an edge, beside, node
}

// Distances that equal the reach up to rounding, far from the origin: the boxes must not prune
// what the narrow phase accepts.
TEST(Candidates, EqualBruteForceAtTheEdgeOfReach) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto vector = [&] { return Vec3(unit(random), unit(random), unit(random)); };
  int accepted = 0;
  for (int round = 0; round < 300; ++round) {
    const Vec3 far = 1e4 * vector();
    TriMesh master;
    for (int k = 0; k < 12; ++k)
      master.x.push_back(far + vector());
    for (int k = 0; k < 12; k += 3)
      master.triangles.push_back({k, k + 1, k + 2});
    std::vector<Vec3> nodes{far + 3.0 * vector(), far + 3.0 * vector()};
    if (round % 2 == 0) // boxes whose corner is a node and the closest point: as tight as can be
      for (int k = 0; k < 12; k += 3) {
        Vec3& corner = master.x[k + 1];
        corner = corner.cwiseMax(master.x[k]).cwiseMax(master.x[k + 2]);
        nodes.push_back(corner + Vec3(1.0, 1.0, 1.0) + vector());
      }
    const SheetTree tree(master.x, master.triangles);
    for (const Vec3& p : nodes)
      for (const auto& [a, b, c] : master.triangles) {
        const double d = std::sqrt(
            closest_point_on_triangle(p, master.x[a], master.x[b], master.x[c]).distance2);
        for (const double reach : {std::nextafter(d, 0.0), d, std::nextafter(d, 9.0)}) {
          const auto expected = every_pair(master, nodes, reach);
          accepted += int(expected.size());
          ASSERT_EQ(candidates(tree, nodes, reach), expected);
        }
      }
  }
  EXPECT_GT(accepted, 1000);
}

TEST(Candidates, AppendAndKeepWhatIsThere) {
  const TriMesh master = lifted(2, 2, 1.0, flat(0.0));
  const SheetTree tree(master.x, master.triangles);
  std::vector<Candidate> out{{7, 9}, {7, 8}};
  const std::vector<Vec3> nodes{{0.5, 0.25, 0.1}};
  tree.candidates(nodes, 0.1, out);
  EXPECT_EQ(out, (std::vector<Candidate>{{7, 9}, {7, 8}, {0, 0}}));
}

TEST(Candidates, SeveralThreadsMayAskOneTree) {
  const TriMesh lower = lifted(30, 30, 0.7, dome(5.0)), upper = lifted(30, 30, 0.7, dome(5.3));
  const SheetTree tree(lower.x, lower.triangles);
  const auto expected = every_pair(lower, upper.x, 0.8);
  ASSERT_GT(expected.size(), 1000u);
  std::array<std::vector<Candidate>, 4> found;
  {
    std::vector<std::jthread> threads;
    for (auto& mine : found)
      threads.emplace_back([&] { tree.candidates(upper.x, 0.8, mine); });
  }
  for (const auto& mine : found)
    EXPECT_EQ(mine, expected);
}

TEST(Candidates, WrongInputIsRefused) {
  TriMesh sheet = lifted(2, 2, 1.0, flat(0.0));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(SheetTree(sheet.x, {}), std::invalid_argument);
  EXPECT_THROW(SheetTree(sheet.x, std::vector<Triangle>{{0, 1, 9}}), std::invalid_argument);
  EXPECT_THROW(SheetTree(sheet.x, std::vector<Triangle>{{0, 1, -1}}), std::invalid_argument);
  SheetTree tree(sheet.x, sheet.triangles);
  std::vector<Candidate> out;
  EXPECT_THROW(tree.candidates(sheet.x, -1.0, out), std::invalid_argument);
  EXPECT_THROW(tree.candidates(sheet.x, nan, out), std::invalid_argument);
  EXPECT_THROW(tree.refit(std::span(sheet.x).first(8)), std::invalid_argument);
  sheet.x[4].y() = nan; // a node lost must not look like a node without contact
  EXPECT_THROW(tree.candidates(sheet.x, 1.0, out), std::invalid_argument);
  EXPECT_THROW(tree.refit(sheet.x), std::invalid_argument);
  EXPECT_TRUE(out.empty());
  tree.candidates(std::span(sheet.x).first(1), 0.0, out); // still as before the refused refit
  EXPECT_EQ(out.size(), 2u);
}

} // namespace
} // namespace plyform::sheet_bvh_test
