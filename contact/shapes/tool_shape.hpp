// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes of rigid tools in their own frame, and where a point stands to them.
//
// Every shape is a solid (or, for an open mesh and an open profile, the side of a surface). The
// signed distance is positive outside. Lengths in mm, angles in rad. Tool frame: origin at the
// tool's `position`, local z along its `axis`.
#pragma once

#include "contact/geometry.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <variant>

namespace plyform {

/// Ball of `radius` about the origin.
struct Sphere {
  double radius;
};
/// Solid cylinder along z, from z = -length/2 to +length/2, its rims rounded with edge_radius (no
/// more than fits): all that lies within edge_radius of the cylinder that is smaller by it on every
/// side, so that radius and length stay those of the whole.
struct Cylinder {
  double radius, length, edge_radius = 0.0;
};
/// Solid box centred on the origin, full edge lengths `size`, its edges and corners rounded with
/// edge_radius as a cylinder's.
struct Box {
  Vec3 size;
  double edge_radius = 0.0;
};
/// Half-space z <= 0.
struct Plane {};
/// Solid ring about z: r from inner_radius to outer_radius, z from 0 to thickness; the corners of
/// the section are rounded with edge_radius. inner_radius = 0 is a disc. The local z = 0 plane is
/// the lower face.
struct Annulus {
  double inner_radius, outer_radius, thickness, edge_radius;
};

/// One piece of a profile in the (r, z) half-plane: a line from a to b, or an arc about `centre`
/// from a to b, anticlockwise (in r to the right, z up) when `turn` = +1, clockwise when -1.
struct ProfileSegment {
  enum class Kind { line, arc } kind;
  Vec2 a, b;
  Vec2 centre{0.0, 0.0};
  int turn = 0;
};
/// Surface of revolution about z. Walking along the segments in order, the free side is on the
/// left and the tool's material on the right. A hole with a fillet: up the wall, round, outwards.
/// Each segment starts exactly where the one before ended. It bounds a solid when it ends where it
/// began (a ring) or begins and ends on the axis; else it is open, and past its ends the side is
/// that of the end's tangent. An arc with a = b is a full circle. At least one segment.
struct RevolvedProfile {
  std::vector<ProfileSegment> segments;
};

/// Triangle mesh with its CGAL search tree, built by load_tool_mesh or make_mesh_shape. Immutable
/// and safe to ask from several threads.
class MeshShape;
using MeshShapePtr = std::shared_ptr<const MeshShape>;

using ToolShape =
    std::variant<Sphere, Cylinder, Box, Plane, Annulus, RevolvedProfile, MeshShapePtr>;

/// Signed distance (mm, positive outside) and its unit gradient at the asked point.
struct SurfacePoint {
  double distance;
  Vec3 normal;
};

/// Where p (tool frame) stands to the shape. `hint` is the caller's memory for this point (start
/// with -1); only meshes use it (the last closest triangle), to speed up the search: the answer
/// does not depend on it. Never fails for finite p: on a medial axis any valid normal is returned.
SurfacePoint signed_distance(const ToolShape& shape, const Vec3& p, int& hint);

/// Triangles of about `size` mm for pictures and the exact audit, in the tool frame. Unbounded
/// shapes (plane) are cut to `extent` (mm from the origin). Nodes lie on the surface; arcs get
/// pieces of at most 22.5 degrees. Solids give closed meshes, outward; normals of open ones point
/// to the free side. A mesh is returned as it is. Throws std::invalid_argument unless size > 0.
TriMesh tessellate(const ToolShape& shape, double size, double extent);

/// Radius (mm) of the tightest curve of the shape that a sheet has to follow; 0 for a sharp edge,
/// infinity for a plane. For meshes: infinity (unknown). Inner corners of a profile do not count.
double smallest_radius(const ToolShape& shape);

/// Whether what smallest_radius is of curves along both of its directions, as a ball or a rounded
/// corner does: a flat triangle then cuts in deeper.
bool curves_both_ways(const ToolShape& shape);

/// The profile through points {r, z, fillet radius}: straight lines, each corner rounded by its
/// fillet. The last point may be the first again: a closed ring, that corner sharp. Throws
/// std::invalid_argument (saying which corner and why) if a fillet does not fit or stands at an
/// end, a point repeats the one before, r < 0, a number is not finite, or fewer than two points.
RevolvedProfile make_profile(const std::vector<std::array<double, 3>>& points);

/// What reading a mesh did to it.
struct MeshReport {
  std::size_t vertices = 0, faces = 0;
  bool closed = false;
  bool flipped = false;               ///< a closed mesh came inward and was turned round
  std::size_t removed_degenerate = 0; ///< zero-area faces dropped
};

/// Reads STL (ASCII or binary), OBJ, PLY or OFF through CGAL, merges duplicated points, orients it
/// consistently, turns closed meshes outward (inner shells inward), scales coordinates by `scale` >
/// 0 and builds the search tree. Throws std::runtime_error with what is wrong and what to do: file
/// missing, of another kind, truncated or unreadable, no faces, not orientable, non-finite
/// coordinates, self-intersecting closed mesh.
MeshShapePtr load_tool_mesh(const std::filesystem::path& file, double scale, MeshReport* report);

/// The same from triangles in memory (tests, generated tools).
MeshShapePtr make_mesh_shape(const TriMesh& surface, MeshReport* report);

} // namespace plyform
