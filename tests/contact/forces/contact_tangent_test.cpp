// SPDX-License-Identifier: GPL-3.0-or-later
// The linear answer of contacts against the forces themselves.
#include "contact/forces/contact_tangent.hpp"
#include "support/contact_checks.hpp"

#include <gtest/gtest.h>

namespace plyform::contact_tangent_test {
namespace {

constexpr double thickness = 0.6;  // mm
constexpr double margin = 0.1;     // mm
constexpr double depth = 1e-4;     // mm: the pressure's own share of the tangent falls with it
constexpr double small_way = 1e-7; // mm

double largest_difference(const std::vector<Vec3>& f, const std::vector<Vec3>& g) {
  double largest = 0.0;
  for (std::size_t n = 0; n < f.size(); ++n)
    largest = std::max(largest, (f[n] - g[n]).norm());
  return largest;
}

std::vector<Vec3> minus(const std::vector<Vec3>& f, const std::vector<Vec3>& g) {
  std::vector<Vec3> difference(f.size());
  for (std::size_t n = 0; n < f.size(); ++n)
    difference[n] = f[n] - g[n];
  return difference;
}

std::vector<Vec3> random_motion(const OwnedSheet& sheet, Random& random) {
  std::vector<Vec3> y;
  for (std::size_t n = 0; n < sheet.x.size(); ++n)
    y.push_back(small_way * random_vector(random));
  return y;
}

/// Two sheets that press on each other by `depth`, or a little less.
struct Pressed {
  OwnedSheet slave = square_sheet(5, 3.1, thickness - depth), master = square_sheet(4, 4.7, 0.0);
  PlyPlyContact contact;
  std::vector<Vec3> slave_force, master_force;

  explicit Pressed(const ContactLaw& law) {
    contact.law = law;
    contact.distance = thickness;
    const SheetTree tree(master.x, master.triangles);
    std::vector<Candidate> candidates;
    tree.candidates(slave.x, contact.distance + margin, candidates);
    find_ply_ply_points(contact, candidates, slave.state(), master.state(), master.triangles, 0.0);
  }

