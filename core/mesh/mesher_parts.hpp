// SPDX-License-Identifier: GPL-3.0-or-later
// Internal to core/mesh: functions that its files share. Lengths in mm.
#pragma once

#include "core/mesh/mesh_blank.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <vector>

namespace plyform {

using Edge = std::array<std::int32_t, 2>;

/// z component of a x b.
inline double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Angle (rad) from p to q about the centre of an arc, in the direction of its turn, above 0.
inline double sweep_of(const Vec2& centre, int turn, const Vec2& p, const Vec2& q) {
  const Vec2 u = p - centre, v = q - centre;
  const double angle = std::atan2(turn * cross(u, v), u.dot(v));
  return angle > 0.0 ? angle : angle + 2.0 * std::numbers::pi;
}

/// The middle of a piece of an arc from p to q about `centre`, mm. The radii of both ends may
/// differ by the rounding of a drawing's numbers.
inline Vec2 middle_on_arc(const Vec2& p, const Vec2& q, const Vec2& centre) {
  const Vec2 u = p - centre, v = q - centre;
  return centre + 0.5 * (u.norm() + v.norm()) * (u + v).normalized();
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

/// rad: most that a piece of an arc turns.
inline constexpr double coarsest_turn = std::numbers::pi / 4.0;

/// The loops of the outline divided into pieces of about `spacing` (mm), equal between two corners;
/// every corner is a point. Arcs have pieces of `largest_turn` (rad) at most, ends on the arc.
Region sample_outline(const Outline& outline, double spacing, double largest_turn = coarsest_turn);

/// Points of a loop, `hole` as in OutlineArc: corners, and between them those that divide sides and
/// arcs as sample_outline.
std::vector<Vec2> sample_loop(const Outline& outline, int hole, double spacing,
                              double largest_turn);

/// A side of a loop, divided: its first corner and the points up to the next one, `end`; arc: that
/// it is, or null.
struct SampledSide {
  std::vector<Vec2> points;
  Vec2 end;
  const OutlineArc* arc;
};

/// The sides of a loop as sample_loop divides them. Arcs point into the outline.
std::vector<SampledSide> sample_sides(const Outline& outline, int hole, double spacing,
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

/// More triangles are rejected as a probable mistake in an element size: one time step of them
/// would take seconds.
inline constexpr double most_triangles = 1e7;

/// Delaunay mesh of the whole outline, with a mean edge of about element_size, or of what zones and
/// grid ask for.
BlankMesh free_blank(const BlankSpec& spec);

/// Throws std::runtime_error if zones and grid ask for far too small or too many triangles.
void check_zones(const BlankSpec& spec);

/// Bisects triangles until they are as small as the blank's zones and grid ask for
/// (graded_mesh.cpp).
BlankMesh graded(BlankMesh mesh, const BlankSpec& spec);

/// Mesh from an STL, OBJ, PLY or OFF file. Throws std::runtime_error as mesh_blank.
BlankMesh blank_from_file(const std::filesystem::path& file);

/// Delaunay refinement (CGAL Mesh_2) of a region. The nodes of the region come first and keep their
/// numbers; edges may be split. min_angle: rad, at most 20.7 degrees (beyond, termination is not
/// proven); smaller angles of the region itself remain. max_edge: mm, 0 for no bound.
BlankMesh refine(const Region& region, double min_angle, double max_edge);

/// The longest side (mm, above 0) that a triangle with these corners may have.
using LongestSide = std::function<double(const std::array<Vec2, 3>&)>;

/// The same with sides bounded from place to place.
BlankMesh refine(const Region& region, double min_angle, const LongestSide& longest_side);

} // namespace plyform
