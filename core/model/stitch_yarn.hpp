// SPDX-License-Identifier: GPL-3.0-or-later
// The law of stitches.
#pragma once

#include "core/model/fabric.hpp"
#include "core/model/law_input.hpp"

#include <cmath>

namespace plyform {

/// A stitch: elastic, and gone for good once it has pulled harder than it can at the end of a step.
/// It then pulls no more at that end, so that it has done half the work of the step (by the
/// trapezoidal rule) that it would have done whole: what it had stored at the begin, and that half,
/// are lost. States: 1 once it is broken, else 0; and, of one that can break, its stretch. It has
/// no viscosity: solver.fibre_damping damps the stiffest modes of the mesh, those of yarns, and
/// stitches are as soft as shear, which it leaves alone.
struct StitchYarn {
  static constexpr int states = 2;
  static constexpr bool has_rates = false;
  const StitchLaw& elastic;

  static void start(double* state) { state[0] = 0.0, state[1] = 1.0; }
  LawAnswer at(const LawInput& in, const double* now, double* next) const {
    const double before = now[1];
    next[0] = now[0], next[1] = before;
    if (next[0] > 0.0) return {};
    const LawPoint point = elastic.at(in.strain);
    if (std::isfinite(elastic.breaking_force)) next[1] = 1.0 + in.strain;
    if (point.value > elastic.breaking_force) {
      next[0] = 1.0;
      const LawPoint was = elastic.at(before - 1.0);
      return {0.0, 0.0, 0.0, 0.0, was.energy + 0.5 * was.value * (next[1] - before)};
    }
    return {point.value, point.slope, 0.0, point.energy, 0.0};
  }
  LawBound bound() const { return {elastic.tension.largest_slope(), 0.0}; }
};

} // namespace plyform
