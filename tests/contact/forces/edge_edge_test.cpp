// SPDX-License-Identifier: GPL-3.0-or-later
// Contact of folded edges and rims: forces against finite differences, balance, sides, search.
#include "contact/forces/edge_edge.hpp"
#include "support/contact_checks.hpp"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <numbers>
#include <set>

namespace plyform::edge_edge_test {
namespace {

constexpr double thickness = 0.6; // h, mm
constexpr double distance = 0.5 * thickness;

/// A roof of two triangles over the edge from (-5,0,0) to (5,0,0), seen from `up` = +-1, turned by
/// `angle` about z.
OwnedSheet roof(double up, double angle, double z) {
  OwnedSheet sheet = points_only({{-5, 0, 0}, {5, 0, 0}, {0, -4, -up * 3}, {0, 4, -up * 3}}, 4.0);
  for (Vec3& x : sheet.x)
    x = Eigen::AngleAxisd(angle, Vec3::UnitZ()) * x + Vec3(0, 0, z);
  sheet.triangles = {{0, 1, 3}, {1, 0, 2}};
  return sheet;
}

/// The edges of a sheet, all of them looked at: its patches move so far that no pair is left out.
struct AllEdges {
  const OwnedSheet& of;
  SheetEdges edges;
  std::vector<std::int32_t> numbers;
  std::vector<Box3> motion;
  explicit AllEdges(const OwnedSheet& sheet)
      : of(sheet), edges(sheet_edges(sheet.triangles, sheet.x)), numbers(edges.all.size()),
        motion(edges.patch_nodes.size(), Box3(Vec3::Zero(), Vec3::Constant(100.0))) {
    std::iota(numbers.begin(), numbers.end(), 0);
  }
  EdgeSheet sheet() const { return {of.state(), edges, motion}; }
};

void search(EdgeEdgeContact& contact, const OwnedSheet& a, const OwnedSheet& b, double skin) {
  const AllEdges of_a(a), of_b(b);
  find_edge_pairs(contact, of_a.sheet(), of_a.numbers, of_b.sheet(), of_b.numbers, skin);
}

/// The edges of all candidates.
std::vector<std::array<std::int32_t, 2>> candidates(const EdgeEdgeContact& contact) {
  std::vector<std::array<std::int32_t, 2>> all;
  for (const EdgeCandidate& c : contact.candidates)
    all.push_back(c.edge);
  return all;
}

/// A contact with what it does to both sheets' nodes.
struct Loaded : EdgeEdgeContact {
  std::vector<Vec3> force_a, force_b; ///< N
};

void press(Loaded& contact, const OwnedSheet& a, const OwnedSheet& b, double dt) {
  contact.force_a.assign(a.x.size(), Vec3::Zero());
  contact.force_b.assign(b.x.size(), Vec3::Zero());
  const AllEdges of_a(a), of_b(b);
  edge_forces(contact, of_a.sheet(), of_b.sheet(), dt, contact.force_a, contact.force_b);
}

Loaded contact_of(const ContactLaw& law) {
  Loaded contact;
  contact.law = law;
  contact.distance = distance;
  return contact;
}

/// Two ridges across each other, `gap` mm apart, nodes moved at random.
struct Ridges {
  OwnedSheet a, b;
  Ridges(Random& random, double angle, double gap)
      : a(roof(1.0, 0.0, 0.0)), b(roof(-1.0, angle, gap)) {
    for (OwnedSheet* sheet : {&a, &b})
      for (Vec3& x : sheet->x)
        x += Vec3(0.5, 0.5, 0.02).cwiseProduct(random_vector(random));
  }
};

TEST(EdgeEdgeContact, ForceIsMinusEnergyGradient) {
  Random random(1);
  double worst = 0.0;
  for (int state = 0; state < 40; ++state) {
    // some already crossed: the last argument of Ridges is where they go after the search
    Ridges r(random, 0.3 + 0.06 * state, 0.2);
    Loaded contact = contact_of({3.0, 0.0, 0.0});
    search(contact, r.a, r.b, 0.5);
    press(contact, r.a, r.b, 0.0); // the side
    const double further = state % 4 == 3 ? 0.3 : 0.05;
    for (Vec3& x : r.b.x)
      x.z() -= further;
    press(contact, r.a, r.b, 0.0);
    ASSERT_EQ(contact.sums.touching, 1) << state;
    const auto energy = [&] {
      Loaded copy = contact;
      press(copy, r.a, r.b, 0.0);
      return copy.sums.elastic;
    };
    const std::vector<Vec3> on_a = contact.force_a, on_b = contact.force_b;
    // h = 1e-5 mm beside a penetration of 0.1 mm or more
    const double a_error = gradient_error(r.a.x, on_a, 1e-5, energy);
    const double b_error = gradient_error(r.b.x, on_b, 1e-5, energy);
    EXPECT_LE(a_error, 1e-6) << state;
    EXPECT_LE(b_error, 1e-6) << state;
    worst = std::max({worst, a_error, b_error});
    Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
    for (std::size_t n = 0; n < 4; ++n) {
      sum += on_a[n] + on_b[n];
      moment += r.a.x[n].cross(on_a[n]) + r.b.x[n].cross(on_b[n]);
    }
    EXPECT_LE(sum.norm(), 1e-14 * largest_norm(on_a)); // rounding
    EXPECT_LE(moment.norm(), 1e-12 * largest_norm(on_a));
    // the upper ridge is pushed up, also when it has come through
    EXPECT_GT(on_b[0].z() + on_b[1].z(), 0.0);
  }
  RecordProperty("worst", fmt::format("{:.2g}", worst));
}

TEST(EdgeEdgeContact, RemembersItsSideAcrossASearch) {
  Random random(2);
  Ridges r(random, 1.2, 0.2);
  Loaded contact = contact_of({3.0, 0.0, 0.0});
  search(contact, r.a, r.b, 0.5);
  press(contact, r.a, r.b, 0.0);
  for (Vec3& x : r.b.x)
    x.z() -= 0.4;
  press(contact, r.a, r.b, 0.0);
  const std::vector<Vec3> before = contact.force_b;
  EXPECT_GT(contact.sums.penetration, distance);
  search(contact, r.a, r.b, 0.5);
  press(contact, r.a, r.b, 0.0);
  for (std::size_t n = 0; n < 4; ++n)
    EXPECT_EQ((before[n] - contact.force_b[n]).norm(), 0.0);
}

TEST(EdgeEdgeContact, DampingTakesEnergyOnly) {
  Random random(3);
  Ridges r(random, 1.2, 0.25);
  Loaded contact = contact_of({3.0, 1e-6, 0.0});
  search(contact, r.a, r.b, 0.5);
  double last = 0.0;
  for (int i = 0; i < 40; ++i) { // in and out again
    for (Vec3& x : r.b.x)
      x.z() += 0.02 * std::cos(0.2 * i + std::numbers::pi);
    press(contact, r.a, r.b, 1e-6);
    EXPECT_GE(contact.sums.damping, last);
    EXPECT_GE(contact.force_b[0].z(), 0.0); // no adhesion
    last = contact.sums.damping;
  }
  EXPECT_GT(last, 0.0);
}

TEST(EdgeEdgeContact, EveryEdgeIsListedOnce) {
  const OwnedSheet sheet = square_sheet(4, 5.0, 0.0);
  const std::vector<SheetEdge> edges = sheet_edges(sheet.triangles, sheet.x).all;
  EXPECT_EQ(edges.size(), 4u * 5 * 2 + 16); // sides of cells and diagonals
  for (std::size_t i = 1; i < edges.size(); ++i)
    EXPECT_LT(std::pair(edges[i - 1].a, edges[i - 1].b), std::pair(edges[i].a, edges[i].b));
}

TEST(EdgeEdgeContact, FindsEveryPairWithinReach) {
  Random random(4);
  for (int state = 0; state < 10; ++state) {
    OwnedSheet a = square_sheet(5, 4.0, 0.0), b = square_sheet(6, 3.3, 0.8);
    for (OwnedSheet* sheet : {&a, &b})
      for (Vec3& x : sheet->x)
        x += Vec3(0.5, 0.5, 0.7).cwiseProduct(random_vector(random));
    Loaded contact = contact_of({1.0, 0.0, 0.0});
    constexpr double skin = 0.5;
    search(contact, a, b, skin);
    const auto listed = candidates(contact);
    std::set<std::array<std::int32_t, 2>> found(listed.begin(), listed.end());
    EXPECT_EQ(found.size(), listed.size());
    const AllEdges edges_a(a), edges_b(b);
    int near = 0;
    for (const std::int32_t i : edges_a.numbers)
      for (const std::int32_t j : edges_b.numbers) {
        const SheetEdge &e = edges_a.edges.all[i], &g = edges_b.edges.all[j];
        double nearest = 1e300; // by points along both: never below the true distance
        for (int s = 0; s <= 30; ++s)
          for (int t = 0; t <= 30; ++t) {
            const auto on = [](const OwnedSheet& sheet, const SheetEdge& edge, int part) -> Vec3 {
              return sheet.x[edge.a] + part / 30.0 * (sheet.x[edge.b] - sheet.x[edge.a]);
            };
            nearest = std::min(nearest, (on(a, e, s) - on(b, g, t)).norm());
          }
        if (nearest > distance + skin) continue;
        ++near;
        EXPECT_TRUE(found.contains({i, j})) << state;
      }
    EXPECT_GT(near, 20);
  }
}

TEST(EdgeEdgeContact, IsLinearWhileShallowAndHasNoEndBeforeItsLimit) {
  constexpr double k = 3.0, limit = 0.5 * distance;
  const ContactLaw law{k, 0.0, 0.0, limit};
  const auto force_at = [&](double gap) {
    OwnedSheet a = roof(-1.0, 0.0, gap), b = roof(1.0, 0.5 * std::numbers::pi, 0.0);
    Loaded contact = contact_of(law);
    search(contact, a, b, 0.1);
    press(contact, a, b, 0.0);
    return (contact.force_a[0] + contact.force_a[1]).z() / contact.pairs.at(0).area;
  };
  EXPECT_NEAR(force_at(distance - 0.003), k * 0.003, 1e-3 * k * 0.003); // (1 - u^2)^-2 at u = 0.02
  EXPECT_GT(force_at(distance - 0.999 * limit), 1e5 * k * limit);       // (1 - u^2)^2 = 4e-6
}

TEST(EdgeEdgeContact, TellsHowMuchLongerTheNextStepMayBe) {
  const ContactLaw law{3.0, 0.0, 0.0, 0.5 * distance};
  OwnedSheet a = roof(-1.0, 0.0, distance + 0.02), b = roof(1.0, 0.5 * std::numbers::pi, 0.0);
  Loaded contact = contact_of(law);
  search(contact, a, b, 0.1);
  press(contact, a, b, 0.0);
  for (Vec3& x : a.x)
    x.z() -= 0.01;
  press(contact, a, b, 0.0);
  // 0.01 mm from touching, closing by 0.01 mm a step: to the share of the depth limit
  EXPECT_NEAR(contact.sums.step_ratio, (0.01 + room_in_a_step(law, 0.0)) / 0.01, 1e-9);
}

/// Two crumpled sheets that are carried away together and rub against each other on the way.
struct CarriedSheets {
  OwnedSheet a = square_sheet(8, 4.0, 0.0), b = square_sheet(9, 3.3, 1.0);
  std::vector<Vec3> own_a, own_b; ///< mm, displacements of the nodes in a step without the carrying

