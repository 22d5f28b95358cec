// SPDX-License-Identifier: GPL-3.0-or-later
// What a part of the scene adds to the left side of (S) in core/solver/stable_time_step.hpp.
#pragma once

#include <cmath>

namespace plyform {

/// k and c of (S), 1/s^2 and 1/s; stability_lhs is the left side of (S), step the largest dt, s.
struct Frequencies {
  double omega2 = 0.0, damping = 0.0;

  double stability_lhs(double dt) const { return dt * dt * omega2 + 2.0 * dt * damping; }
  double step() const { return (std::sqrt(damping * damping + 4.0 * omega2) - damping) / omega2; }
};

} // namespace plyform
