// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/intersections.hpp"
#include "support/sheet_grid.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <numeric>
#include <ostream>
#include <random>
#include <set>
#include <stdexcept>
#include <variant>

namespace plyform {

static void PrintTo(const Intersection& i, std::ostream* out) {
  *out << "(" << i.sheet_a << ":" << i.a << " " << i.sheet_b << ":" << i.b << ")";
}

} // namespace plyform

namespace plyform::intersections_test {
namespace {

// ---- the oracle: every pair, by constructing the intersection in exact arithmetic ----

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Kernel::Point_3;
using Segment = Kernel::Segment_3;
using Shape = std::variant<Point, Segment, Kernel::Triangle_3>;

Shape shape_of(const std::array<Point, 3>& x) {
  if (!CGAL::collinear(x[0], x[1], x[2])) return Kernel::Triangle_3(x[0], x[1], x[2]);
  const Point low = std::min({x[0], x[1], x[2]}), high = std::max({x[0], x[1], x[2]});
  if (low == high) return low;
  return Segment(low, high);
}

struct CornersOf {
  std::vector<Point> operator()(const Point& p) const { return {p}; }
  std::vector<Point> operator()(const Segment& s) const { return {s[0], s[1]}; }
  std::vector<Point> operator()(const Kernel::Triangle_3& t) const { return {t[0], t[1], t[2]}; }
  std::vector<Point> operator()(const std::vector<Point>& polygon) const { return polygon; }
};

/// Corners of the (convex) intersection; empty if there is none.
std::vector<Point> intersection_corners(const Shape& a, const Shape& b) {
  return std::visit(
      [](const auto& s, const auto& t) -> std::vector<Point> {
        const auto common = CGAL::intersection(s, t);
        if (!common) return {};
        return boost::apply_visitor([](const auto& part) { return CornersOf{}(part); }, *common);
      },
      a, b);
}

bool on_hull(const Point& p, const std::vector<Point>& shared) {
  if (shared.size() == 1) return p == shared[0];
  return shared[0] == shared[1] ? p == shared[0] : Segment(shared[0], shared[1]).has_on(p);
}

bool pair_intersects(const MeshView& f, int i, const MeshView& g, int j, bool one_sheet) {
  const auto point = [](const MeshView& s, int n) {
    return Point(s.x[n].x(), s.x[n].y(), s.x[n].z());
  };
  std::array<Point, 3> a, b;
  for (int k = 0; k < 3; ++k) {
    a[k] = point(f, f.triangles[i][k]);
    b[k] = point(g, g.triangles[j][k]);
  }
  const std::vector<Point> common = intersection_corners(shape_of(a), shape_of(b));
  std::set<int> nodes(f.triangles[i].begin(), f.triangles[i].end()), shared;
  if (one_sheet)
    for (const int n : g.triangles[j])
      if (nodes.count(n)) shared.insert(n);
  if (shared.empty() || shared.size() == 3) return !common.empty();
  std::vector<Point> hull;
  for (const int n : shared)
    hull.push_back(point(f, n));
  for (const Point& p : common)
    if (!on_hull(p, hull)) return true;
  return false;
}

Intersections every_pair(const std::vector<MeshView>& sheets) {
  Intersections all;
  for (int s = 0; s < int(sheets.size()); ++s)
    for (int t = s; t < int(sheets.size()); ++t)
      for (int i = 0; i < int(sheets[s].triangles.size()); ++i)
        for (int j = s == t ? i + 1 : 0; j < int(sheets[t].triangles.size()); ++j)
          if (pair_intersects(sheets[s], i, sheets[t], j, s == t))
            (s == t ? all.within : all.between).push_back({s, i, t, j});
  std::sort(all.between.begin(), all.between.end());
  std::sort(all.within.begin(), all.within.end());
  return all;
}

// ---- sheets ----

Map flat(double z) {
  return [z](double x, double y) { return Vec3(x, y, z); };
}

/// Draped over a ball of this radius about (10, 10, 0): distance along the sheet is angle.
Map ball(double radius) {
  return [radius](double x, double y) {
    const Vec2 r(x - 10.0, y - 10.0);
    const double angle = r.norm() / radius;
    const Vec2 out = r.norm() > 0.0 ? Vec2(r.normalized() * std::sin(angle)) : Vec2(0.0, 0.0);
    return Vec3(radius * (Vec3(out.x(), out.y(), std::cos(angle))));
  };
}

std::vector<MeshView> views(const std::vector<TriMesh>& sheets) {
  std::vector<MeshView> all;
  for (const TriMesh& s : sheets)
    all.push_back({s.x, s.triangles});
  return all;
}

Intersections audit(const std::vector<TriMesh>& sheets) {
  const Intersections found = find_intersections(views(sheets));
  const Intersections last_first =
      find_intersections(views(sheets), [](int count, const std::function<void(int)>& task) {
        for (int i = count; i-- > 0;)
          task(i);
      });
  EXPECT_EQ(found.between, last_first.between);
  EXPECT_EQ(found.within, last_first.within);
  return found;
}

void expect_every_pair(const std::vector<TriMesh>& sheets, const Intersections& found) {
  const Intersections expected = every_pair(views(sheets));
  EXPECT_EQ(found.between, expected.between);
  EXPECT_EQ(found.within, expected.within);
}

void expect_clean(const std::vector<TriMesh>& sheets) {
  const Intersections found = audit(sheets);
  EXPECT_TRUE(found.between.empty()) << found.between.size();
  EXPECT_TRUE(found.within.empty()) << found.within.size();
}

TEST(Audit, CleanStacksHaveNoIntersections) {
  expect_clean({});
  expect_clean({TriMesh{}});
  expect_clean({grid(20, 20, 1.0, flat(0.0)), grid(20, 20, 1.0, flat(0.3)),
                grid(13, 13, 1.6, flat(1e-9 + 0.3))});
  // Same mesh lines on every ball, so that flat facets keep the radii's distance.
  expect_clean({grid(40, 40, 0.5, ball(12.0)), grid(40, 40, 0.5, [](double x, double y) {
                  return Vec3(ball(12.0)(x, y) * (1.0 + 1e-6));
                })});
}

TEST(Audit, FindsPlantedIntersectionOfAnyDepth) {
  for (const double depth : {0.2, 1e-3, 1e-6, 1e-9}) {
    for (const double z : {0.0, 1e3}) { // at z = 1e3, 1e-9 is 9000 ulps
      SCOPED_TRACE(testing::Message() << depth << " at " << z);
      std::vector<TriMesh> stack{grid(20, 20, 1.0, flat(z)), grid(20, 20, 1.0, flat(z + 0.3)),
                                 grid(8, 8, 2.5, flat(z + 0.6))};
      stack[1].x[10 * 21 + 10] = {10.4, 10.2, z + 0.6 + depth}; // pokes into cell (4, 4) of sheet 2
      const Intersections found = audit(stack);
      EXPECT_FALSE(found.between.empty());
      EXPECT_TRUE(found.within.empty());
      for (const Intersection& i : found.between)
        EXPECT_TRUE(i.sheet_a == 1 && i.sheet_b == 2);
      if (depth == 1e-9) {
        EXPECT_EQ(found.between.size(), 6u); // the six faces round the node
      }
      stack[1].x[10 * 21 + 10].z() = z + 0.6 - depth;
      expect_clean(stack);
    }
  }
}

TEST(Audit, EqualsBruteForceOnCrossingSheets) {
  const std::vector<TriMesh> sheets{grid(12, 12, 1.0, flat(0.0)),
                                    grid(10, 10, 1.3,
                                         [](double x, double y) {
                                           return Vec3(x + 0.1, y - 0.2,
                                                       0.5 * std::sin(x) * std::cos(0.7 * y));
                                         }),
                                    grid(5, 5, 2.0, flat(0.0))};
  const Intersections found = audit(sheets);
  EXPECT_GT(found.between.size(), 300u);
  expect_every_pair(sheets, found);
}

TEST(Audit, FindsSheetCrossingItself) {
  // A ribbon along the curve (t^2, t^3 - 2 t), which crosses itself at t = +-sqrt 2.
  const std::vector<TriMesh> loop{grid(33, 6, 0.11, [](double s, double y) {
    const double t = s - 1.8;
    return Vec3(t * t, y, t * t * t - 2.0 * t);
  })};
  const Intersections found = audit(loop);
  EXPECT_GE(found.within.size(), 12u);
  expect_every_pair(loop, found);
}

TEST(Audit, FindsFlatFold) {
  // Folded along a mesh line and laid exactly flat on itself: every overlap is coplanar.
  const std::vector<TriMesh> folded{
      grid(8, 4, 1.0, [](double x, double y) { return Vec3(x <= 4.0 ? x : 8.0 - x, y, 0.0); })};
  const Intersections found = audit(folded);
  expect_every_pair(folded, found);
  // The pairs that share the edge of the fold are among them.
  for (int row = 0; row < 4; ++row) {
    const int left = 2 * (8 * row + 3), right = left + 3; // share the edge x = 4 of this row
    EXPECT_TRUE(std::binary_search(found.within.begin(), found.within.end(),
                                   Intersection{0, left, 0, right}));
  }
  // Opened by 1e-9 it is a fold, but no intersection.
  expect_clean({grid(8, 4, 1.0, [](double x, double y) {
    return Vec3(x <= 4.0 ? x : 8.0 - x, y, x <= 4.0 ? 0.0 : 1e-9 * (x - 4.0));
  })});
}

TEST(Audit, NeighboursAreNoIntersection) {
  expect_clean({grid(30, 30, 0.7, flat(0.0))}); // coplanar neighbours all over
  expect_clean({grid(30, 30, 0.7, [](double x, double y) {
    return Vec3(x, y, 2.0 * std::sin(3.0 * x) * std::sin(2.0 * y));
  })});
  // Between sheets there are no neighbours: the same sheet twice touches everywhere.
  const TriMesh sheet = grid(3, 3, 1.0, flat(0.0));
  const Intersections twice = audit({sheet, sheet});
  EXPECT_TRUE(twice.within.empty());
  expect_every_pair({sheet, sheet}, twice);
}

TEST(Audit, NeighboursThatCrossBeyondTheSharedNodeAreFound) {
  // Two triangles share node 0; the second one's tip is moved through the first.
  TriMesh pair{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {1, 0.5, 1}, {0.5, 1, 1}}, {{0, 1, 2}, {0, 3, 4}}};
  expect_clean({pair});
  pair.x[4].z() = -1.0;
  EXPECT_EQ(audit({pair}).within, (std::vector<Intersection>{{0, 0, 0, 1}}));
  pair.x[4] = {0.5, 1, 0}; // touches with an edge
  EXPECT_EQ(audit({pair}).within.size(), 1u);
  pair.x[4] = {-0.5, -1, -1}; // crosses the plane, but on the far side of the node
  expect_clean({pair});
}

TEST(Audit, TouchingExactlyCounts) {
  const TriMesh floor{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}};
  const Vec3 touches[] = {{1, 1, 0}, {2, 2, 0}, {0, 0, 0}, {2, 0, 0}}; // face, edges, vertex
  for (const Vec3& tip : touches) {
    TriMesh above{{tip, {1, 1, 3}, {1, 2, 3}}, {{0, 1, 2}}};
    EXPECT_EQ(audit({floor, above}).between, (std::vector<Intersection>{{0, 0, 1, 0}}));
    above.x[0].z() = std::numeric_limits<double>::denorm_min();
    expect_clean({floor, above});
  }
  // Within one sheet too, when the nodes are different ones.
  const TriMesh one{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {4, 0, 0}, {5, 5, 3}, {5, 1, 3}},
                    {{0, 1, 2}, {3, 4, 5}}};
  EXPECT_EQ(audit({one}).within, (std::vector<Intersection>{{0, 0, 0, 1}}));
}

