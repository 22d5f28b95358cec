// SPDX-License-Identifier: GPL-3.0-or-later
// Ridges: which edges have them, that none grows unnoticed, and that two sheets are closest to each
// other between ridges only.
#include "contact/forces/edge_edge.hpp"
#include "contact/point_triangle.hpp"
#include "support/contact_checks.hpp"

#include <gtest/gtest.h>
#include <numeric>

namespace plyform::sheet_ridges_test {
namespace {

constexpr double limit = 0.05;

/// A square sheet of 40 mm over z = height(x, y), its middle at the origin.
template <class Height>
OwnedSheet sheet_over(const Height& height, int cells = 10) {
  OwnedSheet sheet = square_sheet(cells, 40.0 / cells, 0.0);
  for (Vec3& x : sheet.x)
    x.z() = height(x.x(), x.y());
  return sheet;
}

SheetRidges ridges_of(const OwnedSheet& sheet, const SheetEdges& edges) {
  SheetRidges ridges;
  find_ridges(edges, sheet.x, limit, ridges);
  return ridges;
}

TEST(SheetRidges, OfADomePointOutwardsAndOfAFlatSheetAreNone) {
  for (const double up : {1.0, -1.0}) {
    const OwnedSheet dome =
        sheet_over([up](double x, double y) { return -up * (x * x + y * y) / 100.0; });
    const SheetEdges edges = sheet_edges(dome.triangles, dome.x);
    const SheetRidges ridges = ridges_of(dome, edges);
    for (std::size_t i = 0; i < edges.all.size(); ++i)
      EXPECT_EQ(ridges.sides[i], edges.all[i].is_free() ? ridge_both
                                 : up > 0               ? ridge_up
                                                        : ridge_down)
          << i;
  }
  const OwnedSheet flat = sheet_over([](double x, double y) { return 0.3 * x - 0.7 * y; });
  const SheetEdges edges = sheet_edges(flat.triangles, flat.x);
  const SheetRidges ridges = ridges_of(flat, edges);
  for (std::size_t i = 0; i < edges.all.size(); ++i)
    EXPECT_EQ(ridges.sides[i], edges.all[i].is_free() ? ridge_both : no_ridge) << i;
}

TEST(SheetRidges, OfParallelShellsDoNotFaceEachOther) {
  const Vec3 up = Vec3::UnitZ(), down = -up, across = Vec3::UnitX();
  EXPECT_FALSE(may_face(ridge_up, up, ridge_up, up)); // two plies on a dome
  EXPECT_TRUE(may_face(ridge_up, up, ridge_down, up));
  EXPECT_TRUE(may_face(ridge_both, up, ridge_up, up));
  EXPECT_TRUE(may_face(ridge_up, up, ridge_up, down)); // the layers of a fold
  EXPECT_FALSE(may_face(ridge_up, up, ridge_down, down));
  EXPECT_TRUE(may_face(ridge_up, up, ridge_up, across));
}

/// Whether an edge that is no ridge towards a side is folded to it by more than `limit`.
bool has_grown(const OwnedSheet& sheet, const SheetEdges& edges, const SheetRidges& ridges) {
  SheetRidges now; // those beyond the limit: a tenth of ten times it
  find_ridges(edges, sheet.x, 10.0 * limit, now);
  for (std::size_t i = 0; i < edges.all.size(); ++i)
    if (now.sides[i] & ~ridges.sides[i]) return true;
  return false;
}

// Folds stay below 2.5 times the limit, so that no edge counts for its neighbours' sake.
TEST(SheetRidges, NoneGrowsUnnoticed) {
  Random random(3);
  int noticed = 0, held = 0;
  for (int i = 0; i < 40; ++i) {
    OwnedSheet sheet = sheet_over([](double x, double y) { return (x * x - y * y) / 4000.0; });
    const SheetEdges edges = sheet_edges(sheet.triangles, sheet.x);
    SheetRidges ridges = ridges_of(sheet, edges);
    std::vector<Vec3> own(sheet.x.size()); // mm a step, besides a turn
    for (Vec3& u : own)
      u = 0.002 * random_vector(random);
    const Eigen::AngleAxisd turn(0.01, random_vector(random).normalized());
    for (int step = 0; step < 200; ++step) {
      std::vector<Vec3> motion;
      for (std::size_t n = 0; n < sheet.x.size(); ++n)
        motion.push_back(turn * sheet.x[n] + own[n] - sheet.x[n]);
      sheet.move(motion);
      std::vector<Box3> boxes;
      patch_motions(edges, motion, boxes);
      if (!follow_ridges(edges, sheet.x, boxes, limit, ridges)) {
        EXPECT_TRUE(has_grown(sheet, edges, ridges));
        ++noticed;
        break;
      }
      EXPECT_FALSE(has_grown(sheet, edges, ridges)) << i << " " << step;
      ++held;
    }
  }
  EXPECT_EQ(noticed, 40);
  EXPECT_GT(held, 400);
}

/// The smallest distance (mm) of a node of one sheet from a face of the other.
double nodes_to_faces(const OwnedSheet& a, const OwnedSheet& b) {
  double least2 = std::numeric_limits<double>::max();
  for (const Vec3& p : a.x)
    for (const Triangle& t : b.triangles)
      least2 =
          std::min(least2, closest_point_on_triangle(p, b.x[t[0]], b.x[t[1]], b.x[t[2]]).distance2);
  return std::sqrt(least2);
}

TEST(SheetRidges, AreWhereTwoSheetsAreClosestBetweenTheirNodes) {
  Random random(5);
  int closest_between = 0, listed = 0, of = 0;
  for (int i = 0; i < 60; ++i) {
    const auto roof = [&random](double z, double slope, double turn) {
      OwnedSheet sheet = sheet_over(
          [&](double, double y) { return z + slope * std::abs(y) + 0.005 * signed_unit(random); },
          6);
      const Vec3 shift(4.0 * signed_unit(random), 4.0 * signed_unit(random), 0.0);
      for (Vec3& x : sheet.x)
        x = Eigen::AngleAxisd(turn, Vec3::UnitZ()) * x + shift;
      return sheet;
    };
    const OwnedSheet a = roof(1.5, 0.3, 0.0), b = roof(0.0, -0.3, 1.5 + 0.6 * signed_unit(random));
    const SheetEdges edges_a = sheet_edges(a.triangles, a.x),
                     edges_b = sheet_edges(b.triangles, b.x);
    const SheetRidges ridges_a = ridges_of(a, edges_a), ridges_b = ridges_of(b, edges_b);
    std::vector<std::int32_t> all_a(edges_a.all.size()), all_b(edges_b.all.size());
    std::iota(all_a.begin(), all_a.end(), 0), std::iota(all_b.begin(), all_b.end(), 0);
    EdgeEdgeContact all, contact;
    contact.distance = all.distance = 0.3;
    find_edge_pairs(all, {a.state(), edges_a, {}}, all_a, {b.state(), edges_b, {}}, all_b, 9.0);
    find_edge_pairs(contact, {a.state(), edges_a, {}, ridges_a.sides}, all_a,
                    {b.state(), edges_b, {}, ridges_b.sides}, all_b, 9.0);
    listed += static_cast<int>(contact.candidates.size());
    of += static_cast<int>(all.candidates.size());
    const auto least = [&](const EdgeEdgeContact& c) {
      double distance = std::numeric_limits<double>::max();
      for (const EdgeCandidate& pair : c.candidates) {
        const SheetEdge &e = edges_a.all[pair.edge[0]], &g = edges_b.all[pair.edge[1]];
        distance = std::min(distance, edge_distance({e.a, e.b}, a.x, {g.a, g.b}, b.x));
      }
      return distance;
    };
    const double of_all = least(all);
    if (of_all > std::min(nodes_to_faces(a, b), nodes_to_faces(b, a)) - 1e-3) continue;
    ++closest_between;
    EXPECT_EQ(least(contact), of_all) << i;
  }
  EXPECT_GT(closest_between, 20);
  EXPECT_LT(listed, of * 2 / 3);
}

/// Edges of a sheet that are ridges at first, and those that become it later.
struct Growing {
  SheetEdges edges;
  std::vector<std::int32_t> all, grown;
  std::vector<char> before, after;
  Growing(const OwnedSheet& sheet, Random& random)
      : edges(sheet_edges(sheet.triangles, sheet.x)), all(edges.all.size()),
        before(edges.all.size(), ridge_both), after(before) {
    std::iota(all.begin(), all.end(), 0);
    for (const std::int32_t e : all)
      if (random() % 4 == 0) {
        before[at(e)] = no_ridge;
        grown.push_back(e);
      }
  }
};

/// A contact of the edges of two sheets, or of a folded one with itself, as it was searched before
/// edges grew to ridges, with path lengths since; then with what is added for them.
void expect_added(const OwnedSheet& a, const OwnedSheet& b, bool one_sheet) {
  Random random(7);
  const Growing of_a(a, random), of_b = one_sheet ? of_a : Growing(b, random);
  const auto sheet = [](const OwnedSheet& of, const Growing& edges,
                        const std::vector<char>& sides) {
    return EdgeSheet{of.state(), edges.edges, {}, sides};
  };
  const EdgeSheet before_a = sheet(a, of_a, of_a.before), before_b = sheet(b, of_b, of_b.before);
  const EdgeSheet after_a = sheet(a, of_a, of_a.after), after_b = sheet(b, of_b, of_b.after);
  const std::vector<Vec3> flat = square_sheet(8, 2.0, 0.0).x;
  const SelfEdges self = one_sheet ? SelfEdges{flat, 3.0} : SelfEdges{};
  constexpr double skin = 1.5, gone = 0.25;
  EdgeEdgeContact contact, whole;
  contact.distance = whole.distance = 0.3;
  find_edge_pairs(contact, before_a, of_a.all, before_b, of_b.all, skin, self);
  const EdgeEdgeContact first = contact;
  ASSERT_GT(first.candidates.size(), 40u);
  for (EdgeGroup& group : contact.groups)
    group.path_length = gone;
  for (const std::int32_t candidate : {3, 17, 18}) // pairs that are followed
    contact.pairs.push_back({candidate, {}, {}});
  add_edge_pairs(contact, after_a, of_a.all, of_a.grown, after_b, of_b.all, of_b.grown, skin, self);
  find_edge_pairs(whole, after_a, of_a.all, after_b, of_b.all, skin, self);
  ASSERT_EQ(contact.candidates.size(), whole.candidates.size());
  EXPECT_GT(whole.candidates.size(), first.candidates.size() * 4 / 3);
  ASSERT_EQ(contact.groups.size(), whole.groups.size());
  for (std::size_t g = 0; g < whole.groups.size(); ++g) {
    const EdgeGroup &group = contact.groups[g], &expected = whole.groups[g];
    EXPECT_EQ(group.patch, expected.patch);
    EXPECT_EQ(group.first, expected.first);
    EXPECT_EQ(group.end, expected.end);
    const bool known = std::any_of(first.groups.begin(), first.groups.end(),
                                   [&](const EdgeGroup& f) { return f.patch == group.patch; });
    EXPECT_EQ(group.path_length, known ? gone : 0.0);
    double least = std::numeric_limits<double>::max();
    for (std::int32_t i = group.first; i < group.end; ++i) {
      const EdgeCandidate &c = contact.candidates[at(i)], &now = whole.candidates[at(i)];
      EXPECT_EQ(c.edge, now.edge);
      const bool listed_before =
          std::any_of(first.candidates.begin(), first.candidates.end(),
                      [&c](const EdgeCandidate& f) { return f.edge == c.edge; });
      EXPECT_NEAR(c.free_until, now.free_until + (listed_before ? 0.0 : group.path_length), 1e-6);
      least = std::min(least, double{c.free_until});
    }
    EXPECT_EQ(group.free_until, least);
  }
  ASSERT_EQ(contact.pairs.size(), 3u);
  for (const auto& [pair, candidate] : {std::pair{0, 3}, {1, 17}, {2, 18}})
    EXPECT_EQ(contact.candidates[at(contact.pairs[std::size_t(pair)].candidate)].edge,
              first.candidates[at(candidate)].edge);
}

TEST(SheetRidges, NewOnesAreAddedToWhatWasSearched) {
  Random random(2);
  OwnedSheet a = square_sheet(8, 2.0, 0.8), b = square_sheet(8, 2.0, 0.0);
  for (OwnedSheet* sheet : {&a, &b})
    for (Vec3& x : sheet->x)
      x += 0.2 * random_vector(random);
  expect_added(a, b, false);
  OwnedSheet rolled = square_sheet(8, 2.0, 0.0); // a turn and a half, in 0.8 mm steps
  for (Vec3& x : rolled.x) {
    const double along = x.x() + 8.0, radius = 1.0 + 0.08 * along, angle = along / 1.7;
    x = Vec3(radius * std::cos(angle), x.y(), radius * std::sin(angle));
  }
  expect_added(rolled, rolled, true);
}

TEST(SheetRidges, AClosedPairStaysACandidateWhateverItsFold) {
  const auto cross = [](double z, bool along_x) {
    OwnedSheet sheet =
        points_only(along_x ? std::vector<Vec3>{{-5, 0, z}, {5, 0, z}, {0, 4, z}, {0, -4, z}}
                            : std::vector<Vec3>{{0, -5, z}, {0, 5, z}, {-4, 0, z}, {4, 0, z}},
                    4.0);
    sheet.triangles = {{0, 1, 2}, {1, 0, 3}};
    return sheet;
  };
  const OwnedSheet a = cross(0.2, true), b = cross(0.0, false); // flat
  const SheetEdges edges_a = sheet_edges(a.triangles, a.x), edges_b = sheet_edges(b.triangles, b.x);
  const SheetRidges flat_a = ridges_of(a, edges_a), flat_b = ridges_of(b, edges_b);
  const std::vector<std::int32_t> middle{0}; // from node 0 to node 1
  const std::vector<Box3> still(1, Box3(Vec3::Zero(), Vec3::Zero()));
  const EdgeSheet any_a{a.state(), edges_a, still}, any_b{b.state(), edges_b, still};
  const EdgeSheet of_a{a.state(), edges_a, still, flat_a.sides},
      of_b{b.state(), edges_b, still, flat_b.sides};
  EdgeEdgeContact contact;
  contact.law = {3.0, 0.0, 0.0};
  contact.distance = 0.3;
  find_edge_pairs(contact, of_a, middle, of_b, middle, 0.5);
  EXPECT_TRUE(contact.candidates.empty()); // two flat sheets
  find_edge_pairs(contact, any_a, middle, any_b, middle, 0.5);
  ASSERT_EQ(contact.candidates.size(), 1u);
  std::vector<Vec3> force_a(4, Vec3::Zero()), force_b(4, Vec3::Zero());
  edge_forces(contact, any_a, any_b, 0.0, force_a, force_b);
  ASSERT_EQ(contact.sums.touching, 1);
  find_edge_pairs(contact, of_a, middle, of_b, middle, 0.5);
  EXPECT_EQ(contact.candidates.size(), 1u);
  EXPECT_EQ(contact.pairs.size(), 1u);
}

} // namespace
} // namespace plyform::sheet_ridges_test
