// SPDX-License-Identifier: GPL-3.0-or-later
// Figures of a run with the bands that sibling runs gave them (core/verification/verify.hpp).
#pragma once

#include <string>
#include <vector>

namespace plyform {

struct VerifiedFigure {
  std::string name, unit; ///< "shear of ply1", deg
  double value = 0.0;
  /// The error is thought to be no larger, in 95 of 100 figures. Of shear: root mean square of the
  /// difference in shear angle over the ply.
  double band = 0.0;
  // What each cause adds to the error, before any factor of safety; `chance` of two equal runs
  double mesh = 0.0, inertia = 0.0, softening = 0.0, chance = 0.0;
};

struct Verification {
  std::vector<VerifiedFigure> figures; ///< empty: not verified
  double cost = 0.0;                   ///< time of the siblings over that of the run
  std::vector<std::string> left_out;   ///< causes without a sibling, and why, a sentence each
};

} // namespace plyform
