// SPDX-License-Identifier: GPL-3.0-or-later
// The force of a tool without the jitter of contact: double exponential smoothing (Brown,
// Smoothing, Forecasting and Prediction of Discrete Time Series, 1963, chapter 9).
//
//   G' = (F - G) / tau,  H' = (G - H) / tau;   2 G - H
//
// A force that rises steadily passes without a lag; a vibration of angular frequency omega, many
// times 1 / tau, is reduced to 2 / (omega tau) of itself.
#pragma once

#include "base/geometry.hpp"

#include <cmath>

namespace plyform {

constexpr double filter_share = 1.0 / 200.0; ///< tau over solver.duration

struct ForceFilter {
  Vec3 once = Vec3::Zero(), twice = Vec3::Zero(); ///< G, H, N

  Vec3 value() const { return 2.0 * once - twice; } ///< N

  /// The force F (N) at the end of a step of dt (s); tau: s.
  void add(const Vec3& force, double dt, double tau) {
    const double share = 1.0 - std::exp(-dt / tau);
    once += share * (force - once);
    twice += share * (once - twice);
  }
};

template <class F>
void each_member(ForceFilter& filter, F&& f) {
  auto& [once, twice] = filter;
  f("once", once);
  f("twice", twice);
}

} // namespace plyform
