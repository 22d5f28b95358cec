// SPDX-License-Identifier: GPL-3.0-or-later
// A yarn that relaxes and creeps, as polymer yarns and tapes do: a spring W' beside a branch of a
// spring k and a dashpot in line, of the time theta (a standard linear solid in tension).
//
//   e      -   strain of the yarn itself: that of the sheet while it is taut
//   q      N   tension of the branch
//
//   N = W'(e) + q,   q' + q/theta = k e'                                                        (R)
//
// with q_1 of (X) of core/model/viscous_shear.hpp. A yarn pushes with its compression alone: where
// (R) would, it is slack, longer than the sheet leaves it room by e less the strain, and goes back
// in its own time, by W'(e) + q = 0. Temperature changes theta by its factor.
#pragma once

#include "core/model/fabric.hpp"
#include "core/model/law_input.hpp"

#include <algorithm>

namespace plyform {

/// States: 1 + e, and q. Viscous while it is taut, as ViscousYarn; that loses its force times the
/// motion of a step.
struct RelaxingYarn {
  static constexpr int states = 2;
  static constexpr bool has_rates = true;
  const TensionLaw& elastic;
  const MaxwellBranch& branch; ///< k in N, theta in s of the process
  double viscosity = 0.0;      ///< eta, N s, of the simulation

  static void start(double* state) { state[0] = 1.0, state[1] = 0.0; }

  LawAnswer at(const LawInput& in, const double* now, double* next) const {
    const double e0 = now[0] - 1.0, q0 = now[1];
    MaxwellStep step{1.0, branch.modulus}; // of no time
    if (in.per_process_dt > 0.0)
      step = maxwell_step({branch.modulus, in.time_factor * branch.time}, 1.0 / in.per_process_dt);
    const auto tension = [&](double e) { return step.keep * q0 + step.rise * (e - e0); };
    const bool taut = in.strain >= 0.0 && elastic.at(in.strain).value + tension(in.strain) >= 0.0;
    const double e =
        taut ? in.strain : slack_strain(std::max(0.0, in.strain), e0, tension, step.rise);
    const double q = tension(e), k = branch.modulus;
    next[0] = 1.0 + e, next[1] = q;
    const LawPoint spring = elastic.at(e);
    LawAnswer answer;
    answer.stored = spring.energy + 0.5 * q * q / k;
    answer.flowed = 0.5 * (q0 + q) * ((e - e0) - (q - q0) / k);
    if (!taut) {
      const LawPoint pressed = elastic.at(std::min(0.0, in.strain - e));
      answer.value = pressed.value, answer.slope = pressed.slope;
      answer.stored += pressed.energy;
      answer.flowed += pressed.value * (e - e0); // it goes back, and what presses it follows
      return answer;
    }
    const double viscous = viscosity * (e - e0) * in.per_dt;
    answer.value = spring.value + q + viscous;
    answer.slope = spring.slope + step.rise, answer.damping = viscosity;
    answer.lost = viscous * (e - e0);
    return answer;
  }

  LawBound bound() const {
    return {elastic.largest_slope() + branch.modulus, viscosity, branch.modulus};
  }

private:
  /// e of W'(e) + q_1 = 0, between `least` and e0: at the one it would push, at the other it pulls.
  /// tension: q_1 over e, whose slope is `rise`.
  template <class Tension>
  double slack_strain(double least, double e0, const Tension& tension, double rise) const {
    double low = least, high = std::max(least, e0), e = high;
    for (int i = 0; i < 60 && low < high; ++i) { // Newton within a bracket
      const LawPoint spring = elastic.at(e);
      const double n = spring.value + tension(e);
      (n > 0.0 ? high : low) = e;
      const double newton = e - n / (spring.slope + rise);
      const double to = newton >= low && newton <= high ? newton : 0.5 * (low + high);
      if (to == e) break;
      e = to;
    }
    return e;
  }
};

} // namespace plyform
