// SPDX-License-Identifier: GPL-3.0-or-later
// Contact of folded edges and rims: forces against finite differences, balance, sides, search.
#include "contact/edge_contact.hpp"
#include "contact_checks.hpp"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <set>

namespace plyform {
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

constexpr double always = std::numeric_limits<double>::infinity(); // mm, no pair is left out

void search(EdgeContact& contact, const OwnedSheet& a, const OwnedSheet& b, double skin) {
  const auto edges_a = sheet_edges(a.triangles), edges_b = sheet_edges(b.triangles);
  find_edge_pairs(contact, a.state(), edges_a,
                  folded_edges(edges_a, a.triangles, a.x, least_sag * thickness, 0.0), b.state(),
                  edges_b, folded_edges(edges_b, b.triangles, b.x, least_sag * thickness, 0.0),
                  skin, 0.0);
}

/// A contact with what it does to both sheets' nodes.
struct Loaded : EdgeContact {
  std::vector<Vec3> force_a, force_b; ///< N
};

void press(Loaded& contact, const SheetState& a, const SheetState& b, double dt) {
  contact.force_a.assign(a.x.size(), Vec3::Zero());
  contact.force_b.assign(b.x.size(), Vec3::Zero());
  edge_forces(contact, a, b, dt, always, contact.force_a, contact.force_b);
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

TEST(EdgeContact, ForceIsMinusEnergyGradient) {
  Random random(1);
  double worst = 0.0;
  for (int state = 0; state < 40; ++state) {
    // some already crossed: the last argument of Ridges is where they go after the search
    Ridges r(random, 0.3 + 0.06 * state, 0.2);
    Loaded contact = contact_of({3.0, 0.0, 0.0});
    search(contact, r.a, r.b, 0.5);
    const double further = state % 4 == 3 ? 0.3 : 0.05;
    for (Vec3& x : r.b.x)
      x.z() -= further;
    press(contact, r.a.state(), r.b.state(), 0.0);
    ASSERT_EQ(contact.sums.touching, 1) << state;
    const auto energy = [&] {
      Loaded copy = contact;
      press(copy, r.a.state(), r.b.state(), 0.0);
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

TEST(EdgeContact, RemembersItsSideAcrossASearch) {
  Random random(2);
  Ridges r(random, 1.2, 0.2);
  Loaded contact = contact_of({3.0, 0.0, 0.0});
  search(contact, r.a, r.b, 0.5);
  for (Vec3& x : r.b.x)
    x.z() -= 0.4;
  press(contact, r.a.state(), r.b.state(), 0.0);
  const std::vector<Vec3> before = contact.force_b;
  EXPECT_GT(contact.sums.penetration, distance);
  search(contact, r.a, r.b, 0.5);
  press(contact, r.a.state(), r.b.state(), 0.0);
  for (std::size_t n = 0; n < 4; ++n)
    EXPECT_EQ((before[n] - contact.force_b[n]).norm(), 0.0);
}

TEST(EdgeContact, DampingTakesEnergyOnly) {
  Random random(3);
  Ridges r(random, 1.2, 0.25);
  Loaded contact = contact_of({3.0, 1e-6, 0.0});
  search(contact, r.a, r.b, 0.5);
  double last = 0.0;
  for (int i = 0; i < 40; ++i) { // in and out again
    for (Vec3& x : r.b.x)
      x.z() += 0.02 * std::cos(0.2 * i + std::numbers::pi);
    press(contact, r.a.state(), r.b.state(), 1e-6);
    EXPECT_GE(contact.sums.damping, last);
    EXPECT_GE(contact.force_b[0].z(), 0.0); // no adhesion
    last = contact.sums.damping;
  }
  EXPECT_GT(last, 0.0);
}

TEST(EdgeContact, OnlyFoldsAndRimsCount) {
  OwnedSheet sheet = square_sheet(4, 5.0, 0.0);
  const auto edges = sheet_edges(sheet.triangles);
  EXPECT_EQ(edges.size(), 4u * 5 * 2 + 16); // sides of cells and diagonals
  for (std::size_t i = 1; i < edges.size(); ++i)
    EXPECT_LT(std::pair(edges[i - 1].a, edges[i - 1].b), std::pair(edges[i].a, edges[i].b));
  const auto count = [&] {
    return folded_edges(edges, sheet.triangles, sheet.x, least_sag * thickness, 0.0).size();
  };
  EXPECT_EQ(count(), 16u); // the rim
  const double degree = std::numbers::pi / 180.0;
  // sag of a side of 5 mm: 2.5 tan(fold/2) = 0.4 * 0.6 at 10.97 degrees
  for (const double fold : {10.5, 11.5}) { // along the line x = 0
    for (Vec3& x : sheet.x)
      x.z() = x.x() > 0.0 ? x.x() * std::tan(fold * degree) : 0.0;
    EXPECT_EQ(count(), fold > 11.0 ? 20u : 16u);
  }
}

TEST(EdgeContact, FindsEveryPairWithinReach) {
  Random random(4);
  for (int state = 0; state < 10; ++state) {
    OwnedSheet a = square_sheet(5, 4.0, 0.0), b = square_sheet(6, 3.3, 0.8);
    for (OwnedSheet* sheet : {&a, &b})
      for (Vec3& x : sheet->x)
        x += Vec3(0.5, 0.5, 0.7).cwiseProduct(random_vector(random));
    Loaded contact = contact_of({1.0, 0.0, 0.0});
    constexpr double skin = 0.5;
    search(contact, a, b, skin);
    std::set<std::array<int, 4>> found;
    for (const EdgePair& p : contact.pairs)
      EXPECT_TRUE(found.insert({p.a.a, p.a.b, p.b.a, p.b.b}).second);
    const auto edges_a = sheet_edges(a.triangles), edges_b = sheet_edges(b.triangles);
    int near = 0;
    for (const std::int32_t i : folded_edges(edges_a, a.triangles, a.x, least_sag * thickness, 0.0))
      for (const std::int32_t j :
           folded_edges(edges_b, b.triangles, b.x, least_sag * thickness, 0.0)) {
        const SheetEdge &e = edges_a[static_cast<std::size_t>(i)],
                        &g = edges_b[static_cast<std::size_t>(j)];
        double nearest = 1e300; // by points along both: never below the true distance
        for (int s = 0; s <= 30; ++s)
          for (int t = 0; t <= 30; ++t) {
            const auto on = [](const OwnedSheet& sheet, const SheetEdge& edge, int part) -> Vec3 {
              return sheet.x[static_cast<std::size_t>(edge.a)] +
                     part / 30.0 *
                         (sheet.x[static_cast<std::size_t>(edge.b)] -
                          sheet.x[static_cast<std::size_t>(edge.a)]);
            };
            nearest = std::min(nearest, (on(a, e, s) - on(b, g, t)).norm());
          }
        if (nearest > distance + skin) continue;
        ++near;
        EXPECT_TRUE(found.contains({e.a, e.b, g.a, g.b})) << state;
      }
    EXPECT_GT(near, 20);
  }
}

TEST(EdgeContact, KeepsATouchingPairWhoseFoldOpens) {
  OwnedSheet a = roof(-1.0, 0.0, 0.2), b = roof(1.0, 0.5 * std::numbers::pi, 0.0);
  Loaded contact = contact_of({1.0, 0.0, 0.0});
  search(contact, a, b, 0.1);
  press(contact, a.state(), b.state(), 0.0);
  ASSERT_EQ(contact.sums.touching, 1); // ridges 0.2 mm apart, contact from 0.3 mm on
  for (OwnedSheet* sheet : {&a, &b})   // wings up or down to the ridge's height: flat sheets
    for (std::size_t n = 2; n < 4; ++n)
      sheet->x[n].z() = sheet->x[0].z();
  search(contact, a, b, 0.1);
  press(contact, a.state(), b.state(), 0.0);
  EXPECT_GE(contact.sums.touching, 1);
}

} // namespace
} // namespace plyform