  explicit CarriedSheets(Random& random) {
    const auto crumple = [&random](OwnedSheet& sheet, std::vector<Vec3>& own, double down) {
      for (Vec3& x : sheet.x) {
        x += Vec3(0.5, 0.5, 0.4).cwiseProduct(random_vector(random));
        own.push_back(0.004 * random_vector(random) - Vec3(0, 0, down));
      }
    };
    crumple(a, own_a, 0.0);
    crumple(b, own_b, 0.01);
  }
  void step() {
    const auto move = [](OwnedSheet& sheet, std::vector<Vec3> own) {
      for (Vec3& u : own)
        u += Vec3(0.3, -0.2, 0.5);
      sheet.move(own);
    };
    move(a, own_a);
    move(b, own_b);
  }
};

TEST(EdgeEdgeContact, LeavesPairsAloneThatMoveTogetherAndMissesNone) {
  Random random(6);
  CarriedSheets sheets(random);
  Loaded contact = contact_of({3.0, 0.0, 0.0}), all = contact;
  search(contact, sheets.a, sheets.b, 2.0);
  search(all, sheets.a, sheets.b, 2.0);
  const AllEdges of_a(sheets.a), of_b(sheets.b);
  int touched = 0, active = 0, of = 0;
  for (int i = 0; i < 60; ++i) {
    sheets.step();
    press(all, sheets.a, sheets.b, 0.0);
    std::vector<Box3> boxes_a, boxes_b;
    patch_motions(of_a.edges, sheets.a.motion, boxes_a);
    patch_motions(of_b.edges, sheets.b.motion, boxes_b);
    contact.force_a.assign(sheets.a.x.size(), Vec3::Zero());
    contact.force_b.assign(sheets.b.x.size(), Vec3::Zero());
    edge_forces(contact, {sheets.a.state(), of_a.edges, boxes_a},
                {sheets.b.state(), of_b.edges, boxes_b}, 0.0, contact.force_a, contact.force_b);
    touched += contact.sums.touching;
    EXPECT_EQ(contact.sums.touching, all.sums.touching) << i;
    for (std::size_t n = 0; n < contact.force_b.size(); ++n)
      EXPECT_EQ((contact.force_b[n] - all.force_b[n]).norm(), 0.0) << i;
    active += static_cast<int>(contact.measurements.due.size());
    of += static_cast<int>(all.measurements.due.size());
  }
  EXPECT_GT(touched, 500);
  EXPECT_LT(active, of / 2); // while they are carried 37 mm
}

/// A strip of two columns of cells of 10 mm along x, bent back over itself at x = 20: its two
/// halves lie `gap` mm apart.
OwnedSheet folded_strip(double gap) {
  std::vector<Vec3> x;
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; j <= 1; ++j)
      x.emplace_back(i <= 2 ? 10.0 * i : 10.0 * (4 - i) + 3.0, 10.0 * j, i <= 2 ? 0.0 : gap);
  OwnedSheet sheet = points_only(x, 4.0);
  for (int i = 0; i < 4; ++i) {
    const int n = 2 * i;
    sheet.triangles.push_back({n, n + 2, n + 1});
    sheet.triangles.push_back({n + 1, n + 2, n + 3});
  }
  return sheet;
}

TEST(EdgeEdgeContact, OfASheetWithItselfLeavesOutNeighboursAndGivesEachPairOnce) {
  const OwnedSheet sheet = folded_strip(0.2);
  std::vector<Vec3> x0;
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; j <= 1; ++j)
      x0.emplace_back(10.0 * i, 10.0 * j, 0.0);
  const AllEdges all(sheet);
  EdgeEdgeContact contact;
  contact.distance = distance;
  for (const double apart : {1.8, 12.0}) {
    find_edge_pairs(contact, all.sheet(), all.numbers, all.sheet(), all.numbers, 0.3, {x0, apart});
    const auto listed = candidates(contact);
    std::set<std::array<std::int32_t, 2>> found(listed.begin(), listed.end()), expected;
    for (std::size_t e = 0; e < all.edges.all.size(); ++e)
      for (std::size_t g = e + 1; g < all.edges.all.size(); ++g) { // every pair, by brute force
        const SheetEdge &a = all.edges.all[e], &b = all.edges.all[g];
        const bool share = a.a == b.a || a.a == b.b || a.b == b.a || a.b == b.b;
        if (!share && edge_distance({a.a, a.b}, x0, {b.a, b.b}, x0) >= apart &&
            edge_distance({a.a, a.b}, sheet.x, {b.a, b.b}, sheet.x) <= distance + 0.3)
          expected.insert({static_cast<std::int32_t>(e), static_cast<std::int32_t>(g)});
      }
    EXPECT_EQ(found, expected);
    EXPECT_EQ(found.size(), listed.size()); // none twice
    EXPECT_FALSE(found.empty());
  }
}

} // namespace
} // namespace plyform::edge_edge_test
