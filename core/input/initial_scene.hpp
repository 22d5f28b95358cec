// SPDX-License-Identifier: GPL-3.0-or-later
// Flat plies and tools before anything moves, and simple questions about where they stand.
#pragma once

#include "core/mesh/mesh_blank.hpp"
#include "core/model/case.hpp"

#include <functional>
#include <utility>
#include <vector>

namespace plyform {

/// A ply as it lies before forming: all nodes at height z.
struct FlatPly {
  BlankMesh mesh;
  std::vector<std::pair<Vec2, Vec2>> border; ///< edges with one triangle
  Eigen::AlignedBox2d bounds;
  double z, half; ///< mm, mid-surface and half the thickness
};

FlatPly make_flat_ply(BlankMesh mesh, double z, double thickness);

/// Whether a point of the plane lies in the ply's mesh (even number of border edges to its right:
/// outside).
bool covers(const FlatPly& ply, const Vec2& p);

/// Signed distance (mm) of p (space) to the tool moved by `shift`; `hint` as for signed_distance.
double tool_distance(const Tool& tool, const Vec3& shift, const Vec3& p, int& hint);

/// The tool's surface in space as triangles small enough to show its form: between 1/300 and 1/60
/// of its diagonal, in between `size` (mm). Planes reach `extent` mm from the tool's origin.
TriMesh tool_surface(const Tool& tool, double size, double extent);

/// Calls `visit` with points of the surface whose height is from `low` to `high`: corners, middles
/// of triangles, and the ends and middle of every edge's part in between.
void visit_slab(const TriMesh& surface, double low, double high,
                const std::function<void(const Vec3&)>& visit);

/// The parts of the vertical line through (x, y), from z = low to high, that lie in the tool.
std::vector<std::pair<double, double>> occupied(const Tool& tool, const Vec2& xy, double low,
                                                double high);

} // namespace plyform
