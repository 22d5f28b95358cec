// SPDX-License-Identifier: GPL-3.0-or-later
// Mass scaling: how much mass which nodes get, and that energy is kept with it.
#include "core/solver/mass_scaling.hpp"
#include "core/solver/nodal_forces.hpp"
#include "core/solver/stable_time_step.hpp"
#include "core/solver/step.hpp"
#include "support/scene_checks.hpp"

#include <gtest/gtest.h>
#include <numeric>

namespace plyform::mass_scaling_test {
namespace {

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// A ply of 121 nodes, five of which have contacts of 1 to 5 times the elements' omega^2.
struct Touched {
  Scene scene;
  ContactRows rows;
  double elements = 0.0; ///< 1/s^2

  explicit Touched(double mass_scaling) {
    Case data = stack_of({0.0}, rectangle(100.0, 100.0, 10.0));
    data.solver.mass_scaling = mass_scaling;
    scene = make_scene(data);
    const PlyBody& ply = scene.plies[0];
    elements = element_omega2(ply);
    rows.emplace_back(ply.x.size());
    for (std::size_t n = 0; n < 5; ++n)
      rows[0][n].stiffness = static_cast<double>(n + 1) * elements * ply.membrane.node_mass[n];
  }
  void scale() { // until nothing changes
    for (int i = 0; i < 50; ++i)
      scale_masses(scene, scene.tools, rows);
  }
  double omega2(std::size_t n) const { return rows[0][n].stiffness / scene.plies[0].mass[n]; }
  double added() const {
    const PlyBody& ply = scene.plies[0];
    return sum(ply.mass) / sum(ply.membrane.node_mass) - 1.0;
  }
};

TEST(MassScaling, BringsStiffContactsToHalfOfTheElements) {
  Touched t(0.9);
  PlyBody& ply = t.scene.plies[0];
  for (Vec3& v : ply.velocity)
    v = {0.0, 3.0, 4.0};
  scale_masses(t.scene, t.scene.tools, t.rows); // a quarter at a time
  EXPECT_DOUBLE_EQ(ply.mass[4], 1.25 * ply.membrane.node_mass[4]);
  t.scale();
  for (std::size_t n = 0; n < 5; ++n)
    EXPECT_NEAR(t.omega2(n), 0.5 * t.elements, 1e-12 * t.elements);
  for (std::size_t n = 5; n < ply.x.size(); ++n)
    EXPECT_EQ(ply.mass[n], ply.membrane.node_mass[n]);
  EXPECT_NEAR(t.scene.largest_added_mass, t.added(), 1e-12);
  const double brought = 0.5 * 25.0 * t.added() * sum(ply.membrane.node_mass);
  EXPECT_NEAR(t.scene.mass_scaling_work, brought, 1e-12 * brought);
  // the weight stays that of the cloth
  const Vec3 g(0.0, 0.0, -9810.0);
  const Vec3 fall = acceleration(ply, std::size_t{4}, Vec3::Zero(), {g, 0.0});
  EXPECT_NEAR(fall.z() * ply.mass[4], g.z() * ply.membrane.node_mass[4], 1e-12 * -g.z());
  // and all is given back when contacts have opened
  t.rows[0].assign(ply.x.size(), {});
  t.scale();
  EXPECT_EQ(ply.mass, ply.membrane.node_mass);
  EXPECT_NEAR(t.scene.mass_scaling_work, 0.0, 1e-12 * brought);
}

TEST(MassScaling, AddsNoMoreThanItsShareAndLeavesTheStiffestEqual) {
  Touched t(0.01);
  t.scale();
  EXPECT_NEAR(t.added(), 0.01, 1e-12);
  const double left = t.omega2(4);
  EXPECT_GT(left, 0.5 * t.elements);
  for (std::size_t n = 0; n < 5; ++n)
    EXPECT_NEAR(t.omega2(n), std::min(left, static_cast<double>(n + 1) * t.elements), 1e-9 * left);
  Touched none(0.0);
  none.scale();
  EXPECT_EQ(none.scene.plies[0].mass, none.scene.plies[0].membrane.node_mass);
}

struct Pressed {
  double stable_dt, balance, added; ///< s; -; share of a ply's mass
};

/// Two plies driven together by a plate, with contacts ten times as stiff as usual.
Pressed press(double mass_scaling) {
  Case data = stack_of({0.0, 0.8}, rectangle(50.0, 50.0, 5.0));
  press_by_plate(data);
  data.contact.stiffness = 1.0;
  data.solver.step_factor = 0.8;
  data.solver.mass_scaling = mass_scaling;
  Scene s = make_scene(data);
  ThreadPool pool(1);
  start(s, pool);
  s.start_energy = current_energies(s, pool).residual();
  for (int step = 0; step < 3000; ++step) {
    if (auto stop = compute_forces(s, pool)) {
      ADD_FAILURE() << stop->message;
      break;
    }
    move_plies(s, pool);
  }
  EXPECT_FALSE(compute_forces(s, pool));
  EXPECT_GT(s.tools[1].force.norm() + s.tools[0].force.norm(), 0.0);
  return {s.stable_dt, current_energies(s, pool).balance_error(), s.largest_added_mass};
}

TEST(MassScaling, MakesStepsLongerAndKeepsTheEnergy) {
  const Pressed without = press(0.0), with = press(0.9);
  EXPECT_EQ(without.added, 0.0);
  EXPECT_GT(with.added, 0.05);
  EXPECT_GT(with.stable_dt, 1.3 * without.stable_dt);
  EXPECT_LT(std::abs(without.balance), 0.005);
  EXPECT_LT(std::abs(with.balance), 0.005);
}

} // namespace
} // namespace plyform::mass_scaling_test
