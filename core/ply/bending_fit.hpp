// SPDX-License-Identifier: GPL-3.0-or-later
// Stencils of core/ply/bending.hpp: the nodes from whose positions the shape at a node is found,
// and the constants A_a,i and B_ab,i of its first and second derivatives.
#pragma once

#include "core/ply/bending.hpp"

namespace plyform {

/// Fills the stencils of `b` (begin, node, b, a, fan), b.area and, by b.law, b.in_plane. x:
/// undeformed positions, mm; axis1, axis2: material axes, rad from x; planes: of symmetry. A
/// stencil holds the nodes of the triangles around its node and, where cells are not of
/// parallelograms, those next to them.
void fit_stencils(Bending& b, std::span<const Vec2> x, const std::vector<Triangle>& triangles,
                  double axis1, double axis2, const std::vector<SymmetryPlane>& planes);

} // namespace plyform
