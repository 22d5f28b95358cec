// SPDX-License-Identifier: GPL-3.0-or-later
// The time step: what it must conserve, known vibrations, where it is stable, how it stops.
#include "core/model/motion.hpp"
#include "core/ply/membrane_eigenvalue.hpp"
#include "core/run/checkpoint.hpp"
#include "core/solver/nodal_forces.hpp"
#include "core/solver/stable_time_step.hpp"
#include "core/solver/step.hpp"
#include "support/boundary_scenes.hpp"

#include <gtest/gtest.h>

namespace plyform::step_test {
namespace {

/// A ply without tools, 10 x 10 cells of 10 mm.
Case free_ply(double angle, double step_factor = 0.9) {
  Case data = stack_of({angle}, rectangle(100.0, 100.0, 10.0));
  set_friction(data, 0.0);
  data.solver.step_factor = step_factor;
  return data;
}

/// The same with bending: linear along warp, by table along weft.
Case bending_ply(double angle, double step_factor = 0.9) {
  Case data = free_ply(angle, step_factor);
  Fabric& fabric = data.fabrics[0];
  fabric.families[0].bending.stiffness = 20.0;
  fabric.families[1].bending.curvature = {0.0, 0.02, 0.1};
  fabric.families[1].bending.moment = {0.0, 0.2, 0.6};
  fabric.twist = 14.0;
  fabric.families[0].tension.compression = 0.01 * fabric.families[0].tension.stiffness;
  fabric.families[1].tension.compression = 0.01 * fabric.families[1].tension.stiffness;
  return data;
}

struct Momenta {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
  double scale = 0.0; ///< sum of the absolute momenta, t mm/s
};

/// At the half step that led to x: x can be taken before or after it, x_(i+1) - x_i runs along v.
Momenta momenta_of(const PlyBody& ply) {
  Momenta m;
  for (std::size_t n = 0; n < ply.x.size(); ++n) {
    const Vec3 p = ply.membrane.node_mass[n] * ply.velocity[n];
    m.linear += p;
    m.angular += ply.x[n].cross(p);
    m.scale += p.norm();
  }
  return m;
}

/// Sets a free ply off at random and lets it fly 1000 steps. Returns the gain of energy over the
/// energy.
double fly(const Case& data) {
  Scene s = make_scene(data);
  PlyBody& ply = s.plies[0];
  Random random(1);
  double kinetic = 0.0;
  for (std::size_t n = 0; n < ply.x.size(); ++n) {
    ply.velocity[n] = 1000.0 * random_vector(random) + Vec3(300.0, 0.0, 500.0);
    kinetic += 0.5 * ply.membrane.node_mass[n] * ply.velocity[n].squaredNorm();
  }
  const Momenta before = momenta_of(ply);
  ThreadPool pool(1);
  start(s, pool);
  for (int step = 0; step < 1000; ++step) {
    if (compute_forces(s, pool)) return std::nan("");
    move_plies(s, pool);
  }
  if (compute_forces(s, pool)) return std::nan("");
  const Momenta after = momenta_of(ply);
  EXPECT_LE((after.linear - before.linear).norm(), 1e-10 * before.scale);
  EXPECT_LE((after.angular - before.angular).norm(), 1e-10 * before.scale * 50.0);
  const Energies e = current_energies(s, pool);
  // yarns that bear no compression may all be slack just now; twelve digits of stretches of one
  const MembraneEnergy m = membrane_energy(ply.membrane, ply.x);
  EXPECT_NEAR(e.fibre, m.fibre, 1e-11 * (m.fibre + m.shear));
  EXPECT_NEAR(e.shear, m.shear, 1e-11 * m.shear);
  if (data.fabrics[0].families[0].tension.compression > 0.0) {
    EXPECT_GT(e.fibre, 0.0);
  }
  EXPECT_GT(e.damping, 0.0);
  EXPECT_GT(e.shear, 0.0);
  EXPECT_EQ(e.external, 0.0);
  EXPECT_EQ(e.bending > 0.0, bending_law(data.fabrics[0]).any());
  return (e.kinetic + e.fibre + e.shear + e.bending + e.damping) / kinetic - 1.0;
}

TEST(Step, FreePlyKeepsItsMomentaAndEnergy) {
  for (const double angle : {0.0, 0.4}) { // the plain and the averaged element
    // fibres go taut and slack all the time, in all of the mesh's highest modes: no more can be
    // asked of large steps, but the error has to vanish with them
    EXPECT_LT(std::abs(fly(free_ply(angle, 0.8))), 0.05) << angle;
    EXPECT_LT(std::abs(fly(free_ply(angle, 0.2))), 0.002) << angle;
    EXPECT_LT(std::abs(fly(bending_ply(angle, 0.8))), 0.05) << angle;
    EXPECT_LT(std::abs(fly(bending_ply(angle, 0.2))), 0.002) << angle;
  }
}

TEST(Step, KnowsOfBendingAndOnlyWhereAFabricHasIt) {
  const Scene without = make_scene(free_ply(0.4)), with = make_scene(bending_ply(0.4));
  EXPECT_FALSE(without.plies[0].bending);
  EXPECT_TRUE(without.bending_blocks.empty());
  ASSERT_TRUE(with.plies[0].bending);
  const double bending = with.plies[0].bending->omega2;
  EXPECT_GT(bending, 0.0);
  // yarns that are no stiffer when pressed than when pulled leave the membrane's bound as it is,
  // but for their kink
  ThreadPool pool(1);
  const double membrane = stable_step(without, contact_rows(without, pool)).omega2;
  EXPECT_NEAR(stable_step(with, contact_rows(with, pool)).omega2,
              kink_factor(with.plies[0].membrane) * membrane + bending, 1e-12 * membrane);
}

TEST(Step, IsStableWhereBendingSetsIt) {
  Case data = bending_ply(0.4);
  data.solver.fibre_softening = 1000.0;
  for (TensionLaw* yarn :
       {&data.fabrics[0].families[0].tension, &data.fabrics[0].families[1].tension})
    yarn->compression = 0.001 * yarn->stiffness;          // or they would be softened less
  data.fabrics[0].families[0].bending.stiffness = 5000.0; // N mm
  const Scene s = make_scene(data);
  ASSERT_GT(s.plies[0].bending->omega2,
            2.0 * eigenvalue_bound(s.plies[0].membrane, s.plies[0].x).omega2);
  EXPECT_LT(std::abs(fly(data)), 0.05);
}

/// Laws with a history, too: only move_plies takes a step.
TEST(Step, ForcesAskedForTwiceAreTheSame) {
  const Case data = strip(0.3, Vec3::UnitX(), 1.0);
  Scene once = make_scene(data), twice = make_scene(data);
  ThreadPool pool(1);
  start(once, pool), start(twice, pool);
  for (int i = 0; i < 200; ++i) {
    ASSERT_FALSE(compute_forces(once, pool) || compute_forces(twice, pool));
    element_and_contact_forces(twice, pool);
    EXPECT_EQ(current_energies(once, pool).damping, current_energies(twice, pool).damping);
    move_plies(once, pool), move_plies(twice, pool);
  }
  EXPECT_GT(current_energies(once, pool).damping, 0.0);
  EXPECT_EQ(first_difference(twice, save_state(once, RunState{})), "");
}

TEST(Step, MassDampingTakesWhatTheKineticEnergyLoses) {
  Case data = stack_of({0.4}, rectangle(100.0, 100.0, 10.0));
  set_friction(data, 0.0);
  data.solver.fibre_softening = 100.0;
  data.solver.mass_damping = 2000.0; // 1/s: a few per cent a step
  Scene s = make_scene(data);
  for (Vec3& v : s.plies[0].velocity)
    v = Vec3(300.0, -200.0, 500.0);
  ThreadPool pool(1);
  start(s, pool);
  Energies first; // not at once: no step has led to the first positions
  for (int step = 0; step <= 60; ++step) {
    ASSERT_FALSE(compute_forces(s, pool));
    if (step == 10) first = current_energies(s, pool);
    move_plies(s, pool);
  }
  ASSERT_FALSE(compute_forces(s, pool));
  const Energies last = current_energies(s, pool);
  EXPECT_LT(last.kinetic, 0.2 * first.kinetic);
  EXPECT_NEAR(last.damping - first.damping, first.kinetic - last.kinetic, 1e-10 * first.kinetic);
}

/// A strip of warp, 100 x 10 mm, in 10 cells, stretched by `strain`; its ends cannot move.
Scene taut_strip(double strain, ElementKind element) {
  Case data = stack_of({0.0}, rectangle(100.0, 10.0, 10.0));
  set_friction(data, 0.0);
  data.solver.element = element;
  data.solver.fibre_damping = 0.0;
  data.solver.step_factor = 0.2;
  Scene s = make_scene(data);
  PlyBody& ply = s.plies[0];
  for (std::size_t n = 0; n < ply.x.size(); ++n) {
    ply.x[n].x() *= 1.0 + strain;
    if (std::abs(ply.x0[n].x()) > 49.0) ply.mass[n] = ply.membrane.node_mass[n] = 1e9; // t: a wall
  }
  return s;
}

/// Angular frequency (rad/s) of the first mode along `direction`, from the times at which its
/// amplitude passes zero upwards.
double measured_frequency(Scene& s, const Vec3& direction, double speed) {
  PlyBody& ply = s.plies[0];
  const std::vector<Vec3> rest = ply.x;
  std::vector<double> mode;
  for (std::size_t n = 0; n < ply.x.size(); ++n) {
    mode.push_back(std::cos(std::numbers::pi * ply.x0[n].x() / 100.0));
    ply.velocity[n] = speed * mode[n] * direction;
  }
  ThreadPool pool(1);
  start(s, pool);
  const auto amplitude = [&] {
    double sum = 0.0;
    for (std::size_t n = 0; n < ply.x.size(); ++n)
      sum += mode[n] * (ply.x[n] - rest[n]).dot(direction);
    return sum;
  };
  std::vector<double> crossings;
  double last = 0.0, last_time = 0.0;
  while (crossings.size() < 6 && s.step < 100000) {
    if (compute_forces(s, pool)) return std::nan("");
    move_plies(s, pool);
    const double now = amplitude();
    if (last < 0.0 && now >= 0.0)
      crossings.push_back(last_time + (s.time - last_time) * last / (last - now));
    last = now;
    last_time = s.time;
  }
  return 2.0 * std::numbers::pi * 5.0 / (crossings.back() - crossings.front());
}

TEST(Step, TautStripVibratesAtItsClosedFormFrequency) {
  // A chain of N cells of length h between walls: omega = 2/h sqrt(K/rho) sin(pi / 2N), with K = C
  // d along the strip and K = d N / lambda across it; central differences make of it sin(omega' dt
  // / 2) = omega dt / 2.
  const double strain = 0.01, rho = 6e-10, stiffness = 46000.0 * 0.25;
  const double chain = 2.0 / 10.0 * std::sin(std::numbers::pi / 20.0);
  const double along = chain * std::sqrt(stiffness / rho);
  const double across = chain * std::sqrt(stiffness * strain / (1.0 + strain) / rho);
  for (const ElementKind element : {ElementKind::plain, ElementKind::averaged}) {
    Scene s = taut_strip(strain, element);
    double measured = measured_frequency(s, Vec3::UnitX(), 100.0); // to 7e-4 mm
    // 1e-4: crossings by straight lines, at 100 steps a period
    EXPECT_NEAR(measured, 2.0 / s.dt * std::asin(0.5 * along * s.dt), 1e-4 * along);
    s = taut_strip(strain, element);
    measured = measured_frequency(s, Vec3::UnitZ(), 100.0); // to 7e-3 mm: no further stretch
    EXPECT_NEAR(measured, 2.0 / s.dt * std::asin(0.5 * across * s.dt), 1e-4 * across);
  }
}

TEST(Step, DrivenToolFollowsItsPath) {
  Case data = stack_of({0.0}, rectangle(100.0, 100.0, 10.0));
  Tool ball;
  ball.name = "ball";
  ball.shape = Sphere{10.0};
  ball.position = {0.0, 0.0, 100.0};
  ball.motion = Motion::driven;
  ball.direction = Vec3(0.6, 0.0, -0.8);
  ball.stroke = 40.0;
  data.tools = {ball};
  set_friction(data, 0.1);
  data.solver.duration = 2e-3;
  Scene s = make_scene(data);
  ThreadPool pool(1);
  start(s, pool);
  Vec3 last = Vec3::Zero();
  for (;;) {
    ASSERT_FALSE(compute_forces(s, pool));
    const ToolBody& body = s.tools[0].body;
    const double u = std::min(1.0, s.time / 2e-3);
    const auto ramp = [](double w) { return 40.0 / 3.0 * std::pow(w, 3) * (1.0 - 0.5 * w); };
    const double way = u < 0.25   ? ramp(4.0 * u)
                       : u > 0.75 ? 40.0 - ramp(4.0 - 4.0 * u)
                                  : 40.0 * 4.0 / 3.0 * (u - 0.125);
    EXPECT_NEAR((body.displacement - way * ball.direction).norm(), 0.0, 1e-12);
    EXPECT_NEAR((body.motion - (body.displacement - last)).norm(), 0.0, 1e-14);
    last = body.displacement;
    if (s.time >= 2e-3) break;
    move_plies(s, pool);
  }
  EXPECT_NEAR((last - 40.0 * ball.direction).norm(), 0.0, 1e-12);
  EXPECT_TRUE(s.tools[0].force.isZero(0.0)); // it met nothing
}

TEST(Step, StopsAtACollapsedTriangle) {
  for (const bool sheared : {false, true}) {
    Scene s = make_scene(free_ply(0.0));
    for (Vec3& x : s.plies[0].x)
      if (sheared)
        x = Vec3(x.x() + 80.0 * x.y(), x.y(), x.z()); // yarns less than 2 % of a right angle apart
      else
        x.x() *= 0.05;
    ThreadPool pool(1);
    start(s, pool);
    const auto stop = compute_forces(s, pool);
    ASSERT_TRUE(stop);
    for (const char* part : {"stopped at step 0", "time ", "ply ply1", "triangle", "collapsed"})
      EXPECT_NE(stop->message.find(part), std::string::npos) << stop->message;
  }
}

TEST(Step, StopsAtAPositionThatIsNotFiniteOrEndlesslyFar) {
  for (const double velocity : {std::nan(""), 1e16, 1e200, 1e308}) { // mm/s
    Scene s = make_scene(free_ply(0.0));
    ThreadPool pool(1);
    start(s, pool);
    ASSERT_FALSE(compute_forces(s, pool));
    s.plies[0].velocity[17].y() = velocity;
    move_plies(s, pool);
    const auto stop = compute_forces(s, pool); // in the very next step
    ASSERT_TRUE(stop) << velocity;
    for (const char* part : {"stopped at step 1", "time ", "ply ply1, node 17", "not finite"})
      EXPECT_NE(stop->message.find(part), std::string::npos) << stop->message;
  }
}

} // namespace
} // namespace plyform::step_test
