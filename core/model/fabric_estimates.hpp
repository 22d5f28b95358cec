// SPDX-License-Identifier: GPL-3.0-or-later
// Estimates of compression and bending stiffness for fabrics whose file has no measured values.
//
//   C    N      compression stiffness of a yarn: 1 % of its largest stiffness in tension. Fabric
//               laws of shell codes have 0.1 to 1 %; ten times less or more moves the shear angle
//               of five plies by 1.6 to 3.3 degrees rms
//   B    N mm   bending stiffness along a family, B = w c^3 (Peirce 1930; ASTM D1388 measures c)
//   w    N/mm^2 weight per area;  c  mm  bending length: 70, glass weaves of 300 to 900 g/m^2 have
//               50 to 90. In a fabric that is no weave, w is twice the weight of the family's own
//               yarns, which a weave has that is as heavy along its weft: bundles bend by their own
//               fibres, wherever the others lie. A family's weight is its share of d C, as fibres
//               of one kind have it
//   D    N mm   bending stiffness of the sheet across yarns in one direction, w c^3 with a bending
//               length of 20 mm, as limp cloth has, whose fibres do not run through either
//   D_g  N mm   bending stiffness of a family in the plane, D_g = (n_c Cs'(0) + G) l^2
//   n_c  1/mm^2 unit cells per area;  Cs'(0)  N mm/rad  their stiffness in shear; for a law with
//               Cs'(0) = 0 its secant at half a radian
//   G    N/mm   stiffness in shear of the sheet's law beside the yarns
//   l    mm     width of the transition zones in a bias-extension test, one to three cells of the
//               weave: 2.5. A cell is two yarns wide, 2 / density, geometric mean of warp and weft;
//               without a crossing of all families
//
// Stacks need them: friction between plies compresses yarns along their length, and yarns that
// carry tension only would then shorten by half without resistance. A single ply does not need them
// and keeps the values of its file. None depends on the element size.
#pragma once

#include "core/model/case.hpp"

#include <string>
#include <vector>

namespace plyform {

/// C of a yarn with this law of tension, N.
double usual_compression(const TensionLaw& law);

/// D_t, N mm, of a fabric whose file has no twist stiffness: of one family, or two, the root of the
/// product of the bending stiffnesses along both axes at small curvature, half of Huber's estimate
/// for plates (docs/theory/bending.md). 0 of three and more: they resist twist by bending.
double usual_twist(const Fabric& fabric);

/// B, N mm, of a family of the fabric.
double usual_bending(const Fabric& fabric, const YarnFamily& family);

/// D, N mm, across yarns in one direction.
double usual_bending_across(const Fabric& fabric);

/// l, mm, by the first crossing; without one by all families.
double usual_zone_width(const Fabric& fabric);

/// n_c Cs'(0) + G, N/mm per rad of shear, of all crossings and the sheet; for a law with Cs'(0) = 0
/// n_c times its secant at half a radian.
double shear_rigidity(const Fabric& fabric);

/// D_g, N mm; 0 for a fabric without shear stiffness.
double usual_in_plane_bending(const Fabric& fabric);

/// Estimates the ValueSource::missing properties of the yarns of a case's plies, and marks
/// them ValueSource::estimated. Of plies that others may press (core/model/reach_ahead.hpp): C, and
/// B and D_g of yarns that bear compression, and D across those in one direction. Of a ply that
/// lies alone: C of yarns whose file has a bending stiffness or buckling force, as both need it; if
/// plies in a stack are of its fabric too, it gets a copy of its own. A family with a given
/// compression of 0 is not changed: it carries tension only.
void estimate_missing(Case& data);

/// What was estimated and why, for the user: one line per fabric with an estimate.
std::vector<std::string> describe_estimates(const Case& data);

/// The effective softening of fabrics whose compression stiffness limits solver.fibre_softening,
/// for the user: one line per such fabric.
std::vector<std::string> describe_softening(const Case& data);

/// The lines of describe_estimates and describe_softening.
std::vector<std::string> assumptions(const Case& data);

} // namespace plyform
