// SPDX-License-Identifier: GPL-3.0-or-later
// Foils that a pressure forms, and what their runs are judged with.
#pragma once

#include "support/stress_scenes.hpp"

#include <cmath>

namespace plyform::pressure_scenes {

constexpr double stretch_stiffness = 100.0, nu = 0.3; // N/mm, - of film()

/// The root of f, which rises from below 0 at `low` to above it at `high`.
template <class F>
double root(double low, double high, const F& f) {
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (f(middle) < 0.0 ? low : high) = middle;
  }
  return low;
}

/// Up by 0.6 of the duration, then at rest: `damping` (1/s) takes the motion out.
inline void inflate(Case& data, double pressure, double duration, double damping) {
  data.loads = {{0, PlyFace::below, pressure, {{0.6, pressure}}}};
  set_friction(data, 0.0);
  data.solver.duration = duration;
  data.solver.mass_damping = damping;
  data.solver.step_factor = 0.8;
}

inline Fabric film() {
  Fabric film;
  film.name = "foil";
  film.thickness = 0.5;
  film.surface_density = 4.75e-10;
  film.sheet = IsotropicLaw{stretch_stiffness, nu};
  return film;
}

/// Motion is a millionth of what deforms, and the balance of energies is closed.
inline void expect_rest(const RunResult& run) {
  ASSERT_TRUE(ended(run.summary.status)) << run.summary.message;
  const Energies& e = run.last.energy;
  EXPECT_LT(e.kinetic, 1e-6 * e.external);
  EXPECT_LT(std::abs(e.balance_error()), 1e-3);
}

} // namespace plyform::pressure_scenes
