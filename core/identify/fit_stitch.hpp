// SPDX-License-Identifier: GPL-3.0-or-later
// The law of a stitch from what it adds to shear of one sign.
//
// Specimens cut, or frames turned, both ways: one way shear draws the stitch, the other it goes
// slack (stitch_load.hpp). The law of shear is that of the slack side; what the other side bears
// beyond it is linear in the stitch's force F over its elongation e:
//
//   a line         F = k (e - e_0), 0 below e_0; e_0 above 0 is slack, below it pre-tension k |e_0|
//   a table        F(0) = 0 and rising, or a pre-tension, of eight pieces, where no line fits
//   a break        F = 0 beyond e_b, gone for good, where that explains the rows better than chance
//                  does once in a thousand curves
//
// e_0 and e_b are scanned, the rest is linear least squares with the weights of the whole load.
// With pre-tension the slack side has the stitch's pull as well, against the load: it is put back
// by the law found, until both agree; it starts from the stitch of the fabric.
//
// Limits: jackknife, over specimens where both sides have two or more, else over eight blocks of
// neighbouring rows of each side (which hold noise alone). They hold what is unsure in the law of
// shear that is taken off.
#pragma once

#include "core/identify/fit_shear.hpp"

#include <optional>
#include <string>

namespace plyform {

struct StitchFit {
  ShearFit slack; ///< the law of shear
  bool drawn_by_positive = true;
  StitchLaw law;
  bool line = true;
  double stiffness_limits = 0.0;             ///< of a line, N
  double taut_limits = 0.0;                  ///< of its taut_at
  double force_limits = 0.0;                 ///< of the force at the last elongation, over it
  bool limits_between = false;               ///< from the spread of specimens; else of the rows
  bool breaks = false;                       ///< law.breaking_force is found
  double breaks_from = 0.0, breaks_to = 0.0; ///< elongations between which it breaks
  double strain_to = 0.0;                    ///< last elongation at which it is known to pull
  FitQuality quality;                        ///< of the whole load on the side that draws it
  std::vector<double> extension, angle, measured, fitted; ///< rows of that side
  std::vector<std::size_t> specimen;
};

struct SignedCurves {
  std::vector<Curve> positive, negative;
};

/// The stitch `own` of a fabric (indices: the legs of a zigzag have one law) and the law of its
/// crossing. Loads of
/// other stitches are taken off by their own laws. Reports an error and returns nothing where
/// identify_shear does on the slack side, if shear does not draw the stitch, draws its legs by both
/// signs, or if the sides do not differ beyond their scatter.
std::optional<StitchFit> identify_stitch(const SignedCurves& curves,
                                         const std::vector<std::size_t>& own, const ShearTest& test,
                                         const Fabric& fabric, const FitOptions& options,
                                         Diagnostics& diagnostics);

} // namespace plyform
