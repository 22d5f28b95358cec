// SPDX-License-Identifier: GPL-3.0-or-later
// Error bands of the figures of a run, from its siblings, in the manner of grid-convergence
// practice (Richardson extrapolation with known orders; ASME V&V 20-2009, section 2).
//
//   b, q   factors of element size and speed between siblings;  d  difference of two runs
//   mesh       one ply:  d / (b^p - 1), p = 1.6. In a stack the errors of two meshes are nearly
//              independent, as it depends on the mesh which places slide: d / sqrt(1 + b^2p). Of
//              meshes of 4.8, 6.8 and 9.5 mm of hemisphere_five_ply the differences of shear are
//              1.30, 2.26 and (4.8, 9.5) 2.05 degrees: less than their sum, as independent errors
//              of 0.6, 1.15 and 1.95 have it.
//   inertia    d / (q^2 - 1): the kinetic energy
//   softening  d: proportional, twice the softening
//   chance     d
//   band = max(c, k sqrt(mesh^2 + inertia^2 + softening^2 + chance^2))
// k = 1.25 for shear, which is a mean over the ply, 2 for single figures; c = 2 chance. A single
// figure may agree by accident on two meshes: it takes the mean square over its kind (the draw-ins
// of all plies).
#pragma once

#include "core/results/frame.hpp"
#include "core/results/summary.hpp"
#include "core/verification/siblings.hpp"

#include <map>

namespace plyform {

/// What a run or a sibling ended with.
struct RunEnd {
  Frame last;
  std::vector<PlyReport> plies;
};

/// The figures of a run: shear, draw-in and largest compression of each ply, force of each tool.
/// siblings: those that ended, by their cause; a cause without one adds nothing, mesh what was
/// predicted for the shear.
std::vector<VerifiedFigure> verified_figures(const RunEnd& run,
                                             const std::map<Cause, RunEnd>& siblings,
                                             const Siblings& made, double predicted_mesh_deg);

} // namespace plyform
