// SPDX-License-Identifier: GPL-3.0-or-later
// Newest-vertex bisection of triangle meshes (Mitchell, 1988; Baensch, 1991): each triangle has one
// side at whose middle it is cut, of its halves the side opposite to the new node. Triangles made
// from one are of four shapes at most, however often they are cut.
#pragma once

#include "core/mesh/mesh_blank.hpp"

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace plyform {

/// Node numbers of a side, the lower one first.
using SideNodes = std::pair<std::int32_t, std::int32_t>;

inline SideNodes side_of(const Triangle& t, std::size_t k) {
  return std::minmax(t[k], t[(k + 1) % 3]);
}

/// A mesh on the way: side k of a triangle runs from its node k to the next.
struct Bisection {
  BlankMesh mesh;
  std::vector<std::uint8_t> cut_side;   ///< per triangle, 0 to 2: where it is cut next
  std::vector<std::uint8_t> generation; ///< per triangle: how often it has been cut
  std::map<SideNodes, Vec2> arc_centre; ///< mm, of sides that stand for a piece of an arc
};

/// Each triangle is cut first at its longest side; of sides that are equal up to rounding at the
/// one with the lower node numbers, so that both triangles beside it agree.
Bisection start_bisection(BlankMesh mesh);

/// Cuts the triangles that are marked (one mark each, not 0), and what else has to be cut so that
/// no node lies within a side of another triangle. Nodes keep their numbers, new ones follow;
/// triangles that are not cut stay as they are, halves take the place of the whole. New nodes on
/// sides with an arc lie on it. Returns for each triangle whether it is a new one.
std::vector<char> bisect(Bisection& b, const std::vector<char>& marked);

} // namespace plyform
