// SPDX-License-Identifier: GPL-3.0-or-later
// Bound on the fold angle of a sheet around each face. With it a contact point proves, without a
// search, that the face on which it last found its closest point still holds the closest point.
//
//   phi  rad  largest angle between a face's normal and those of the faces that share a node
// A point at distance d over the interior of a face is closer to that face than to one folded
// against it by phi if its foot is further than d tan(phi/2) from the edge that they share.
// fold_margin is added to phi for the rotation of the faces until the bounds are computed again,
// and a fifth to the tangent for faces that share only a node.
#pragma once

#include "base/geometry.hpp"

#include <span>
#include <vector>

namespace plyform {

constexpr double fold_margin = 0.2; ///< rad

/// fold_bound[i] (dimensionless, resized to triangles.size()): an upper bound of
/// 1.2 tan((phi + fold_margin) / 2) of triangle i; infinite where the estimate of phi + fold_margin
/// exceeds 0.8 rad. The estimate of phi is an upper bound of up to twice phi. x: positions of the
/// nodes, mm. Degenerate triangles give infinite bounds; nothing is thrown.
void fold_bounds(std::span<const Vec3> x, std::span<const Triangle> triangles,
                 std::vector<double>& fold_bound);

} // namespace plyform
