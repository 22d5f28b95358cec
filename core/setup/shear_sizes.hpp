// SPDX-License-Identifier: GPL-3.0-or-later
// How large elements may be where shear bends sharply, from the last state of the scout.
//
//   g*    shear at nodes, recovered from triangles (nodal_means), and linear in between
//   grad g*, G   its gradient, constant in each triangle, and the same recovered at nodes
//   h     mm  side of a square of two such triangles
//   eta = h |G - grad g*|, root mean square in the triangle                               (1)
// which is the error estimate of Zienkiewicz and Zhu (Int. J. Num. Meth. Eng. 24 (1987) 337) for
// linear elements; it goes with h^2. For the least number of elements at a given root mean square
// over the area sizes are
//   h' = h (mu / eta)^(1/3),   sum A (eta (h'/h)^2)^2 = e^2 sum A                         (2)
// mu from e by bisection. What the estimate does not see is the error that a coarse fillet makes
// everywhere: that is what core/setup/chord_sizes.hpp is for.
#pragma once

#include "core/results/frame.hpp"
#include "core/setup/chord_sizes.hpp"

namespace plyform {

/// (1) of each triangle, degrees.
std::vector<double> shear_error_estimates(const PlyFrame& ply);

/// mm: the side of a square of two such triangles before forming, of one triangle of a ply.
double square_side(const PlyFrame& ply, std::size_t triangle);

/// Lowers `sizes` of all plies to (2) with e = `error`, degrees, over all of them. What is lower
/// already counts as it is. For the sake of shear no size gets below `finest` of the triangle's
/// own; nor, where the mesh is graded, below the smallest of all that are there already, which set
/// the step, or `finest` of the largest triangle. What is left with elements that small (at kinks,
/// which no mesh resolves) may be two thirds of e, and e grows with it beyond.
void lower_to_shear(const Frame& last, double error, double finest, std::vector<AskedSizes>& sizes);

} // namespace plyform
