// SPDX-License-Identifier: GPL-3.0-or-later
// How much a sheet is bent from each triangle to those around it: what tells a contact that the
// face which it remembers is still the closest.
//
//   phi  rad  largest angle between a face's normal and those of the faces that share a node
// A point at distance d over the inside of a face is closer to that face than to one turned by phi
// against it if its foot is further than d tan(phi/2) from the edge that they share. `margin` is
// added to phi for what the sheet turns until the next renewal, and a fifth to the tangent for
// faces that share just a node.
#pragma once

#include "contact/geometry.hpp"

#include <span>
#include <vector>

namespace plyform {

constexpr double fold_margin = 0.2; ///< rad

/// At least 1.2 tan((phi + margin) / 2) of each triangle, infinite where phi + margin is more than
/// 0.8; phi is taken for up to twice as large as it is. x: mm.
void fold_bounds(std::span<const Vec3> x, std::span<const Triangle> triangles,
                 std::vector<double>& fold_bound);

} // namespace plyform