/// Corners on a small integer lattice: coplanar, touching, coincident and degenerate triangles
/// are all frequent.
TriMesh lattice_soup(std::mt19937& random, int triangles, int nodes, int cells) {
  std::uniform_int_distribution<int> place(0, cells), node(0, nodes - 1);
  TriMesh soup;
  for (int i = 0; i < nodes; ++i)
    soup.x.push_back(Vec3(place(random), place(random), place(random)));
  for (int i = 0; i < triangles; ++i)
    soup.triangles.push_back({node(random), node(random), node(random)});
  return soup;
}

TEST(Audit, EqualsBruteForceOnLatticeSoups) {
  std::mt19937 random(11);
  std::size_t within = 0, between = 0, pairs = 0;
  for (int round = 0; round < 60; ++round) {
    SCOPED_TRACE(round);
    // Few nodes: most pairs are neighbours, many triangles name a node twice.
    const int cells = 1 + round % 4, nodes = 6 + round % 9;
    std::vector<TriMesh> soups{lattice_soup(random, 20, nodes, cells),
                               lattice_soup(random, 12, 30, cells)};
    const Intersections found = audit(soups);
    expect_every_pair(soups, found);
    within += found.within.size();
    between += found.between.size();
    pairs += 20 * 19 / 2 + 12 * 11 / 2 + 20 * 12;
  }
  EXPECT_GT(within, 1000u);
  EXPECT_GT(between, 1000u);
  EXPECT_LT(within + between, pairs - 1000);
}

