// SPDX-License-Identifier: GPL-3.0-or-later
// The flat, unformed ply: outline and triangle mesh, in its own plane.
#pragma once

#include "core/model/blank_spec.hpp"

#include <vector>

namespace plyform {

/// Nodes (mm) and anticlockwise triangles; every node belongs to a triangle.
struct BlankMesh {
  std::vector<Vec2> x;
  std::vector<Triangle> triangles;
};

/// Meshes a blank; the same bits every time. `warp` and `weft` are the fibre directions (rad from
/// x), used by MeshKind::fibres only. Rectangles (and parallelograms) whose sides run along the
/// cells give exact structured grids: round(side/element_size) cells a side, at least one, nodes
/// row by row, then the middles of crossed cells. Other outlines are cut: the cells wholly inside,
/// on a lattice through the middle of the bounding box, stay as they are and a band of triangles
/// joins them to the outline, which keeps every corner and is divided at about element_size between
/// them. Angles in the band and in free meshes are 20 degrees at least, except where the outline's
/// own corners are sharper. A file's nodes are joined where equal, its triangles turned
/// anticlockwise.
/// Throws std::runtime_error (what is wrong, what to do): outline not simple or not closed
/// properly, hole outside or touching, element larger than the blank or far too small, fibre
/// directions less than 25 degrees apart, file unreadable, empty, not flat, not of triangles, not
/// manifold or not in one piece.
BlankMesh mesh_blank(const BlankSpec& spec, double warp, double weft);

/// Whether the outline takes elements of this size: false where mesh_blank would throw for it.
bool takes_elements(const BlankSpec& spec);

} // namespace plyform
