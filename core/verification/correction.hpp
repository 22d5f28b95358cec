// SPDX-License-Identifier: GPL-3.0-or-later
// The cost parameters with which a run keeps the accuracy that its case asks for, from the errors
// that its siblings have shown (bands.hpp).
//
//   e_j    error by element size, inertia, softening;  c  chance;  k  factor of safety
//   x_j    the same after the correction
//   W      wanted;  A = (W/k)^2 - c^2 the square of what the three may have together
// With e_j proportional to element_size^1.6, duration^-2, softening^1 and the work to
// element_size^-2.7 duration softening^-0.5, the work is a product of powers x_j^-a_j,
//   a = 2.7 / 1.6, 1/2, 1/2
// and least, for a given sum of squares A, with
//   x_j^2 = A a_j / sum a                                                                   (1)
// x_j > e_j would be a parameter that costs less than before: it stays, and (1) goes on with what
// it leaves to the others.
#pragma once

#include "core/accuracy/cost_parameters.hpp"
#include "core/results/verification.hpp"
#include "core/verification/bands.hpp"

namespace plyform {

struct CorrectedCase {
  Case data;
  AskedAccuracy asked; ///< with the factors, all 1 if the accuracy is kept or nothing can be done
  bool changed() const {
    return asked.element_size * asked.softening < 1.0 || asked.duration > 1.0;
  }
};

/// What was asked for, whether it is kept, and if not the case with which it will be. Elements get
/// at most twice as small, strokes four times as slow, as the orders were measured no further; if A
/// is less than a quarter of (W/k)^2, by chance, it is a quarter. Fixed parameters and meshes from
/// files or with boundaries stay. data.accuracy.shear_error > 0.
CorrectedCase corrected_case(const Case& data, const Verification& verification,
                             const FixedParameters& fixed);

/// The verification of the run of a corrected case: the figures of `second`, with the errors of
/// the first scaled by the orders.
Verification after_correction(const Verification& first, const AskedAccuracy& asked,
                              const RunEnd& first_run, const RunEnd& second);

} // namespace plyform
