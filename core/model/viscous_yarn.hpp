// SPDX-License-Identifier: GPL-3.0-or-later
// Elastic yarns, straight or crimped, with the damping of the simulation.
#pragma once

#include "core/model/fabric.hpp"
#include "core/model/law_input.hpp"

namespace plyform {

/// Adds the viscous tension of a yarn (eta, N s) that is taut to its elastic point. States:
/// stretch, and viscous tension (N), whose work follows from both by the trapezoidal rule.
inline LawAnswer with_viscosity(const LawPoint& point, double viscosity, const LawInput& in,
                                const double* now, double* next) {
  const double stretch = 1.0 + in.strain, change = stretch - now[0];
  const double damping = point.value > 0.0 ? viscosity : 0.0;
  const double viscous = damping * change * in.per_dt;
  const double lost = 0.5 * (viscous + now[1]) * change;
  next[0] = stretch, next[1] = viscous;
  return {point.value + viscous, point.slope, damping, point.energy, lost};
}

/// An elastic yarn that is viscous while it is taut: N = W' + eta d(eps)/dt. The viscosity is
/// solver.fibre_damping, a fraction of critical of the stiffest mode of the mesh: it is there to
/// damp vibrations of the simulation, no property of cloth, and sees simulated time.
struct ViscousYarn {
  static constexpr int states = 2;
  static constexpr bool has_rates = false;
  const TensionLaw& elastic;
  double viscosity = 0.0; ///< eta, N s

  static void start(double* state) { state[0] = 1.0, state[1] = 0.0; }
  LawAnswer at(const LawInput& in, const double* now, double* next) const {
    return with_viscosity(elastic.at(in.strain), viscosity, in, now, next);
  }
  LawBound bound() const { return {elastic.largest_slope(), viscosity}; }
};

/// A yarn of a crimped cell, which has its tension from the cell; its compression is its own.
/// Viscous while it is taut, with the states of ViscousYarn.
struct CrimpedYarn {
  static constexpr int states = ViscousYarn::states;
  static constexpr bool has_rates = false;
  const TensionLaw& elastic;
  double viscosity = 0.0; ///< eta, N s

  static void start(double* state) { ViscousYarn::start(state); }
  LawAnswer at(const LawInput& in, const double* now, double* next) const {
    LawPoint point = in.cell;
    if (in.strain < 0.0) {
      const LawPoint pressed = elastic.at(in.strain);
      point = {point.value + pressed.value, point.slope + pressed.slope,
               point.energy + pressed.energy};
    }
    return with_viscosity(point, viscosity, in, now, next);
  }
  /// dN/deps at most: yarns are straighter than they are long, and may be pressed beside.
  LawBound bound() const { return {elastic.largest_slope() + elastic.compression, viscosity}; }
};

} // namespace plyform
