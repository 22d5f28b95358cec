// SPDX-License-Identifier: GPL-3.0-or-later
// Law of shear from specimens cut both ways, or frames turned both ways.
//
// Positive curves are of specimens in which the angle from the first family to the second closes
// (core/model/shear_law.hpp), negative ones of those in which it opens. Each side has a law by
// identify_shear. Where they differ beyond scatter the fabric has a law of both signs, else one law
// of all curves.
#pragma once

#include "core/identify/fit_shear.hpp"
#include "core/identify/group_difference.hpp"

namespace plyform {

struct SignsFit {
  ShearFit positive, negative;  ///< each by its own angles above 0
  std::optional<ShearFit> both; ///< of all curves, if the sides do not differ
  LawDifference difference;     ///< torque of negative angles over that of positive ones
  ShearLaw law;                 ///< of both signs; odd if they do not differ
};

/// Law from both groups of curves. Loads that the fabric's stitches add by their own laws are taken
/// off first. Errors as of identify_shear, and if the ranges of both sides do not overlap.
std::optional<SignsFit> identify_signs(const std::vector<Curve>& positive,
                                       const std::vector<Curve>& negative, const ShearTest& test,
                                       const Fabric& fabric, const FitOptions& options,
                                       Diagnostics& diagnostics);

/// A law whose sides are two odd ones, each good up to an angle (rad): two polynomials, or a table
/// of both signs with the rows of tables, as many of a polynomial as follow it to 0.1 %, and rows
/// between these until the torque of each side is within `kept_within` of its own law from
/// `kept_from` on, at most twenty of each side.
inline constexpr double kept_from = 0.25 * degree, kept_within = 0.01;
ShearLaw law_of_both_signs(const ShearLaw& positive, double positive_to, const ShearLaw& negative,
                           double negative_to);

/// The curves without what stitches (indices) add to their loads, at their extensions with given
/// corrections. negative: of specimens the other way round.
std::vector<Curve> without_stitches(std::vector<Curve> curves, const ShearTest& test,
                                    const Fabric& fabric, const std::vector<std::size_t>& stitches,
                                    bool negative, const FitOptions& options);

} // namespace plyform
