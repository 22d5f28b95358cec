// SPDX-License-Identifier: GPL-3.0-or-later
// Friction on both branches of a Stribeck curve (contact/forces/friction_law.hpp): a ply between
// plates under a force F, drawn at a speed v of the process, against the law on its two faces,
//
//   pull = 2 F mu(H),  H = eta v A / F
//
// Where mu falls with H, what is elastic in the ply and in contact must not swing.
#include "core/model/motion.hpp"
#include "support/kill_checks.hpp"
#include "support/stress_scenes.hpp"
#include "support/thread_checks.hpp"

#include <cmath>

namespace plyform::stribeck_test {
namespace {

constexpr double length = 40.0, width = 30.0, force = 60.0, way = 6.0; // mm, N
constexpr double viscosity = 3e-4;                                     // N s/mm^2: 300 Pa s

/// Least at a Hersey number of about 0.0085 mm.
FrictionLawSpec stribeck() {
  FrictionLawSpec spec;
  spec.name = "melt", spec.kind = FrictionLawSpec::Kind::hersey;
  spec.viscosity = viscosity;
  spec.boundary = 0.18, spec.transition = 3e-3, spec.hydrodynamic = 0.9, spec.exponent = 0.6;
  return spec;
}

/// Drawn so that H is `number` (mm) in the middle half of the time.
Case drawn(double number, double element, double duration) {
  Case data = stack_of({0.0}, rectangle(length, width, element));
  stiffen_yarns(data.fabrics[0]);
  press_by_plate(data);
  data.tools[1].force = force;
  data.friction_laws = {std::make_shared<FrictionLaw>(stribeck())};
  data.friction.mu.assign(data.friction.mu.size(), 0.0);
  data.friction.law.assign(data.friction.mu.size(), 0);
  Boundary grip =
      hold("pull", {0.5 * length, -0.5 * width}, {0.5 * length, 0.5 * width}, Vec3::UnitX(), way);
  grip.ply = 0;
  grip.as<Grip>().held = {true, true, false};
  data.boundaries = {grip};
  const double speed = number * force / (length * width) / viscosity;
  data.process.duration = peak_speed_ratio * way / speed;
  data.solver.mass_damping = 0.0;
  data.solver.fibre_softening = 10.0;
  data.solver.duration = duration;
  data.solver.outputs = 100;
  return data;
}

/// N, mean while the speed stays, and the largest deviation from it.
struct Pull {
  double mean = 0.0, off = 0.0;
};

Pull pull_of(const Case& data) {
  std::vector<double> found;
  double film = 0.0;
  bool lost = true; // never given back
  RunHooks hooks;
  hooks.frame = [&](const Frame& f) {
    const double share = f.time / data.solver.duration;
    if (share > 0.35 && share < 0.72) found.push_back(f.boundaries.at(0).force_N);
    lost = lost && f.energy.film >= film;
    film = f.energy.film;
  };
  const RunResult run = run_case(data, 1, hooks);
  EXPECT_TRUE(ended(run.summary.status)) << run.summary.message;
  EXPECT_LE(imbalance(run.last.energy), 0.01);
  EXPECT_TRUE(lost);
  Pull pull;
  for (const double f : found)
    pull.mean += f / static_cast<double>(found.size());
  for (const double f : found)
    pull.off = std::max(pull.off, std::abs(f - pull.mean));
  return pull;
}

TEST(Stribeck, PullFollowsTheLawOnBothBranches) {
  for (const double number : {0.003, 0.006, 0.03})
    for (const double element : {5.0, 7.5})
      for (const double duration : {0.02, 0.04}) {
        const Pull pull = pull_of(drawn(number, element, duration));
        const double wanted = 2.0 * force * stribeck().hersey(number);
        fmt::print("H {} mm, elements of {} mm, {} s: pull {:.3f} N, {:+.2f} % off, scatter "
                   "{:.2f} %\n",
                   number, element, duration, pull.mean, 100.0 * (pull.mean / wanted - 1.0),
                   100.0 * pull.off / wanted);
        EXPECT_NEAR(pull.mean, wanted, 0.01 * wanted)
            << number << ' ' << element << ' ' << duration;
        EXPECT_LT(pull.off, 0.03 * wanted);
      }
}

TEST(Stribeck, GoesOnWithTheSameBitsAfterKills) {
  Case data = drawn(0.006, 7.5, 0.01);
  data.solver.outputs = 10;
  expect_sound_and_repeatable(data, 3);
}

} // namespace
} // namespace plyform::stribeck_test
