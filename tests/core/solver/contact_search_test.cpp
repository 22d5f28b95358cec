// SPDX-License-Identifier: GPL-3.0-or-later
// Whole scenes in motion: at many steps every node of a ply within contact distance of another ply
// or of a tool, found by brute force, is among the scene's contact points, and where it should be.
#include "contact/point_triangle.hpp"
#include "core/run/run.hpp"
#include "core/setup/prepare_case.hpp"
#include "core/solver/contact_search.hpp"
#include "core/solver/scene.hpp"
#include "core/solver/step.hpp"
#include "support/scene_checks.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace plyform::contact_search_test {
namespace {

constexpr double rounding = 1e-11; // mm, of two ways to a distance at 100 mm from the origin

/// Pairs looked at that touch.
struct Touching {
  long plies = 0, tools = 0;
};

/// Distance (mm) of every face of a ply to a point, by asking each.
std::vector<double> distances(const PlyBody& master, const Vec3& p) {
  std::vector<double> all;
  for (const Triangle& t : master.membrane.triangles)
    all.push_back(std::sqrt(
        closest_point_on_triangle(p, master.x[t[0]], master.x[t[1]], master.x[t[2]]).distance2));
  return all;
}

/// Every face within contact distance of a slave node belongs to one of its points, and the nearest
/// one tells that node's gap.
void expect_all_faces(const Scene& s, const PlyContact& pair, Touching& touching) {
  const PlyBody& slave = s.plies[pair.slave];
  const PlyBody& master = s.plies[pair.master];
  const double h = 0.5 * (slave.thickness + master.thickness);
  auto point = pair.contact.points.begin();
  for (std::size_t n = 0; n < slave.x.size(); ++n) {
    std::vector<char> listed(master.membrane.triangles.size(), 0);
    double gap = 1e300;
    for (; point != pair.contact.points.end() && point->node == static_cast<int>(n); ++point) {
      gap = std::min(gap, point->gap);
      for (int i = point->first_face; i < point->end_face; ++i)
        listed[pair.contact.faces[static_cast<std::size_t>(i)]] = 1;
    }
    double nearest = 1e300;
    const std::vector<double> to = distances(master, slave.x[n]);
    for (std::size_t f = 0; f < to.size(); ++f) {
      nearest = std::min(nearest, to[f]);
      if (!(to[f] > h)) { // NaN fails
        ASSERT_TRUE(listed[f]) << slave.name << " node " << n << ", " << master.name << " triangle "
                               << f << ": " << to[f] << " mm";
      }
    }
    if (nearest > h) continue;
    ++touching.plies;
    ASSERT_NEAR(gap, nearest - h, rounding) << slave.name << " node " << n;
  }
}

/// The same for every node and a tool; distances are asked without a hint.
void expect_all_nodes(const Scene& s, const ToolState& tool, Touching& touching) {
  for (std::size_t p = 0; p < s.plies.size(); ++p) {
    const ToolPlyContact& contact = tool.contacts[p];
    const double half = 0.5 * s.plies[p].thickness;
    // The gaps of a pushed tool, which moved last, are those of a straight line over its motion:
    // off by its square over twice the distance where an edge is met.
    const double bend =
        rounding + (tool.body.force_controlled ? tool.body.motion.squaredNorm() / half : 0.0);
    std::vector<double> gap(s.plies[p].x.size(), 1e300);
    for (const ToolPlyPoint& c : contact.points)
      gap[c.node] = c.gap;
    for (std::size_t n = 0; n < gap.size(); ++n) {
      SurfaceHint hint;
      const double expected = distance_to_tool(tool.body, s.plies[p].x[n], hint).distance - half;
      if (expected > -rounding) continue;
      ++touching.tools;
      ASSERT_NEAR(gap[n], expected, bend)
          << tool.name << " and " << s.plies[p].name << " node " << n;
    }
  }
}

/// Steps the scene to its end and looks at it every so often.
Touching follow(Scene& s, int every) {
  ThreadPool pool(1);
  start(s, pool);
  Touching touching;
  long looks = 0, searches = 0;
  for (;;) {
    const auto stop = compute_forces(s, pool);
    EXPECT_FALSE(stop) << stop->message;
    if (stop || s.time >= s.data.solver.duration) break;
    if (s.step % every == 0) {
      ++looks;
      each_pass(s, [&](const PlyContact& pass) {
        if (pass.slave != pass.master) expect_all_faces(s, pass, touching);
      });
      for (const ToolState& tool : s.tools)
        expect_all_nodes(s, tool, touching);
      if (::testing::Test::HasFailure()) {
        ADD_FAILURE() << "at step " << s.step << ", time " << s.time;
        break;
      }
    }
    searches = s.searches;
    move_plies(s, pool);
  }
  EXPECT_GT(looks, 15);
  EXPECT_GT(searches, 10);         // it moves
  EXPECT_LT(searches, s.step / 3); // the skin is of use
  return touching;
}

/// Plies drawn into a die by a ball: they slide on each other and off the rim.
Scene drawn_stack(const std::vector<double>& angles) {
  Case data = coarse_hemisphere(angles);
  data.blanks = {rectangle(240.0, 240.0, 20.0)};
  data.solver.duration = 0.02;
  data.tools[0].stroke = 35.0;
  data.contact.stiffness = 0.5; // fast, so that it moves far; the depth is not what is asked
  return make_scene(data);
}

TEST(ContactSearch, NoPairIsAbsentWhileAStackIsDrawn) {
  for (const std::vector<double>& angles : {std::vector{0.0, 0.785}, std::vector{0.3, 0.0, 1.1}}) {
    Scene s = drawn_stack(angles);
    const Touching touching = follow(s, 61);
    EXPECT_GT(touching.plies, 1000) << angles.size();
    EXPECT_GT(touching.tools, 500) << angles.size();
  }
}

/// A face seen late is closer than the one before, and each such change adds energy. Coarse plies
/// drawn over small radii show it most: 0.24 % of the balance, and 0.75 % if points near a side
/// kept their face until they have slid by 1/500 of the contact distance.
TEST(ContactSearch, FacesSeenInTimeKeepTheEnergy) {
  const PreparedCase reading = prepare_case(
      PLYFORM_CASES "/stability/five_plies.toml", // yarns that carry tension only are held least
      {{"fabrics.glass", "../fabrics/glass_plain_weave_paper.toml"}});
  ASSERT_TRUE(reading.value);
  const RunResult run = run_case(*reading.value, 1, {});
  ASSERT_TRUE(ended(run.summary.status)) << run.summary.message;
  EXPECT_LE(std::abs(run.last.energy.balance_error()), 0.005);
}

/// The second ply is of the second blank; all lie on a floor, of little friction.
void lay_on_floor(Case& data) {
  data.plies[1].blank = 1;
  Tool floor;
  floor.name = "floor";
  floor.shape = Plane{};
  data.tools = {floor};
  set_friction(data, 0.1);
  data.solver.fibre_softening = 100.0;
}

/// A small ply dropped flat on a larger one at 2 m/s, with a slide of 5 m/s: fast, over the rim.
TEST(ContactSearch, NoPairIsAbsentWhileAPlyStrikesAndSlidesOff) {
  Case data = stack_of({0.0, 0.4}, rectangle(120.0, 120.0, 12.0));
  data.blanks.push_back(rectangle(60.0, 60.0, 8.0));
  data.plies[1].z += 2.0;
  lay_on_floor(data);
  data.solver.duration = 0.02;
  Scene s = make_scene(data);
  for (Vec3& v : s.plies[1].velocity)
    v = Vec3(5000.0, 1000.0, -2000.0);
  const Touching touching = follow(s, 3);
  EXPECT_GT(touching.plies, 300);
  EXPECT_GT(touching.tools, 500);
}

/// A small ply between two larger ones, of which the upper falls: past the small one's rim the
/// outer two meet, which it covers elsewhere.
TEST(ContactSearch, NoPairIsAbsentAroundTheRimOfAPlyBetween) {
  Case data = stack_of({0.0, 0.4, 0.8}, rectangle(60.0, 60.0, 3.0));
  data.blanks.push_back(rectangle(30.0, 30.0, 3.0));
  lay_on_floor(data);
  data.contact.skin = 4.0; // further than the slope from the rim down to the lowest ply
  data.solver.duration = 0.008;
  Scene s = make_scene(data);
  for (Vec3& v : s.plies[2].velocity)
    v = Vec3(4000.0, 2000.0, -3000.0);
  const Touching touching = follow(s, 40);
  EXPECT_GT(touching.plies, 300);
  const PassPlace second = s.pass_order[1]; // of the lowest and the uppermost
  const PlyContact& pass = s.ply_pairs[at(second.pair)].passes[at(second.pass)];
  EXPECT_GT(pass.contact.sums.deepest, 0.0);
  ASSERT_EQ(pass.slave, 0);
  ASSERT_EQ(pass.master, 2);
}

/// rad, the largest angle between each face and those that share a node with it.
std::vector<double> folds(const PlyBody& ply) {
  std::vector<Vec3> normal;
  std::vector<std::vector<std::size_t>> around(ply.x.size());
  for (const Triangle& t : ply.membrane.triangles) {
    for (const int n : t)
      around[static_cast<std::size_t>(n)].push_back(normal.size());
    normal.push_back((ply.x[t[1]] - ply.x[t[0]]).cross(ply.x[t[2]] - ply.x[t[0]]).normalized());
  }
  std::vector<double> fold(normal.size(), 0.0);
  for (std::size_t f = 0; f < fold.size(); ++f)
    for (const int n : ply.membrane.triangles[f])
      for (const std::size_t g : around[static_cast<std::size_t>(n)])
        fold[f] = std::max(fold[f], std::acos(std::clamp(normal[f].dot(normal[g]), -1.0, 1.0)));
  return fold;
}

/// A ply that buckles in the shortest waves its mesh has, as it flies: it folds by far more than
/// its bounds allow for before anything has moved by half of the skin.
TEST(ContactSearch, BoundsOfFoldsHoldBetweenSearches) {
  Case data = stack_of({0.0, 0.0}, rectangle(60.0, 60.0, 6.0));
  data.plies[1].z += 10.0;
  data.solver.fibre_softening = 100.0;
  data.solver.duration = 0.001;
  data.contact.skin = 6.0;
  set_friction(data, 0.2);
  Scene s = make_scene(data);
  PlyBody& ply = s.plies[1];
  for (std::size_t n = 0; n < ply.x.size(); ++n)
    ply.velocity[n] = Vec3(5000.0, 0.0, 3000.0 * std::cos(M_PI * (ply.x[n].x() - 30.0) / 6.0));
  ThreadPool pool(1);
  start(s, pool);
  const std::vector<double> at_start = ply.fold_bound;
  double largest = 0.0, beyond = 0.0;
  while (s.searches == 1) {
    ASSERT_FALSE(compute_forces(s, pool));
    const std::vector<double> fold = folds(ply);
    for (std::size_t f = 0; f < fold.size(); ++f) {
      const double needed = 1.2 * std::tan(0.5 * fold[f]);
      ASSERT_GE(ply.fold_bound[f], needed) << "step " << s.step << " triangle " << f;
      beyond = std::max(beyond, needed / at_start[f]);
      largest = std::max(largest, fold[f]);
    }
    move_plies(s, pool);
  }
  EXPECT_GT(largest, 0.3);
  EXPECT_GT(beyond, 1.2); // those of the start would not have held
  EXPECT_GT(s.step, 20);
}

} // namespace
} // namespace plyform::contact_search_test
