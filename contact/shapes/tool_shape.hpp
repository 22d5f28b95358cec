// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes of rigid tools in their own frame, and the signed distance of a point to them.
//
// Every shape is a solid (or, for an open mesh and an open profile, the side of a surface). The
// signed distance is positive outside. Lengths in mm, angles in rad. Tool frame: origin at the
// tool's `position`, local z along its `axis`.
#pragma once

#include "base/geometry.hpp"
#include "contact/surface_hint.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <variant>

namespace plyform {

/// Ball of `radius` about the origin.
struct Sphere {
  double radius;
};
/// Solid cylinder along z, from z = -length/2 to +length/2, its rims rounded with edge_radius
/// (limited to what fits). radius and length are those of the rounded solid.
struct Cylinder {
  double radius, length, edge_radius = 0.0;
};
/// Solid box centred on the origin, full edge lengths `size` (of the rounded solid), its edges and
/// corners rounded with edge_radius (limited to what fits).
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

/// One piece of a profile in a plane, (r, z) or (x, z): a line from a to b, or an arc about
/// `centre` from a to b, anticlockwise (first axis to the right, second up) when `turn` = +1,
/// clockwise when -1.
struct ProfileSegment {
  enum class Kind { line, arc } kind;
  Vec2 a, b;
  Vec2 centre{0.0, 0.0};
  int turn = 0;
};
/// Lines and arcs, at least one; each starts exactly where the one before ended. An arc with a = b
/// is a full circle. Walking along, the free side is on the left and the tool's material on the
/// right: the profile of a hole with a fillet goes up the wall, round the fillet and outwards.
using Profile = std::vector<ProfileSegment>;

/// Surface of revolution about z. The profile bounds a solid if it ends where it began (a ring) or
/// begins and ends on the axis; else it is open, and past its ends the sign is that of the side of
/// the end's tangent.
struct RevolvedProfile {
  Profile segments;
};

/// A profile in the (x, z) plane drawn out along y, from y = -length/2 to +length/2, with sharp
/// ends. The side of an open profile is as for a surface of revolution.
struct ExtrudedProfile {
  Profile segments;
  double length;
};

/// Triangle mesh with its CGAL search tree, built by load_tool_mesh or make_mesh_shape. Immutable;
/// several threads may use it at once.
class MeshShape;
using MeshShapePtr = std::shared_ptr<const MeshShape>;

using ToolShape = std::variant<Sphere, Cylinder, Box, Plane, Annulus, RevolvedProfile,
                               ExtrudedProfile, MeshShapePtr>;

/// Signed distance (mm, positive outside) of a point and its unit gradient there.
struct SurfacePoint {
  double distance;
  Vec3 normal;
};

/// Signed distance (mm) and normal at p (mm, tool frame): shape_distance.hpp, profile.cpp,
/// mesh_shape.cpp. `hint` is state that the caller keeps per point; only meshes use it, to spare
/// the search, and the result does not depend on it.
/// Defined for every finite p: on the medial axis one of the valid normals is returned.
SurfacePoint signed_distance(const ToolShape& shape, const Vec3& p, SurfaceHint& hint);

/// Triangles of about `size` mm for pictures and the exact check of intersections, in the tool
/// frame. Unbounded shapes (plane) are cut at `extent` (mm from the origin). Nodes lie on the
/// surface; arcs are divided into pieces of at most 22.5 degrees. Solids give closed meshes with
/// outward normals; normals of open meshes point to the free side. A mesh tool is returned
/// unchanged. Throws std::invalid_argument unless size > 0.
TriMesh tessellate(const ToolShape& shape, double size, double extent);

/// Divides sides that are longer than `size` (mm) at their middles until none is, and their
/// triangles with them; the surface stays as it is.
void divide_sides(TriMesh& surface, double size);

/// The box (mm, tool frame) around tessellate(shape, any size, extent); empty of a shape without
/// area.
Box3 box_of(const ToolShape& shape, double extent);

/// Diagonal (mm) of box_of; 0 of a shape without area.
/// A tool may be a thousand times as large as the plies.
double diagonal_of(const ToolShape& shape, double extent);

/// Facets of a mesh; 0 of other shapes.
std::size_t facet_count(const ToolShape& shape);

/// Smallest radius of curvature (mm) of the shape that a sheet has to follow; 0 for a sharp edge,
/// infinity for a plane. Inner corners do not count: a sheet bridges them. Of a mesh that of the
/// surface that it stands for (mesh_curvature.hpp).
double smallest_radius(const ToolShape& shape);

/// The same, but of a mesh without its sharp edges: those of a solid often are where no sheet gets.
double smallest_rounding(const ToolShape& shape);

/// smallest_rounding of the facet of a mesh that is closest to p (mm, tool frame); of other shapes
/// smallest_radius.
double radius_near(const ToolShape& shape, const Vec3& p);

/// How far (mm) the surface that a mesh stands for may be from its facet that is closest to p (mm,
/// tool frame); 0 of other shapes.
double deflection_near(const ToolShape& shape, const Vec3& p);

/// The profile through points {r, z, fillet radius} (mm): straight lines, each corner rounded by
/// its fillet. If the last point repeats the first the profile is a ring, with that corner sharp.
/// Throws std::invalid_argument (saying which corner and why) if a fillet does not fit or stands at
/// an end, a point repeats the one before, r < 0, a number is not finite, or fewer than two points.
RevolvedProfile make_profile(const std::vector<std::array<double, 3>>& points);

/// How messages call a point of a chain and its coordinates.
struct PointWords {
  const char *point, *first, *second;
};

/// The chain through points {first, second, fillet radius} (mm), each corner rounded by its fillet;
/// with `closed` back to the first point, which is a corner as the others. Throws
/// std::invalid_argument as make_profile, for any sign of the coordinates.
Profile round_corners(const std::vector<std::array<double, 3>>& points, bool closed,
                      const PointWords& words);

/// Truncated cone about z as a profile: `radius` at z = -length/2, `top_radius`, which may be 0, at
/// z = +length/2. Its edges, and its tip, are rounded with edge_radius: faces and flank stay where
/// they are, the solid gets smaller. Throws std::invalid_argument if the roundings do not fit.
RevolvedProfile make_cone(double radius, double top_radius, double length, double edge_radius);

/// Torus about z: a circle of minor_radius about (r, z) = (major_radius, 0); minor < major.
RevolvedProfile make_torus(double major_radius, double minor_radius);

/// Size of a tool mesh, and what was changed when it was read.
struct MeshReport {
  std::size_t vertices = 0, faces = 0;
  bool closed = false;
  bool flipped = false;               ///< a closed mesh was oriented inward and has been reversed
  std::size_t removed_degenerate = 0; ///< zero-area faces dropped
};

/// Reads STL (ASCII or binary), OBJ, PLY or OFF (base/polygon_file.hpp), merges duplicated points,
/// orients it consistently, turns closed meshes outward (inner shells inward), scales coordinates
/// by `scale` > 0 and builds the search tree. Throws std::runtime_error with what is wrong and what
/// to do: file missing, of another kind, truncated or unreadable, no faces, not orientable,
/// non-finite coordinates, self-intersecting closed mesh.
MeshShapePtr load_tool_mesh(const std::filesystem::path& file, double scale, MeshReport* report);

/// As load_tool_mesh, from triangles in memory (mm), for tests and generated tools.
MeshShapePtr make_mesh_shape(const TriMesh& surface, MeshReport* report);

} // namespace plyform
