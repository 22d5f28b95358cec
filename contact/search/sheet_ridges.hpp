// SPDX-License-Identifier: GPL-3.0-or-later
// Ridges: the edges at which a sheet is folded, and towards which side.
//
// Nodes and faces keep two sheets apart wherever the one or the other is flat. Where their distance
// is smallest between two edges instead, each sheet falls away from the other on both sides of its
// edge: both edges are ridges, each towards the other sheet. On a dome the edges of all plies are
// ridges towards the same side, and no two of them can meet; pairs of ridges that can are few.
//
//   f = sin(phi)   fold of an edge, phi: angle of its two faces; positive if the edge is a ridge
//                  towards the side of the normals, negative towards the other; beyond a right
//                  angle +-1
//   |f' - f| <= 2 (1/h_c + 1/h_d) D                                                          (G)
// after nodes have moved by at most D relative to each other. h: heights of its two triangles over
// the edge. With D summed up step by step no ridge grows unnoticed.
#pragma once

#include "contact/search/sheet_edges.hpp"

namespace plyform {

/// Sides of a sheet towards which an edge is a ridge, as bits.
enum RidgeSides : char { no_ridge = 0, ridge_up = 1, ridge_down = 2, ridge_both = 3 };

struct SheetRidges {
  /// RidgeSides of each edge; both of a free one.
  std::vector<char> sides;
  std::vector<float> room; ///< mm, per patch: the D of (G) before an edge may have to be found
};

/// The unit normal of an edge: the mean of those of its triangles. x: mm, positions of the nodes.
Vec3 edge_normal(const SheetEdges& edges, const SheetEdge& edge, std::span<const Vec3> x);

/// Finds all ridges anew: edges with a fold of more than a tenth of `limit`, and those round the
/// ends of a fold of more than a quarter of it, as a sheet that is drawn over a tool's edge is
/// folded at ever new edges. x: mm. limit: fold from which on an edge may touch another.
void find_ridges(const SheetEdges& edges, std::span<const Vec3> x, double limit,
                 SheetRidges& ridges);

/// Follows a step; to be called once a step. Returns false if an edge that is no ridge has been
/// folded beyond `limit`: then ridges have to be found. patch_motion: mm, as of patch_motions.
bool follow_ridges(const SheetEdges& edges, std::span<const Vec3> x,
                   std::span<const Box3> patch_motion, double limit, SheetRidges& ridges);

/// Whether two edges may be ridges towards each other: n are the normals of the edges.
bool may_face(char sides_a, const Vec3& n_a, char sides_b, const Vec3& n_b);

} // namespace plyform
