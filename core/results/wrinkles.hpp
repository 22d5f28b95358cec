// SPDX-License-Identifier: GPL-3.0-or-later
// Height and wavelength of the highest wrinkle that the mesh of a ply resolves.
//
//   h    mm  mean side of the ply's triangles
//   s    mm  half a wavelength, tried from 1.5 h to the larger of 4 h and 30 mm: shorter waves are
//            not resolved by the mesh, longer ones belong to the shape of the part
//   P_k      points k s (k = -2 .. 2) along a straight line of the undeformed ply, when formed, mm
//   n_k      unit normal of the formed ply there
//   D_k  mm  n_k . (P_k - (P_k-1 + P_k+1)/2), k = -1 0 1: height over the chord
//   H    mm  min(|D_0|, 2 |D_-1|, 2 |D_1|) if D_-1, D_1 have the sign opposite to D_0, else 0  (1)
// A wave of amplitude a and wavelength 2 s has D = +-2 a, so H = 2 a, its height from valley to
// crest. A single bump b/2 (1 + cos(pi x/s)) of height b has D_0 = b and D_+-1 = -b/2, so H = b.
// Along a line over a sphere, a fillet or a cone the curvature has one sign, and over an S-shape it
// changes once: H = 0.
//
// A tool with beads, or the edge of a hole seen along its tangent, has such waves itself. Therefore
// H is also computed from the signed distances to each tool that faces the ply within s of P_0 (its
// normal within 45 degrees of the ply's), and the smallest H counts: a ply that follows a tool has
// no wrinkle there. Nor has one that is still on its way: between tools that are not closed it
// bends over the crests of one into the valleys of another, less than they do. With
//   T_k  mm  height over the chord, as D_k, of the surface that the lines through P_k-1, P_k, P_k+1
//            along n_k meet, of a tool within 2 s of P_k that faces it; where a line meets nothing,
//            the tool falls away, and T_k is infinite
//   e    -   least over k of T_k/D_k, largest of all tools, from 0 to 1 (3)
// the share e of the wave is the tools' own, and H is (1 - e) of what it would be: a wave is none
// only if tools have all three of its bends. A bend counts as theirs, too, where a ply is pressed,
// nothing holds it up (core/run/bridging.hpp), and it bulges to where it is pressed: over a hollow,
// where tension bears the load; a wrinkle's crest bulges against it. Lines run along warp, across
// it and at 45 degrees, through all points of a grid of h/2; a wave at another angle appears at
// most 8 % longer, with the same height.
//
// Points are taken on the smooth surface approximated by the facets, or each fillet would show
// waves of their sag h^2/(8 r): half-way between the facet and the mean, weighted by w_i of the
// corners, of its projections on the tangent planes at the corners (Boubekeur and Alexa 2008 with
// alpha = 1/2),
//   x = (p + q)/2,  p = sum w_i x_i,  q = sum w_i (p - n_i n_i.(p - x_i)) (2)
// which is exact on arcs that are long compared with h. On shorter arcs waves of less than the sag
// remain: 0.2 mm of 0.6 mm with h = 6.8 mm on a fillet of 10 mm.
#pragma once

#include "base/geometry.hpp"
#include "core/model/ply_frame.hpp"

#include <vector>

namespace plyform {

struct ToolBody;

struct Wrinkle {
  double height = 0.0;     ///< mm, from valley to crest; 0: none
  double wavelength = 0.0; ///< mm, in the undeformed ply, 2 s
  Vec3 at = Vec3::Zero();  ///< mm, its crest or valley, in the formed ply
};

/// Waves lower than this (mm) are 0 in a field of heights: they are of the mesh, on fillets.
constexpr double least_wrinkle = 0.3;

struct Wrinkles {
  Wrinkle highest;
  /// n, mm: of each node the largest H whose crest or valley is in a triangle at it.
  std::vector<double> at_nodes;
};

/// H all over a ply. tools: those whose shape (1) compares with; not owned.
/// from: mm, lower ones are not looked for; `highest` is this, at no place, where none is higher.
Wrinkles wrinkles_of(const PlyFrame& ply, const std::vector<const ToolBody*>& tools,
                     double from = 0.0);

} // namespace plyform
