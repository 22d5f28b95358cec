// SPDX-License-Identifier: GPL-3.0-or-later
// The highest wrinkle that the mesh of a ply shows.
//
//   h    mm  mean side of the ply's triangles
//   s    mm  half a wavelength, tried from 1.5 h to the larger of 4 h and 30 mm: shorter waves are
//            not carried by the mesh, longer ones are the shape that tools give
//   P_k      places k s along a straight line of the unformed ply (k = -2 .. 2), on the formed one
//   n_k      unit normal of the formed ply there
//   D_k  mm  n_k . (P_k - (P_k-1 + P_k+1)/2), k = -1 0 1: height over the chord
//   H    mm  min(|D_0|, 2 |D_-1|, 2 |D_1|) if D_-1 and D_1 have the sign that D_0 has not, else 0
//   (1)
// A wave of amplitude a and wavelength 2 s has D = +-2 a, so H = 2 a, its height from valley to
// crest. A lone bump b/2 (1 + cos(pi x/s)) of height b has D_0 = b and D_+-1 = -b/2, so H = b. A
// ball, a fillet or a cone bends to one side along a line, and an S to one and then the other: H =
// 0.
//
// A tool with beads, or the rim of a hole seen along its tangent, has such waves of its own. So H
// is also taken of the signed distance from each tool that faces the ply within s of P_0 (its
// normal within 45 degrees of the ply's), with D of the distances, and the least H counts: a ply
// that follows a tool has no wrinkle there. Lines run along warp, across it and at 45 degrees,
// through all places of a grid of h/2; a wave at another angle seems 8 % longer at most, and as
// high.
//
// Places are taken on the smooth surface behind the facets, or each fillet would ripple by their
// sag h^2/(8 r): half-way between the facet and the mean, by the shares w_i of the corners, of
// its projections on the tangent planes at the corners (Boubekeur and Alexa 2008 with alpha = 1/2),
//   x = (p + q)/2,  p = sum w_i x_i,  q = sum w_i (p - n_i n_i.(p - x_i)) (2)
// which is right on arcs that are long against h. Where an arc is not, ripples of less than the sag
// are left: 0.2 mm of 0.6 mm with h = 6.8 mm on a fillet of 10 mm.
#pragma once

#include "contact/geometry.hpp"
#include "core/results/ply_frame.hpp"

#include <vector>

namespace plyform {

struct ToolBody;

struct Wrinkle {
  double height = 0.0;     ///< mm, from valley to crest; 0: none
  double wavelength = 0.0; ///< mm, in the unformed ply, 2 s
  Vec3 at = Vec3::Zero();  ///< mm, its crest or valley, in the formed ply
};

/// The largest H of a ply.
Wrinkle highest_wrinkle(const PlyFrame& ply, const std::vector<const ToolBody*>& tools);

} // namespace plyform
