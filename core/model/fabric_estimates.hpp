// SPDX-License-Identifier: GPL-3.0-or-later
// What a fabric that was not tested is taken to answer to compression and bending of its yarns.
//
//   C    N      compression stiffness of a yarn: 1 % of its largest stiffness in tension. Fabric
//               laws of shell codes have 0.1 to 1 %; ten times less or more moves the shear angle
//               of five plies by 1.6 to 3.3 degrees rms
//   B    N mm   bending stiffness along a family, B = w c^3 (Peirce 1930; ASTM D1388 measures c)
//   w    N/mm^2 weight per area;  c  mm  bending length: 70, glass weaves of 300 to 900 g/m^2 have
//               50 to 90
//   D_g  N mm   bending stiffness of a family in the plane, D_g = n_c Cs'(0) l^2
//   n_c  1/mm^2 unit cells per area;  Cs'(0)  N mm/rad  their stiffness in shear; of a law that
//               starts with none, its secant at half a radian
//   l    mm     width of the transition zones in a bias-extension test, one to three cells of the
//               weave: 2.5. A cell is two yarns wide, 2 / density, the geometric mean of both ways
//
// A stack needs them: plies press each other's yarns along their length by friction, and yarns that
// carry tension only then shorten by half without a trace. One ply does not, and stays as its file
// has it. None follows the elements.
#pragma once

#include "core/model/case.hpp"

#include <string>
#include <vector>

namespace plyform {

/// C of a yarn with this law of tension, N.
double usual_compression(const TensionLaw& law);

/// D_t, N mm, of a fabric whose file says nothing of twist: the root of the product of both bending
/// stiffnesses at small curvature, half of Huber's estimate for plates (docs/theory/bending.md).
double usual_twist(const BendingLaw& law);

/// B, N mm.
double usual_bending(const Fabric& fabric);

/// l, mm.
double usual_zone_width(const Fabric& fabric);

/// n_c Cs'(0), N/mm per rad of shear; of a law that starts with no stiffness n_c times its secant
/// at half a radian.
double shear_rigidity(const Fabric& fabric);

/// D_g, N mm; 0 for a fabric without shear stiffness.
double usual_in_plane_bending(const Fabric& fabric);

/// Gives the woven fabrics of a case's plies what is ValueSource::missing, and marks it estimated.
/// With two plies or more: C, and B and D_g of yarns that bear compression. With one ply: C of
/// yarns whose bending or buckling the file has, since both need it. A given compression of 0 thus
/// keeps a family as it is: it carries tension only.
void estimate_missing(Case& data);

/// What was estimated and why, a line a fabric for people; none where nothing was.
std::vector<std::string> describe_estimates(const Case& data);

/// How far solver.fibre_softening acts on fabrics whose compression limits it, a line a fabric for
/// people; none where it acts in full.
std::vector<std::string> describe_softening(const Case& data);

/// Both.
std::vector<std::string> assumptions(const Case& data);

} // namespace plyform
