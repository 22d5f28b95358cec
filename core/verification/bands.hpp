// SPDX-License-Identifier: GPL-3.0-or-later
// Error bands of the figures of a run, from its siblings, in the manner of grid-convergence
// practice (Richardson extrapolation with known orders; ASME V&V 20-2009, section 2).
//
//   b, q   factors of element size and speed between siblings;  d  difference of two runs
//   mesh       d / (b^p - 1), p = 1.6
//   inertia    d / (q^2 - 1) for shear and lengths; of forces, with g the least share of one that
//              is left at q times the speed, among all that count,
//              d (g^(-1 / (q^3 - 1)) - 1) / (1 - g), at most d / (q - 1)                    (1)
//   softening  d: proportional, twice the softening; d / (1 - 1/2) of half of it, without chance
//   chance     d, the largest of all twins
// with d / (q - 1) where either of the two flies (core/run/ply_motion.hpp) or speed has made a
// force half as large again: such errors follow no power of the speed. (1): a tool cannot lose more
// than its force, so what is left falls as exp(-c v^3), and F (g^(-1 / (q^3 - 1)) - 1) is what the
// slower run has lost of F. Of small ones it is Richardson's d / (q^3 - 1); where nothing is left
// it is unknown and taken for d / (q - 1). b < 1, of a finer mesh: d / (1 - b^p), if both err
// alike; fields of shear do so in part, and take the geometric mean of that and of d / sqrt(1 +
// b^2p), if the errors are independent (two stacks differed by as much at a factor of 1.3 as at 2).
// Where the mesh does not resolve what bends the plies (resolves_all of no_band.hpp), and where
// pressures or closed moulds press them all over, errors fall no faster than with h: p = 1, and
// fields err alike.
// A part without a sibling is not measured, and a figure without all parts has no band; of shear
// what is predicted for mesh and softening may stand in, and the verification says so.
//   of shear and lengths  e = sqrt(mesh^2 + inertia^2 + softening^2 + chance^2)
//   of a force            e = max(that, |mesh + inertia + softening|), which have signs
//   band = max(k e, c), k = 1.65, c = 2 chance, of forces at least 3 times the jitter
// Orders of inertia: of strokes from 0.1 to 0.01 s (four small hemispheres of one ply and two)
// errors of shear go with the speed to the 1.1 to 3.2, 2.2 in the median, until they are as large
// as 2 degrees; those of the punch's force to the 1.8 to 3.7, 2.9 in the median, until it is lost.
// k: grid-convergence practice takes 1.25 with an order observed on three meshes, 3 with one
// assumed on two; here it is one of many scenes (docs/users/accuracy.md). A single length may agree
// by accident on two meshes: it takes the mean square over its kind (the draw-ins of all plies). So
// may a single force: at the end the forces of all tools are in balance, what one carries is what
// the others do, and each part of its error is the root mean square of both. So is their sum: each
// estimate adds up its own parts, as signs of one say nothing of the other. Not that of a tool
// pushed by a force, which it keeps, nor where boundaries carry, too. Jitter: what the solver does
// to a force: the most that a tool pushed by a force has on its face beyond it, and what the tool
// lacks of the balance of all.
//
// No band have, whatever siblings agree on, the figures of core/verification/no_band.hpp, nor one
// whose band would be wider than the figure: it would say nothing. Those that are given or held
// count in no mean, and the force left by speed is looked for among the others, of which a tool
// that stays carries what the pushed ones are given, too.
#pragma once

#include "core/accuracy/error_model.hpp"
#include "core/accuracy/error_numbers.hpp"
#include "core/results/frame.hpp"
#include "core/results/summary.hpp"
#include "core/verification/no_band.hpp"
#include "core/verification/siblings.hpp"

#include <map>

namespace plyform {

// Errors go with these powers of speed and softening, and with order_of_mesh of element size.
constexpr double order_of_inertia = 2.0, order_of_inertia_of_forces = 3.0;
constexpr double order_outside_premise = 1.0;
constexpr double order_of_softening = 1.0;
constexpr double safety = 1.65, safety_of_chance = 2.0, safety_of_jitter = 3.0;

/// What a run or a sibling ended with.
struct RunEnd {
  Frame last;
  std::vector<PlyReport> plies;
  double jitter_N = 0.0; ///< as above
  /// N, the force of each tool by the balance of all, its own if it is pushed; empty if boundaries
  /// carry as well.
  std::vector<double> balance_N = {};
  bool flies = false;                        ///< a ply, at the end
  std::vector<KnownForce> known_forces = {}; ///< as in Summary
  NoBand no_band = {};                       ///< of no tool and ply: not known
  std::vector<Motion> motions = {};          ///< of the tools; empty: not known
};

using Ends = std::map<Cause, RunEnd>;

/// RunEnd::balance_N of a run of `data` that ended like this.
std::vector<double> forces_by_balance(const Case& data, const Frame& last);

/// Of the pushed tools of a run of `data`, the largest.
double force_jitter(const Case& data, const Frame& last);

/// The figures of a run; of one that flies only shear has a band: shear, draw-in and largest
/// compression of each ply, force of each tool. siblings: those that ended, by their cause;
/// predicted: of the run, NaN where the rule does not hold.
std::vector<VerifiedFigure> verified_figures(const RunEnd& run, const Ends& siblings,
                                             const Siblings& made, const PredictedError& predicted);

/// The shear of all plies together, as a figure; likewise.
VerifiedFigure verified_shear(const RunEnd& run, const Ends& siblings, const Siblings& made,
                              const PredictedError& predicted);

/// What the parts make of a band, however wide; nothing if any is missing.
ErrorPart width_of_band(const VerifiedFigure& figure);

/// Sets that band, or why there is none: it would be wider than the figure.
void set_band(VerifiedFigure& figure);

} // namespace plyform
