// SPDX-License-Identifier: GPL-3.0-or-later
// StrainGroups of core/ply/bending.hpp: which nodes stand for the shape at a node, and the
// constants A_a,i and B_ab,i that turn their places into first and second derivatives.
#pragma once

#include "core/ply/bending.hpp"

namespace plyform {

/// Fills the stencils of `b` (begin, node, b, a, fan) and b.area, b.in_plane by b.law. `warp`,
/// `weft` in rad. StrainGroups grow by further neighbours where those around the node do not fix a
/// quadratic.
void fit_stencils(Bending& b, std::span<const Vec2> x, const std::vector<Triangle>& triangles,
                  double warp, double weft);

} // namespace plyform
