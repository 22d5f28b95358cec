// SPDX-License-Identifier: GPL-3.0-or-later
// Internal to core/mesh: functions that its files share. Lengths in mm.
#pragma once

#include "core/mesh/mesh_blank.hpp"

#include <array>
#include <numbers>
#include <optional>
#include <vector>

namespace plyform {

using Edge = std::array<std::int32_t, 2>;

/// z component of a x b.
inline double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Points joined by edges. The region to mesh is the set of points separated from infinity by an
/// odd number of edges.
struct Region {
  std::vector<Vec2> x;
  std::vector<Edge> edges;
};

/// Unit directions of two families of cell sides, cross(a, b) > 0 and a.b >= 0.
struct CellDirections {
  Vec2 a = Vec2::UnitX(), b = Vec2::UnitY();
};

/// x and y, or for MeshKind::fibres the fibre directions (rad), reversed or swapped so that the
/// angle from a to b is at most 90 degrees. Throws std::runtime_error if it is below 25 degrees.
CellDirections cell_directions(MeshKind mesh, double warp, double weft);

/// Cells that are not squares: the angle from a to b differs from 90 degrees.
inline bool is_skew(const CellDirections& d) {
  return d.a.dot(d.b) > 1e-8;
}

/// Throws std::runtime_error unless the outline can be meshed with elements of this size.
void check_outline(const Outline& outline, double element_size);

/// The loops of the outline divided into pieces of about `spacing` (mm), equal between two corners;
/// every corner is a point. Arcs have pieces of `largest_turn` (rad) at most, ends on the arc.
Region sample_outline(const Outline& outline, double spacing,
                      double largest_turn = std::numbers::pi / 4.0);

/// Points of a loop, `hole` as in OutlineArc: corners, and between them those that divide sides and
/// arcs as sample_outline.
std::vector<Vec2> sample_loop(const Outline& outline, int hole, double spacing,
                              double largest_turn);

/// Appends the two or four triangles of the cell p00 p10 p11 p01 (node numbers); `centre` is the
/// node in its middle, for MeshKind::crossed. The diagonal is p00-p11, or with other_diagonal
/// p10-p01, which is the shorter one of a skew cell (angle at p00 below 90 degrees).
void append_cell(const std::array<std::int32_t, 4>& cell, std::int32_t centre, MeshKind mesh,
                 bool other_diagonal, std::vector<Triangle>& triangles);

/// Exact grid if the outline is a parallelogram without holes with sides parallel to those of the
/// cells, else nothing (structured_mesh.cpp).
std::optional<BlankMesh> structured_blank(const BlankSpec& spec, const CellDirections& directions);

/// Whole cells inside, a band of triangles along the outline (cut_mesh.cpp).
BlankMesh cut_blank(const BlankSpec& spec, const CellDirections& directions);

/// Delaunay mesh of the whole outline, with a mean edge of about element_size.
BlankMesh free_blank(const BlankSpec& spec);

/// Mesh from an STL, OBJ, PLY or OFF file. Throws std::runtime_error as mesh_blank.
BlankMesh blank_from_file(const std::filesystem::path& file);

/// Delaunay refinement (CGAL Mesh_2) of a region. The nodes of the region come first and keep their
/// numbers; edges may be split. min_angle: rad, at most 20.7 degrees (beyond, termination is not
/// proven); smaller angles of the region itself remain. max_edge: mm, 0 for no bound.
BlankMesh refine(const Region& region, double min_angle, double max_edge);

} // namespace plyform