TEST(Audit, EqualsBruteForceOnRandomSoups) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto vector = [&] { return Vec3(unit(random), unit(random), unit(random)); };
  TriMesh soup;
  for (int t = 0; t < 150; ++t) {
    const Vec3 centre = vector();
    for (int k = 0; k < 3; ++k)
      soup.x.push_back(centre + 0.4 * vector());
    soup.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  const Intersections found = audit({soup});
  EXPECT_GT(found.within.size(), 50u);
  expect_every_pair({soup}, found);
}

TEST(Audit, CollapsedNeighboursMeetOnlyWhereTheyPointTheSameWay) {
  // Nodes 0 and 1 in one place, 2 and 3 on either side of it, 4 beyond 3: faces are segments.
  const std::vector<Vec3> x{{1, 1, 1}, {1, 1, 1}, {0, 0, 0}, {2, 2, 2}, {3, 3, 3}, {2, 2, 1}};
  const struct {
    Triangle a, b;
    bool meet;
  } cases[] = {{{0, 1, 2}, {0, 1, 3}, false}, {{0, 1, 3}, {1, 0, 4}, true},
               {{0, 1, 3}, {0, 1, 5}, false}, {{2, 3, 0}, {3, 2, 1}, false},
               {{2, 0, 3}, {0, 2, 4}, true},  {{2, 3, 4}, {2, 3, 5}, false},
               {{3, 0, 2}, {0, 4, 4}, true},  {{2, 0, 0}, {0, 4, 4}, false}};
  for (const auto& [a, b, meet] : cases) {
    const std::vector<TriMesh> sheet{{x, {a, b}}};
    SCOPED_TRACE(testing::PrintToString(a) + " " + testing::PrintToString(b));
    const Intersections found = audit(sheet);
    EXPECT_EQ(found.within.size(), meet ? 1u : 0u);
    expect_every_pair(sheet, found);
  }
}