  void load(double dt) {
    slave_force.assign(slave.x.size(), Vec3::Zero());
    master_force.assign(master.x.size(), Vec3::Zero());
    constexpr double far = std::numeric_limits<double>::infinity();
    ply_ply_forces(contact, slave.state(), master.state(), master.triangles, dt, {far, far},
                   slave_force, master_force);
  }
};

TEST(ContactTangents, AnswerAsNodesAndFacesDo) {
  Random random(3);
  constexpr double dt = 1e-6; // s
  for (const double damping : {0.0, 2e-6})
    for (const double friction : {0.0, 1e6}) { // stuck for sure
      Pressed p({3.0, damping, friction});
      p.load(dt);
      p.load(dt);
      ASSERT_EQ(p.contact.sums.touching, 36);
      const std::vector<Vec3> slave = p.slave_force, master = p.master_force;
      std::vector<ContactTangent> springs;
      append_tangents(p.contact, p.slave.state(), p.master.state(), p.master.triangles, margin,
                      {1.0, 1.0 / dt}, springs);
      ASSERT_EQ(springs.size(), 36u);
      const auto y_slave = random_motion(p.slave, random),
                 y_master = random_motion(p.master, random);
      std::vector<Vec3> on_slave(slave.size(), Vec3::Zero()),
          on_master(master.size(), Vec3::Zero());
      add_tangent_forces(springs, y_slave, y_master, on_slave, on_master);
      p.slave.move(y_slave);
      p.master.move(y_master);
      p.load(dt);
      const double scale = largest_norm(on_slave);
      ASSERT_GT(scale, 0.0);
      // depth over thickness and over the size of a face
      EXPECT_LE(largest_difference(on_slave, minus(slave, p.slave_force)), 1e-3 * scale);
      EXPECT_LE(largest_difference(on_master, minus(master, p.master_force)), 1e-3 * scale);
    }
}

TEST(ContactTangents, LeaveOutWhatIsFurtherThanTheMargin) {
  Pressed p({3.0, 0.0, 0.2});
  p.slave.move(std::vector<Vec3>(p.slave.x.size(), {0.0, 0.0, depth + 0.5 * margin}));
  p.load(0.0);
  std::vector<ContactTangent> springs;
  const auto found = [&](double within) {
    springs.clear();
    append_tangents(p.contact, p.slave.state(), p.master.state(), p.master.triangles, within, {},
                    springs);
    return springs.size();
  };
  EXPECT_EQ(found(0.4 * margin), 0u);
  EXPECT_EQ(found(0.6 * margin), 36u);
}

TEST(ContactTangents, AnswerAsToolsDo) {
  Random random(4);
  OwnedSheet sheet = square_sheet(5, 3.1, 0.5 * thickness - depth);
  ToolBody floor;
  floor.shape = Plane{};
  std::vector<ToolPlyContact> contact(1);
  contact[0].law = {3.0, 0.0, 1e6};
  contact[0].half_thickness = 0.5 * thickness;
  find_tool_ply_points(contact[0], floor, sheet.state(), margin, 0.0);
  std::vector<ContactTangent> springs;
  append_tangents(contact[0], sheet.state(), margin, {}, springs); // before any force is known
  ASSERT_EQ(springs.size(), 36u);
  const std::vector<SurfaceKinematics> states{sheet.state()};
  const std::vector<double> path_length{1.0}; // all may touch
  tool_ply_forces(floor, contact, states, path_length, 1e-6);
  const std::vector<Vec3> before = contact[0].force;
  const auto y = random_motion(sheet, random);
  std::vector<Vec3> on_sheet(before.size(), Vec3::Zero());
  add_tangent_forces(springs, y, y, on_sheet, on_sheet);
  sheet.move(y);
  tool_ply_forces(floor, contact, std::vector<SurfaceKinematics>{sheet.state()}, path_length, 1e-6);
  EXPECT_LE(largest_difference(on_sheet, minus(before, contact[0].force)),
            1e-6 * largest_norm(on_sheet)); // rounding of ways of 1e-7 mm
}

TEST(ContactTangents, AnswerAsEdgesDo) {
  // two sheets that are one triangle each, an edge of one across an edge of the other
  OwnedSheet a = points_only({Vec3(-5, 0, 0), Vec3(5, 0.5, 0), Vec3(0, -8, 4)}, 2.0);
  OwnedSheet b =
      points_only({Vec3(0.3, -5, 0.3 - depth), Vec3(0, 5, 0.3 - depth), Vec3(8, 0, 4.3)}, 2.0);
  a.triangles = b.triangles = {{0, 1, 2}};
  EdgeEdgeContact contact;
  contact.law = {3.0, 0.0, 0.0};
  contact.distance = 0.3;
  const SheetEdges edges = sheet_edges(a.triangles, a.x);
  const std::vector<std::int32_t> first{0};
  const std::vector<Box3> motion(1, Box3(Vec3::Zero(), Vec3::Constant(10.0))); // one patch
  const auto of = [&](const OwnedSheet& sheet) { return EdgeSheet{sheet.state(), edges, motion}; };
  find_edge_pairs(contact, of(a), first, of(b), first, margin);
  const auto forces = [&] {
    std::vector<Vec3> f(6, Vec3::Zero());
    edge_forces(contact, of(a), of(b), 0.0, std::span(f).first(3), std::span(f).last(3));
    return f;
  };
  const std::vector<Vec3> before = forces();
  ASSERT_EQ(contact.sums.touching, 1);
  std::vector<ContactTangent> springs;
  append_tangents(contact, a.state(), b.state(), 0.0, {}, springs);
  Random random(5);
  const auto y_a = random_motion(a, random), y_b = random_motion(b, random);
  std::vector<Vec3> f(6, Vec3::Zero());
  add_tangent_forces(springs, y_a, y_b, std::span(f).first(3), std::span(f).last(3));
  a.move(y_a);
  b.move(y_b);
  EXPECT_LE(largest_difference(f, minus(before, forces())), 1e-3 * largest_norm(f));
}

} // namespace
} // namespace plyform::contact_tangent_test
