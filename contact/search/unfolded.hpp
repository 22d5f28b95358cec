// SPDX-License-Identifier: GPL-3.0-or-later
// Which parts of a sheet cannot touch the sheet itself, so that its self-contact need not be
// searched there: most of a ply, most of the time.
//
// Two patches (contact/search/sheet_edges.hpp) that are near each other in space cannot touch
// beyond their neighbourhood if they are neighbours in the undeformed sheet as well and their
// triangles' normals n lie in a cone about a common direction d,
//   n . d >= cos(60 degrees)                                                                 (C)
// since together they then are a graph over a plane, in which no distance shrinks to less than
// half: points more than two contact distances apart along the sheet stay apart. A fold has
// opposite normals, and its patches are near each other. Rims may slide over each other without a
// fold, at a slit or a hole; only in a sheet that is convex before forming can they not.
#pragma once

#include "contact/search/sheet_edges.hpp"

namespace plyform {

/// The undeformed sheet.
struct UndeformedSheet {
  std::span<const Vec3> x0; ///< mm
  std::span<const Triangle> triangles;
  bool convex = false; ///< flat, and no two points of its rim see each other outside of it
};

/// Whether a sheet is flat, in a plane of constant z, and as large as the convex hull of its nodes.
bool is_convex(std::span<const Vec3> x0, std::span<const Triangle> triangles);

/// Sets unfolded[n] to 1 for each node n that cannot touch the sheet itself before a node has moved
/// by half of `skin` (mm), to 0 for the others. x: mm, positions; distance: mm, contact distance.
void find_unfolded(const UndeformedSheet& sheet, const SheetEdges& edges, std::span<const Vec3> x,
                   double distance, double skin, std::vector<char>& unfolded);

} // namespace plyform