TEST(Audit, OrderOfTrianglesDoesNotChangeThePairs) {
  std::mt19937 random(13);
  const TriMesh soup = lattice_soup(random, 60, 40, 4);
  std::vector<int> order(soup.triangles.size());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), random);
  TriMesh shuffled = soup;
  for (std::size_t i = 0; i < order.size(); ++i) {
    shuffled.triangles[i] = soup.triangles[order[i]];
    std::rotate(shuffled.triangles[i].begin(), shuffled.triangles[i].begin() + i % 3,
                shuffled.triangles[i].end());
  }
  std::vector<Intersection> back;
  for (const Intersection& i : audit({shuffled}).within)
    back.push_back({0, std::min(order[i.a], order[i.b]), 0, std::max(order[i.a], order[i.b])});
  std::sort(back.begin(), back.end());
  const Intersections found = audit({soup});
  EXPECT_GT(found.within.size(), 100u);
  EXPECT_EQ(back, found.within);
}

TEST(Audit, WrongInputIsRefusedNamingTheNode) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity}) {
    std::vector<TriMesh> sheets{grid(2, 2, 1.0, flat(0.0)), grid(2, 2, 1.0, flat(1.0))};
    sheets[1].x[5].y() = bad;
    try {
      audit(sheets);
      ADD_FAILURE() << "accepted " << bad;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find("node 5 of sheet 1"), std::string::npos)
          << error.what();
    }
  }
  TriMesh sheet = grid(2, 2, 1.0, flat(0.0));
  sheet.triangles[3][1] = 9;
  EXPECT_THROW(audit({sheet}), std::runtime_error);
}

} // namespace
} // namespace plyform::intersections_test
