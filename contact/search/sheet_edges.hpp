// SPDX-License-Identifier: GPL-3.0-or-later
// The edges of a sheet, and patches of neighbouring edges whose motion is bounded together.
//
// Two edges that were a gap g apart cannot touch before one has moved by g relative to the other.
// Plies that are drawn in together move far, but hardly relative to each other: a bound by patches
// leaves most pairs alone for hundreds of steps, where one by the motion of whole sheets would have
// them measured again every few.
//
//   u in box(p)           displacement in a step of every node of patch p, an axis-parallel box
//   |u_a - u_b| <= |r|,   r_i = max(max_i a - min_i b, max_i b - min_i a)                    (R)
#pragma once

#include "base/geometry.hpp"
#include "contact/face_across.hpp"

#include <span>
#include <vector>

namespace plyform {

/// An edge of a sheet: its nodes, a < b, and the third nodes of its triangles: c of that in which b
/// follows a counter-clockwise, d of the other; no_face if there is none. On plane k of symmetry
/// the mirror image of its one triangle is on the other side, and its third node is mirror_of(k).
struct SheetEdge {
  std::int32_t a, b, c, d;
  /// Whether it is a free edge, with a triangle on one side only.
  bool is_free() const { return c == no_face || d == no_face; }
};

constexpr std::int32_t mirror_of(std::size_t plane) {
  return -2 - static_cast<std::int32_t>(plane);
}

/// All edges of a sheet.
struct SheetEdges {
  /// In ascending order of their node numbers. An edge of more than two triangles (non-manifold) is
  /// listed once for every two of them.
  std::vector<SheetEdge> all;
  std::vector<std::int32_t> patch;                    ///< of each edge
  std::vector<std::vector<std::int32_t>> patch_edges; ///< of each patch, ascending
  std::vector<std::vector<std::int32_t>> patch_nodes; ///< of the edges of each patch, ascending
  std::vector<std::array<std::int32_t, 3>> patches_of_triangle; ///< of its three edges
  /// Of each triangle, that across the edge opposite to each corner; no_face or several_faces of
  /// contact/face_across.hpp.
  std::vector<std::array<std::int32_t, 3>> faces_across;
  std::vector<Vec3> plane_normals = {}; ///< of the planes of symmetry, unit vectors

  /// Where the third nodes of an edge's triangles are, mm; of a free edge one is of no use.
  std::array<Vec3, 2> third_nodes(const SheetEdge& edge, std::span<const Vec3> x) const;
};

/// The nodes of a sheet that lie on a plane of symmetry.
struct NodesOnPlane {
  Vec3 normal = Vec3::Zero();      ///< of the plane, unit vector
  std::vector<std::int32_t> nodes; ///< ascending
};

/// The edges of these triangles, with patches by square cells in the plane of the two largest
/// extents of the nodes, x0 (mm).
SheetEdges sheet_edges(std::span<const Triangle> triangles, std::span<const Vec3> x0,
                       std::span<const NodesOnPlane> planes = {});

/// Distances (mm) of the nodes, at x, from the nearest free edge; infinite without any.
std::vector<double> rim_distances(const SheetEdges& edges, std::span<const Vec3> x);

/// The longest edge with the nodes at x, mm.
double longest_side(const SheetEdges& edges, std::span<const Vec3> x);

/// Boxes (mm) of the displacements of each patch's nodes in a step. motion: mm, one per node.
void patch_motions(const SheetEdges& edges, std::span<const Vec3> motion, std::vector<Box3>& boxes);

/// (R), mm: the largest relative displacement of a node of one patch and one of the other.
double relative_motion(const Box3& a, const Box3& b);

} // namespace plyform
