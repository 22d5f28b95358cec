// SPDX-License-Identifier: GPL-3.0-or-later
// Flat plies and tools in their initial positions, and geometric queries for checks.
#pragma once

#include "core/mesh/mesh_blank.hpp"
#include "core/model/case.hpp"

#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace plyform {

/// A ply before forming: all nodes at height z.
struct FlatPly {
  BlankMesh mesh;
  std::vector<std::pair<Vec2, Vec2>> border; ///< edges with one triangle
  Eigen::AlignedBox2d bounds;
  double z, half; ///< mm, mid-surface and half the thickness
};

FlatPly make_flat_ply(BlankMesh mesh, double z, double thickness);

/// Whether p (mm) lies inside the ply's mesh: an odd number of border edges is to its right.
bool covers(const FlatPly& ply, const Vec2& p);

/// The distance (mm) to a tool at the last place asked, for searches of the least of many: a
/// distance changes by no more than the way between two places, so most need not be asked.
struct LastDistance {
  Vec3 at = Vec3::Zero();
  double distance = -std::numeric_limits<double>::infinity();
  double at_least(const Vec3& p) const { return distance - (p - at).norm(); }
};

/// Signed distance (mm) of p (space) to the tool moved by `shift`; `hint` as for signed_distance.
double tool_distance(const Tool& tool, const Vec3& shift, const Vec3& p, SurfaceHint& hint);

/// Whether the tool has a bound in every direction: a plane has none.
bool bounded_tool(const Tool& tool);

/// Depth (mm) up to which one counts as touching: a thousandth of the thinnest ply. Coordinates
/// have been rounded when files were written, and contact does not feel so little.
double touch_depth(std::span<const FlatPly> plies);

/// The tool's surface in space as triangles of `size` (mm), but between 1/300 and 1/60 of its
/// diagonal: what is large in a mesh is divided, so that points of the surface stand for all of it.
/// Planes extend `extent` mm from the tool's origin.
TriMesh tool_surface(const Tool& tool, double size, double extent);

/// A side of a face, its nodes in order of number.
struct FaceSide {
  std::int32_t first, second;
  std::size_t face;
  bool same_edge(const FaceSide& other) const {
    return first == other.first && second == other.second;
  }
};

/// The sides of all faces, those of one edge one after the other, by number of their faces.
std::vector<FaceSide> sides_by_edge(const std::vector<Triangle>& faces);

/// Calls visit(p) for points p of the surface with heights between `low` and `high` (mm): corners,
/// middles of triangles, and the ends and middle of the part of every edge in between.
void visit_slab(const TriMesh& surface, double low, double high,
                const std::function<void(const Vec3&)>& visit);

/// Intervals of z (mm), between low and high, in which the vertical line through xy lies in the
/// tool.
std::vector<std::pair<double, double>> occupied(const Tool& tool, const Vec2& xy, double low,
                                                double high);

} // namespace plyform
