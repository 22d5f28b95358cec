// SPDX-License-Identifier: GPL-3.0-or-later
// Mesh generation for a blank: the flat, undeformed ply in its own plane.
#pragma once

#include "contact/shapes/tool_shape.hpp"
#include "core/model/blank_spec.hpp"

#include <string>
#include <vector>

namespace plyform {

/// Nodes (mm) and anticlockwise triangles; every node belongs to a triangle.
struct BlankMesh {
  std::vector<Vec2> x;
  std::vector<Triangle> triangles;
};

/// Meshes a blank; the same bits every time. `warp` and `weft` are the fibre directions (rad from
/// x), used by MeshKind::fibres only. Rectangles (and parallelograms) with sides parallel to those
/// of the cells give exact structured grids: round(side/element_size) cells per side, at least one;
/// nodes row by row, then the centres of crossed cells. For other outlines the cells of a lattice
/// through the middle of the bounding box that lie wholly inside are joined to the outline by a
/// band of triangles; the outline keeps every corner and is divided at about element_size between
/// them. Angles in the band and in free meshes are 20 degrees at least, except at sharper corners
/// of the outline. Zones and grid bisect the triangles of all kinds but free ones until they are at
/// most 2^(1/4) times as large as wanted anywhere in them (core/mesh/bisection.hpp): no angle gets
/// smaller than half of its triangle's smallest, but beside arcs, on which new nodes lie. Arcs are
/// divided into equal pieces of about element_size, and of 45 degrees at most, with nodes on the
/// arc. Equal nodes of a file are merged and its triangles oriented anticlockwise. Throws
/// std::runtime_error (what is wrong, what to do): outline not simple or not closed properly, hole
/// outside or touching, element larger than the blank or far too small, zones that ask for far too
/// many triangles, fibre directions less than 25 degrees apart, file unreadable, empty, not flat,
/// not of triangles, not manifold or not in one piece.
BlankMesh mesh_blank(const BlankSpec& spec, double warp, double weft);

/// Appends a closed chain of lines and arcs (contact/shapes/tool_shape.hpp) to the outline, the
/// first one as its boundary, others as holes. Arcs are divided into pieces of at most a quarter.
void append_loop(Outline& outline, const Profile& chain);

/// Appends a circle.
void append_circle(Outline& outline, const Vec2& centre, double radius);

/// Throws std::runtime_error (what is wrong, what to do) unless the polygon is simple and has an
/// area. name: what messages call it.
void check_polygon(const std::vector<Vec2>& corners, const std::string& name);

/// Area (mm^2) that the outline encloses, arcs as they are.
double area_of(const Outline& outline);

/// How many corners the mesh leaves out with elements of that size, mm: those within 2 % of it of
/// the corner before.
std::size_t merged_corners(const Outline& outline, double element_size);

/// The corners of the boundary and points between them on arcs, at most largest_turn (rad) apart.
std::vector<Vec2> points_of(const Outline& outline, double largest_turn);

/// Moves all of the outline.
void shift(Outline& outline, const Vec2& by);

/// Triangles of the blank's mesh, roughly; 0 for one from a file.
double expected_triangles(const BlankSpec& spec);

/// The smallest element size (mm) that the blank's zones and grid ask for, or its own.
double smallest_wanted(const BlankSpec& spec);

/// Whether the outline can be meshed with its element_size: false if mesh_blank would throw for it.
bool takes_elements(const BlankSpec& spec);

} // namespace plyform
