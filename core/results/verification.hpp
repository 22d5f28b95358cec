// SPDX-License-Identifier: GPL-3.0-or-later
// Figures of a run with the bands that sibling runs gave them (core/verification/verify.hpp).
#pragma once

#include "base/geometry.hpp"

#include <optional>
#include <string>
#include <vector>

namespace plyform {

/// A part of an error, or nothing: it was not measured, which is not the same as 0.
using ErrorPart = std::optional<double>;

/// What causes add to a force, above 0: it is too large, N.
struct SignedErrors {
  double mesh = 0.0, inertia = 0.0, softening = 0.0;
  double sum() const { return mesh + inertia + softening; }
};

struct VerifiedFigure {
  std::string name, unit; ///< "shear of ply1", deg
  double value = 0.0;
  /// A force has errors with signs, above 0: it is too large; of others they are magnitudes.
  bool force = false;
  /// The error is thought to be no larger, in 95 of 100 figures. Of shear: root mean square of the
  /// difference in shear angle over the ply. Nothing if any part was not measured, or as below.
  ErrorPart band = std::nullopt;
  std::string no_band = {}; ///< a clause: why it has none though its parts may be measured
  // What each cause adds to the error, before any factor of safety; `chance` of two equal runs
  ErrorPart mesh = std::nullopt, inertia = std::nullopt, softening = std::nullopt,
            chance = std::nullopt;
  /// Of a force that was estimated in several ways, of which the parts above are the mean squares:
  /// signs mean something within one estimate only.
  std::vector<SignedErrors> estimates = {};
  double jitter = 0.0; ///< N, of a force: core/verification/bands.hpp
};

/// The causes whose part was not measured, by their names in files.
inline std::vector<std::string> unmeasured(const VerifiedFigure& figure) {
  std::vector<std::string> names;
  if (!figure.mesh) names.emplace_back("mesh");
  if (!figure.inertia) names.emplace_back("inertia");
  if (!figure.softening) names.emplace_back("softening");
  if (!figure.chance) names.emplace_back("chance");
  return names;
}

/// Where two runs that differ by nothing to speak of first go different ways.
struct Parting {
  std::string ply;
  double time_s = 0.0, stroke_mm = 0.0;
  Vec3 at_mm = Vec3::Zero(); ///< of the node that is furthest apart then, formed
  double apart_mm = 0.0;     ///< then
  double shear_deg = 0.0;    ///< rms difference in shear of that ply at the end
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

/// The whole of a scene of which a part was modelled, run once from off its symmetry.
struct WholeRun {
  double moved_mm = 0.0;  ///< of its first moving tool, off the symmetry
  double shear_deg = 0.0; ///< rms difference of its shear angles to those shown
  /// mm, of the ply whose wrinkles are higher than those shown by most
  std::string ply;
  double wrinkle_mm = 0.0, shown_wrinkle_mm = 0.0;
  bool breaks = false; ///< whether waves break the symmetry
};

struct Verification {
  std::vector<VerifiedFigure> figures; ///< empty: not verified
  VerifiedFigure shear;                ///< of all plies together
  std::optional<AskedAccuracy> asked;  ///< if the case asks for an accuracy
  double cost = 0.0;                   ///< time of the siblings over that of the run
  double work = 0.0;                   ///< the same by triangles times steps, whatever else runs
  std::vector<std::string> left_out;   ///< causes without a sibling, and why, a sentence each
  std::optional<WholeRun> whole;       ///< of a part
  std::vector<Parting> partings;       ///< where chance is more than all else in a band
};

} // namespace plyform
