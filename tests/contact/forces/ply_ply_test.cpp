// SPDX-License-Identifier: GPL-3.0-or-later
// Node-to-face contact of two sheets: forces against finite differences, balance, memory, search.
#include "contact/forces/ply_ply.hpp"
#include "contact/point_triangle.hpp"
#include "contact/search/fold_bound.hpp"
#include "contact/search/sheet_edges.hpp"
#include "support/contact_checks.hpp"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <numbers>

namespace plyform::ply_ply_test {
namespace {

constexpr double thickness = 0.6; // h, mm

/// A contact with what it does to both sheets' nodes.
struct Loaded : PlyPlyContact {
  std::vector<Vec3> slave_force, master_force; ///< N
};

/// Both sheets as the search sees them.
void search(PlyPlyContact& contact, const OwnedSheet& slave, const OwnedSheet& master,
            double skin) {
  const SheetTree tree(master.x, master.triangles);
  std::vector<Candidate> candidates;
  tree.candidates(slave.x, contact.distance + skin, candidates);
  find_ply_ply_points(contact, candidates, slave.state(), master.state(), master.triangles, 0.0);
}

void forces(Loaded& contact, const OwnedSheet& slave, const OwnedSheet& master, double dt = 0.0,
            double way = std::numeric_limits<double>::infinity()) {
  contact.slave_force.assign(slave.x.size(), Vec3::Zero());
  contact.master_force.assign(master.x.size(), Vec3::Zero());
  ply_ply_forces(contact, slave.state(), master.state(), master.triangles, dt, {way, way},
                 contact.slave_force, contact.master_force);
}

Loaded contact_of(const ContactLaw& law) {
  Loaded contact;
  contact.law = law;
  contact.distance = thickness;
  return contact;
}

/// A bumpy master and a slave that partly presses on it and partly overhangs its rim.
struct BumpyPair {
  OwnedSheet slave, master;
};

BumpyPair bumpy_pair(Random& random) {
  BumpyPair pair{square_sheet(7, 3.1, 0.97 * thickness), square_sheet(4, 4.7, 0.0)};
  for (Vec3& x : pair.master.x)
    x += Vec3(0.5, 0.5, 0.08).cwiseProduct(random_vector(random));
  for (Vec3& x : pair.slave.x)
    x += Vec3(0.5, 0.5, 0.08).cwiseProduct(random_vector(random));
  return pair;
}

TEST(PlyPlyContact, ForceIsMinusEnergyGradient) {
  Random random(1);
  int touching = 0;
  double worst = 0.0;
  for (int state = 0; state < 20; ++state) {
    BumpyPair p = bumpy_pair(random);
    Loaded contact = contact_of({3.0, 0.0, 0.0, 0.25});
    search(contact, p.slave, p.master, 0.5);
    forces(contact, p.slave, p.master);
    EXPECT_LT(contact.fault.node, 0);
    touching += contact.sums.touching;
    const auto energy = [&] {
      Loaded copy = contact;
      forces(copy, p.slave, p.master);
      return copy.sums.elastic;
    };
    const std::vector<Vec3> on_slave = contact.slave_force, on_master = contact.master_force;
    // h = 1e-6 mm: penetrations are 0.05 mm, so cut-off is below 1e-8, rounding below 1e-8
    const double slave_error = gradient_error(p.slave.x, on_slave, 1e-6, energy);
    const double master_error = gradient_error(p.master.x, on_master, 1e-6, energy);
    EXPECT_LE(slave_error, 1e-6) << state;
    EXPECT_LE(master_error, 1e-6) << state;
    worst = std::max({worst, slave_error, master_error});
  }
  EXPECT_GT(touching, 200);
  RecordProperty("worst", fmt::format("{:.2g}", worst));
}

TEST(PlyPlyContact, ActionIsReaction) {
  Random random(2);
  for (int state = 0; state < 10; ++state) {
    BumpyPair p = bumpy_pair(random);
    Loaded contact = contact_of({3.0, 1e-5, 0.0});
    search(contact, p.slave, p.master, 0.5);
    forces(contact, p.slave, p.master);
    for (const bool friction : {false, true}) {
      contact.law.friction = friction ? 0.3 : 0.0;
      for (OwnedSheet* sheet : {&p.slave, &p.master}) {
        std::vector<Vec3> step;
        for (std::size_t n = 0; n < sheet->x.size(); ++n)
          step.push_back(0.003 * random_vector(random));
        sheet->move(step);
      }
      forces(contact, p.slave, p.master, 1e-6);
      Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
      const auto add = [&](const std::vector<Vec3>& force, const std::vector<Vec3>& x) {
        for (std::size_t n = 0; n < x.size(); ++n) {
          sum += force[n];
          moment += x[n].cross(force[n]);
        }
      };
      add(contact.slave_force, p.slave.x);
      add(contact.master_force, p.master.x);
      const double scale = largest_norm(contact.slave_force);
      ASSERT_GT(scale, 0.0);
      EXPECT_LE(sum.norm(), 1e-13 * scale);           // rounding
      EXPECT_LE(moment.norm(), 1e-12 * scale * 15.0); // rounding, the sheets are 15 mm long
    }
  }
}

/// One node over a large face, pressed to `p` of penetration.
struct OnePoint {
  OwnedSheet node = points_only({Vec3(0.3, 0.2, thickness)}, 2.0),
             floor = square_sheet(1, 40.0, 0.0);
  Loaded contact = contact_of({5.0, 0.0, 0.25});
  explicit OnePoint(double p) {
    search(contact, node, floor, 0.5);
    step({0, 0, -p});
  }
  Vec3 step(const Vec3& by) {
    node.move({by});
    forces(contact, node, floor, 1e-6);
    return contact.slave_force[0];
  }
};

TEST(PlyPlyContact, SticksBelowTheConeAndGivesItsWayBack) {
  OnePoint c(0.04);
  const double k = 2.0 * 5.0, k_t = 0.5 * k, normal = k * 0.04, limit = 0.25 * normal;
  Vec3 f = c.step({0.005, 0.0, 0.0}); // 0.025 N of 0.1 N
  EXPECT_NEAR(f.x(), -k_t * 0.005, 1e-12);
  ASSERT_LT(-f.x(), limit);
  for (int i = 0; i < 1000; ++i) // no creep under constant load
    f = c.step(Vec3::Zero());
  EXPECT_NEAR(f.x(), -k_t * 0.005, 1e-12);
  EXPECT_EQ(c.contact.sums.friction, 0.0);
  f = c.step({-0.005, 0.0, 0.0});
  EXPECT_NEAR(f.x(), 0.0, 1e-12);
  EXPECT_NEAR(f.z(), normal, 1e-12);
}

TEST(PlyPlyContact, SlidesAtExactlyTheConeAndPaysForIt) {
  OnePoint c(0.04);
  const double limit = 0.25 * 2.0 * 5.0 * 0.04;
  double work = 0.0, last = 0.0, heat = 0.0;
  for (int i = 0; i < 500; ++i) {
    const Vec3 f = c.step({0.002, 0.001, 0.0});
    const double along = -f.dot(Vec3(0.002, 0.001, 0.0));
    work += 0.5 * (along + last);
    last = along;
    EXPECT_GE(c.contact.sums.friction, heat);
    heat = c.contact.sums.friction;
    if (i > 20) {
      EXPECT_NEAR(f.head<2>().norm(), limit, 1e-12);
    }
  }
  // Ledger: trapezoidal work done against friction is heat and what the tangential spring holds.
  const double stored = 0.5 * limit * limit / 5.0;
  EXPECT_NEAR(work, c.contact.sums.friction + stored, 1e-11 * work); // rounding
  EXPECT_GT(c.contact.sums.friction, 0.95 * work);
  const double elastic = 0.5 * 10.0 * 0.04 * 0.04 + stored;
  EXPECT_NEAR(c.contact.sums.elastic, elastic, 1e-12);
  c.step({0, 0, 0.1}); // opens: the spring's energy becomes heat
  EXPECT_NEAR(c.contact.sums.friction, heat + stored, 1e-12);
  EXPECT_EQ(c.contact.sums.elastic, 0.0);
  EXPECT_EQ(c.contact.slave_force[0].norm(), 0.0);
}

TEST(PlyPlyContact, DampingNeverPullsAndItsWorkIsKept) {
  OnePoint c(0.04);
  c.contact.law = {5.0, 1e-5, 0.0}; // 20 N s/mm at dt = 1e-6 a step of 0.01: more than the spring
  EXPECT_GT(c.step({0, 0, -0.001}).z(), 2.0 * 5.0 * 0.041);
  EXPECT_EQ(c.step({0, 0, 0.035}).z(), 0.0); // leaves faster than it could be followed
  EXPECT_GT(c.contact.sums.damping, 0.0);
}

TEST(PlyPlyContact, KeepsItsMemoryAcrossASearch) {
  OnePoint c(0.04);
  c.step({0.005, 0.0, 0.0});
  const Vec3 before = c.contact.slave_force[0];
  const double area = c.contact.points[0].area;
  for (int i = 0; i < 3; ++i) {
    search(c.contact, c.node, c.floor, 0.5);
    ASSERT_EQ(c.contact.points.size(), 1u);
    EXPECT_EQ(c.contact.points[0].area, area);
    EXPECT_EQ(c.contact.points[0].side, 1);
    EXPECT_NEAR((c.step(Vec3::Zero()) - before).norm(), 0.0, 1e-14);
  }
}

TEST(PlyPlyContact, NodeGoneThroughIsAFault) {
  OnePoint c(0.04);
  EXPECT_LT(c.contact.fault.node, 0);
  c.step({0, 0, -0.2}); // 0.36 mm left of 0.6
  EXPECT_LT(c.contact.fault.node, 0);
  OnePoint deep = c;
  deep.step({0, 0, -0.07}); // less than half of h
  EXPECT_EQ(deep.contact.fault.node, 0);
  EXPECT_NEAR(deep.contact.fault.distance, 0.29, 1e-12);
  c.step({0, 0, -0.36 - 0.5}); // on the other side at one blow
  EXPECT_EQ(c.contact.fault.node, 0);
  EXPECT_GE(c.contact.fault.face, 0);
}

/// Height of a wavy floor.
double wave(double x, double y) {
  return 1.5 * std::sin(0.25 * x) * std::cos(0.2 * y);
}

/// A floor and a slope that rises from its edge x = 0 at `angle` (rad).
OwnedSheet valley(double angle) {
  OwnedSheet sheet = points_only(
      {{0, -40, 0}, {0, 40, 0}, {-60, 0, 0}, {60 * std::cos(angle), 0, 60 * std::sin(angle)}}, 1.0);
  sheet.triangles = {{0, 1, 2}, {0, 3, 1}};
  return sheet;
}

/// ContactTotals::step_ratio after a node has slid by `step` (mm along x) over a master that knows
/// its folds. x: mm, where the node starts; `depth` mm deep if the master is flat there.
double ratio_while_sliding(const OwnedSheet& master, const ContactLaw& law, double x, double depth,
                           double step) {
  std::vector<double> bound;
  fold_bounds(master.x, master.triangles, bound);
  const SheetEdges edges = sheet_edges(master.triangles, master.x);
  const SurfaceKinematics folded{master.x, master.motion, master.area, bound, edges.faces_across};
  OwnedSheet node = points_only({Vec3(x, 0.2, thickness - depth)}, 2.0);
  Loaded contact = contact_of(law);
  search(contact, node, master, 0.5);
  contact.slave_force.resize(1);
  contact.master_force.resize(master.x.size());
  for (const double by : {0.0, step}) {
    node.move({{by, 0.0, 0.0}});
    ply_ply_forces(contact, node.state(), folded, master.triangles, 1e-6, {by, by},
                   contact.slave_force, contact.master_force);
    EXPECT_NEAR(contact.sums.penetration, depth, 1e-12); // it does not close
  }
  return contact.sums.step_ratio;
}

TEST(PlyPlyContact, NextStepSeesTheFaceBehindAFold) {
  constexpr double limit = 0.25 * thickness, depth = 0.05, step = 0.02;
  const ContactLaw law{5.0, 0.0, 0.0, limit};
  const double near = ratio_while_sliding(valley(60.0 * degree), law, -0.36, depth, step);
  const double onto_wall = step * std::sin(std::numbers::pi / 3.0);
  EXPECT_LE(near, room_in_a_step(law, depth) / onto_wall);
  EXPECT_GT(near, 0.5 * room_in_a_step(law, depth) / onto_wall);
  // nothing is ahead in the middle of a flat face
  EXPECT_GT(ratio_while_sliding(square_sheet(1, 40.0, 0.0), law, 0.3, depth, step), 1e3);
}

/// The contact of one node that has moved from `from` by `step` (mm) in the last of two steps, over
/// a master that knows its folds, both of which have moved by `path` (mm) in all.
Loaded after_a_step(const OwnedSheet& master, const ContactLaw& law, const Vec3& from,
                    const Vec3& step, double path) {
  std::vector<double> bound;
  fold_bounds(master.x, master.triangles, bound);
  const SheetEdges edges = sheet_edges(master.triangles, master.x);
  const SurfaceKinematics folded{master.x, master.motion, master.area, bound, edges.faces_across};
  OwnedSheet node = points_only({from}, 2.0);
  Loaded contact = contact_of(law);
  search(contact, node, master, 5.0);
  contact.slave_force.resize(1);
  contact.master_force.resize(master.x.size());
  for (const Vec3& by : {Vec3(0, 0, 0), step}) {
    node.move({by});
    ply_ply_forces(contact, node.state(), folded, master.triangles, 1e-6, {by.norm(), path},
                   contact.slave_force, contact.master_force);
  }
  return contact;
}

TEST(PlyPlyContact, OnlyMotionAlongTheFaceMayCloseOnTheNext) {
  constexpr double limit = 0.25 * thickness, depth = 0.03, step = 0.01;
  const ContactLaw law{5.0, 0.0, 0.0, limit};
  const Vec3 beside_the_edge(-0.2, 0.2, thickness - depth); // the floor is closer
  const Loaded pressed =
      after_a_step(valley(20.0 * degree), law, beside_the_edge, {0, 0, -step}, 0.0);
  ASSERT_EQ(pressed.points.size(), 1u);
  EXPECT_NEAR(pressed.sums.step_ratio, room_in_a_step(law, depth + step) / step, 1e-9);
}

TEST(PlyPlyContact, FarFromTheSheetAFoldReachesFurther) {
  const double angle = 20.0 * degree;
  const OwnedSheet master = valley(angle);
  const Loaded contact =
      after_a_step(master, {5.0, 0.0, 0.0, 0.25 * thickness}, {-1.5, 0.2, 3.0}, {1.2, 0, 0}, 10.0);
  ASSERT_EQ(contact.points.size(), 1u);
  EXPECT_EQ(contact.points[0].face, 1); // the slope, though the foot on the floor is inside
  EXPECT_NEAR(contact.points[0].gap, 0.3 * std::sin(angle) + 3.0 * std::cos(angle) - thickness,
              1e-12);
}

TEST(PlyPlyContact, NoPairIsMissedBetweenSearches) {
  constexpr double skin = 0.5;
  OwnedSheet master = square_sheet(16, 2.5, 0.0), slave = square_sheet(12, 2.9, 0.0);
  for (Vec3& x : master.x)
    x.z() = wave(x.x(), x.y());
  Loaded contact = contact_of({1.0, 0.0, 0.0});
  std::vector<Vec3> slave_at_search = slave.x, master_at_search = master.x;
  int touching = 0, searches = 0;
  double moved = 0.0; // furthest way since the search, which never falls
  for (int step = 0; step < 150; ++step) {
    // drawn against each other over the waves and off the rim, just apart, bobbing
    constexpr double way = 0.08;
    std::vector<Vec3> motion;
    for (std::size_t n = 0; n < slave.x.size(); ++n) {
      const double x = slave.x[n].x() + way, y = slave.x[n].y() + 0.05;
      const double z =
          wave(x + way * (step + 1), y) + thickness + 0.1 + 0.15 * std::sin(0.4 * step + x);
      motion.emplace_back(way, 0.05, z - slave.x[n].z());
    }
    slave.move(motion);
    master.move(std::vector<Vec3>(master.x.size(), Vec3(-way, 0.0, 0.0)));
    for (std::size_t n = 0; n < slave.x.size(); ++n)
      moved = std::max(moved, (slave.x[n] - slave_at_search[n]).norm());
    const double drawn = (master.x[0] - master_at_search[0]).norm();
    if (step == 0 || std::max(moved, drawn) > 0.5 * skin) {
      search(contact, slave, master, skin);
      slave_at_search = slave.x;
      master_at_search = master.x;
      moved = 0.0;
      ++searches;
    }
    forces(contact, slave, master, 0.0, moved > 0.0 ? moved + drawn : 0.0);
    // brute force: distance of every node to the whole sheet
    std::vector<double> nearest(slave.x.size(), 1e300);
    for (std::size_t n = 0; n < slave.x.size(); ++n)
      for (const Triangle& t : master.triangles)
        nearest[n] = std::min(nearest[n], closest_point_on_triangle(slave.x[n], master.x[t[0]],
                                                                    master.x[t[1]], master.x[t[2]])
                                              .distance2);
    std::vector<double> found(slave.x.size(), 1e300);
    for (const PlyPlyPoint& c : contact.points) {
      double& gap = found[c.node];
      gap = std::min(gap, c.gap + thickness);
    }
    for (std::size_t n = 0; n < slave.x.size(); ++n) {
      const double distance = std::sqrt(nearest[n]);
      if (distance >= thickness) {
        EXPECT_TRUE(contact.slave_force[n].isZero(0.0)) << step << " " << n;
        continue;
      }
      ++touching;
      ASSERT_NEAR(found[n], distance, 1e-12) << step << " " << n;
      ASSERT_GT(contact.slave_force[n].norm(), 0.0);
    }
  }
  EXPECT_GT(touching, 1000);
  EXPECT_LT(searches, 150); // the skin is of use
}

} // namespace
} // namespace plyform::ply_ply_test
