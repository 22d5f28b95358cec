// SPDX-License-Identifier: GPL-3.0-or-later
// Where the step is stable: below its bound, alone and in a stack, and not above it.
#include "core/ply/membrane_eigenvalue.hpp"
#include "core/run/run.hpp"
#include "core/setup/prepare_case.hpp"
#include "core/solver/contact_rows.hpp"
#include "core/solver/stable_time_step.hpp"
#include "core/solver/step.hpp"
#include "support/scene_checks.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <limits>

namespace plyform::stable_time_step_test {
namespace {

/// A ply held taut all round, without damping, its nodes set off at random. Returns why it stopped,
/// or nothing if it did not; `growth`: largest energy over that at first.
std::optional<Stop> let_a_taut_ply_vibrate(ElementKind element, double step_factor,
                                           double& growth) {
  Case data = stack_of({0.0}, rectangle(100.0, 100.0, 10.0));
  data.solver.element = element;
  set_friction(data, 0.0);
  data.solver.fibre_damping = 0.0;
  data.solver.step_factor = step_factor;
  Scene s = make_scene(data);
  PlyBody& ply = s.plies[0];
  Random random(2);
  for (std::size_t n = 0; n < ply.x.size(); ++n) {
    ply.x[n].head<2>() *= 1.005;
    if (ply.x0[n].head<2>().lpNorm<Eigen::Infinity>() > 49.0)
      ply.mass[n] = ply.membrane.node_mass[n] = 1e9; // t: a frame
    else
      ply.velocity[n] = 1000.0 * random_vector(random); // keeps all fibres taut
  }
  ThreadPool pool(1);
  start(s, pool);
  const auto energy = [&] {
    const Energies e = current_energies(s, pool);
    return e.kinetic + e.fibre + e.shear;
  };
  double first = 0.0;
  growth = 0.0;
  for (int step = 0; step < 4000; ++step) {
    if (auto stop = compute_forces(s, pool)) return stop;
    if (step == 1) first = energy();
    if (step > 0) growth = std::max(growth, energy() / first);
    move_plies(s, pool);
  }
  return std::nullopt;
}

TEST(Step, IsStableBelowTheBoundAndStopsAboveIt) {
  for (const ElementKind element : {ElementKind::plain, ElementKind::averaged}) {
    for (const double step_factor : {0.5, 0.9, 0.99}) {
      double growth = 0.0;
      EXPECT_FALSE(let_a_taut_ply_vibrate(element, step_factor, growth)) << step_factor;
      // near the bound the ledger's energy of the highest modes is 1/(1 - step_factor^2) of theirs
      EXPECT_LT(growth, step_factor < 0.95 ? 1.1 : 1.6) << step_factor;
      EXPECT_GT(growth, 0.0);
    }
    double growth = 0.0;
    const auto stop = let_a_taut_ply_vibrate(element, 1.05, growth);
    // yarns that go slack in turns hold the averaged element's energy at some hundred times the
    // first: a whole run stops by its ledger then (Run.StopsWhenTheStepIsTooLarge)
    EXPECT_TRUE(stop || growth > 100.0) << growth;
    if (!stop) continue;
    for (const char* part : {"stopped at step ", "time ", "ply ply1"})
      EXPECT_NE(stop->message.find(part), std::string::npos) << stop->message;
  }
}

TEST(ContactRows, OnlyOfPairsThatHaveDeepenedAreComputedAnew) {
  Case data = stack_of({0.0, 0.8, 0.0}, rectangle(50.0, 50.0, 5.0));
  set_friction(data, 0.2);
  Scene s = make_scene(data);
  ThreadPool pool(2);
  start(s, pool);
  ASSERT_FALSE(compute_forces(s, pool));
  const auto is_near = [](const PlyPair& pair) { return !pair.rows_a.empty(); };
  std::vector<PlyPair> before = s.ply_pairs;
  ASSERT_GE(std::count_if(before.begin(), before.end(), is_near), 2);
  const auto sum = [](const std::vector<ContactRow>& rows) {
    double stiffness = 0.0;
    for (const ContactRow& row : rows)
      stiffness += row.stiffness;
    return stiffness;
  };
  PlyPair& first = s.ply_pairs[0];
  for (PlyContact& pass : first.passes) { // as if all its points had been pressed in
    PlyPlyContact& contact = pass.contact;
    for (PlyPlyPoint& point : contact.points)
      point.gap = -0.5 * contact.law.max_depth;
    contact.sums.penetration = 0.5 * contact.law.max_depth;
  }
  renew_deepened_rows(s, s.ply_pairs, pool);
  EXPECT_GT(sum(first.rows_a), 1.5 * sum(before[0].rows_a));
  EXPECT_GT(sum(first.rows_b), 1.5 * sum(before[0].rows_b));
  for (const PlyContact& pass : first.passes)
    EXPECT_GT(pass.contact.renew_depth, pass.contact.sums.penetration);
  for (std::size_t p = 1; p < before.size(); ++p)
    EXPECT_EQ(sum(s.ply_pairs[p].rows_a), sum(before[p].rows_a)) << p;
  renew_rows(s, s.ply_pairs, pool); // nothing else had changed
  for (std::size_t p = 1; p < before.size(); ++p)
    EXPECT_EQ(sum(s.ply_pairs[p].rows_a), sum(before[p].rows_a)) << p;
}

/// Three plies held taut all round and pressed between two plates, nodes set off at random,
/// friction stuck. Returns the largest energy over that at first; infinite if it stopped.
double let_a_pressed_stack_vibrate(double damping, double step_factor, double& stretch) {
  Case data = stack_of({0.0, 0.8, 0.0}, rectangle(50.0, 50.0, 5.0));
  press_by_plate(data);
  const double top = 3.0 * data.fabrics[0].thickness;
  data.tools[1].motion = Motion::fixed;
  data.tools[1].position.z() = 0.97 * top + 5.0;
  set_friction(data, 1e6);
  data.solver.mass_damping = data.solver.mass_scaling = 0.0;
  data.solver.fibre_damping = data.contact.damping = damping;
  data.solver.step_factor = step_factor;
  Scene s = make_scene(data);
  Random random(2);
  for (PlyBody& ply : s.plies)
    for (std::size_t n = 0; n < ply.x.size(); ++n) {
      ply.x[n].head<2>() *= 1.005;
      ply.x[n].z() *= 0.97;
      if (ply.x0[n].head<2>().lpNorm<Eigen::Infinity>() > 24.0)
        ply.mass[n] = ply.membrane.node_mass[n] = 1e9; // t: a frame
      else
        ply.velocity[n] = 20.0 * random_vector(random);
    }
  ThreadPool pool(1);
  start(s, pool);
  stretch = s.time_step_gain;
  const auto energy = [&] {
    const Energies e = current_energies(s, pool);
    return e.kinetic + e.fibre + e.shear + e.contact;
  };
  double first = 0.0, largest = 0.0;
  for (int step = 0; step < 3000; ++step) {
    if (compute_forces(s, pool)) return std::numeric_limits<double>::infinity();
    if (step == 1) first = energy();
    if (step > 0) largest = std::max(largest, energy() / first);
    move_plies(s, pool);
  }
  return largest;
}

TEST(Step, OfAPressedStackIsLongerThanItsPartsSayAndStable) {
  struct Trial {
    double damping, part, most;
  };
  // With no damping at all nodes that go over to other faces stir the highest modes a little, and
  // contacts that stiffen with depth take them over the limit: within 3000 steps the energy grows
  // by 13 % at 0.8 of it, by 75 % at 0.9. Beyond the limit contacts that part and sheets that flap
  // hold the growth: it ends at 3 to 9 times, which rounding decides, so that twice counts.
  for (const auto& [damping, part, most] :
       {Trial{0.0, 0.7, 1.1}, Trial{0.01, 0.95, 1.01}, Trial{0.05, 0.98, 1.01}}) {
    double stretch = 0.0;
    EXPECT_LT(let_a_pressed_stack_vibrate(damping, part, stretch), most) << damping;
    EXPECT_GT(stretch, 1.1) << damping; // elements and contacts add up to less than their bounds
    EXPECT_GT(let_a_pressed_stack_vibrate(damping, 1.08, stretch), 2.0) << damping;
  }
}

/// A law of this stiffness in tension over that in compression.
double factor_of_kink(double tension, double compression) {
  Membrane m;
  m.families.resize(2);
  m.families[0].yarn.stiffness = m.families[1].yarn.stiffness = tension;
  m.families[1].yarn.compression = compression;
  return kink_factor(m);
}

TEST(StableStep, YarnsWithAKinkTakeShorterSteps) {
  EXPECT_DOUBLE_EQ(factor_of_kink(920.0, 920.0), 1.0);
  EXPECT_DOUBLE_EQ(factor_of_kink(920.0, 460.0), 1.0 + 0.8 * 0.25);
  EXPECT_DOUBLE_EQ(factor_of_kink(460.0, 920.0), 1.0 + 0.8 * 0.25);
  EXPECT_DOUBLE_EQ(factor_of_kink(0.0, 0.0), 1.0);
}

TEST(StableStep, YarnsWithAKinkDoNotGainEnergy) {
  // Half as stiff in compression as in tension, without friction: by the largest stiffness alone
  // the balance is off by 2.3e-2 at the end.
  const PreparedCase prepared =
      prepare_case(PLYFORM_CASES "/verify/hemisphere_small.toml", {{"contact.friction", "0.0"},
                                                                   {"solver.fibre_softening", "50"},
                                                                   {"solver.step_factor", "0.95"}});
  ASSERT_TRUE(prepared.value);
  const RunResult run = run_case(*prepared.value, 1, {}, prepared.meshes);
  EXPECT_TRUE(ended(run.summary.status)) << run.summary.message;
  EXPECT_LT(std::abs(run.last.energy.balance_error()), 2e-3);
}

} // namespace
} // namespace plyform::stable_time_step_test
