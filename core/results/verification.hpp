// SPDX-License-Identifier: GPL-3.0-or-later
// Figures of a run with the bands that sibling runs gave them (core/verification/verify.hpp).
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace plyform {

struct VerifiedFigure {
  std::string name, unit; ///< "shear of ply1", deg
  double value = 0.0;
  /// A force has errors with signs, above 0: it is too large; of others they are magnitudes.
  bool force = false;
  /// The error is thought to be no larger, in 95 of 100 figures. Of shear: root mean square of the
  /// difference in shear angle over the ply.
  double band = 0.0;
  // What each cause adds to the error, before any factor of safety; `chance` of two equal runs
  double mesh = 0.0, inertia = 0.0, softening = 0.0, chance = 0.0;
  double jitter = 0.0; ///< N, of a force: core/verification/bands.hpp
};

/// Whether shear angles are as near as the case asked for, and what was done if they are not.
struct AskedAccuracy {
  double wanted_deg = 0.0;   ///< accuracy.shear_deg
  double measured_deg = 0.0; ///< band of the shear of all plies, of the run as first made
  bool corrected = false;    ///< the results are of a second run, with the factors below
  /// Of the cost parameters of the second run over those of the first; all 1: none can help.
  double element_size = 1.0, duration = 1.0, softening = 1.0;
  double expected_deg = 0.0; ///< the band with these factors
  double moved_deg = 0.0;    ///< rms difference in shear of the second run to the first
  std::string first_run;     ///< folder of the first run, if corrected
  std::string why_not;       ///< missed, and not corrected: a sentence
  bool kept() const { return measured_deg <= wanted_deg; } // false for NaN
};

struct Verification {
  std::vector<VerifiedFigure> figures; ///< empty: not verified
  VerifiedFigure shear;                ///< of all plies together
  std::optional<AskedAccuracy> asked;  ///< if the case asks for an accuracy
  double cost = 0.0;                   ///< time of the siblings over that of the run
  std::vector<std::string> left_out;   ///< causes without a sibling, and why, a sentence each
};

} // namespace plyform
