// SPDX-License-Identifier: GPL-3.0-or-later
// The edges of two plies against each other, where both are folded.
//
// Node-to-face contact keeps every node h away from the other sheet. Between its nodes a straight
// edge can still come closer, but only where both sheets are folded there: over a flat part of one
// sheet a segment whose ends stay h away stays h away. So only edges whose fold has a sag
// (half the edge times the tangent of half the fold) of 0.4 thicknesses, and rims, are looked at,
// and only closer than h/2: on a smoothly curved stack edges
// of the two polyhedra are a little closer than h by construction, which is no penetration.
//
//   y_a = (1-s) x_1 + s x_2,  y_b = (1-t) x_3 + t x_4   closest points of the two edges, inside
//   both d = side * |y_a - y_b|,  negative once the edges have crossed;  p = h/2 - d E = 1/2 A k
//   p^2, force A k p along +-n as in (S) of sheet_contact.hpp
//
// No friction here: the nodes around carry it.
#pragma once

#include "contact/contact_law.hpp"
#include "contact/near_list.hpp"
#include "contact/tool_contact.hpp"

#include <span>
#include <vector>

namespace plyform {

/// An edge of a sheet: its nodes and the triangles on both sides (-1: none, it is a rim).
struct SheetEdge {
  std::int32_t a, b, left, right;
};

/// All edges of a sheet, in ascending order of their nodes. Non-manifold edges are given once for
/// each further triangle.
std::vector<SheetEdge> sheet_edges(std::span<const Triangle> triangles);

/// Numbers of the edges that are rims or whose fold now has a sag of more than 0.4 thicknesses
/// (mm).
std::vector<std::int32_t> folded_edges(std::span<const SheetEdge> edges,
                                       std::span<const Triangle> triangles, std::span<const Vec3> x,
                                       double thickness);

/// One pair of edges.
struct EdgePair {
  SheetEdge a, b;
  int side = 0;          ///< orientation since the closest points are inside both; 0: they are not
  double area = 0.0;     ///< mm^2
  double distance = 0.0; ///< mm, signed
  double s = 0.0, t = 0.0;
};

struct EdgeContact {
  ContactLaw law;        ///< stiffness and damping per area; friction is not used
  double distance = 0.0; ///< h/2, mm
  std::vector<EdgePair> pairs;
  NearList list; ///< of the pairs
  ContactSums sums;
  ContactTime time;
};

/// Renews the pairs: folded edges of both sheets within distance + skin, and every pair
/// that touches already, folded or not. Pairs keep their side. path: mm, as of
/// contact/near_list.hpp.
void find_edge_pairs(EdgeContact& contact, const SheetState& a, std::span<const SheetEdge> edges_a,
                     std::span<const std::int32_t> folded_a, const SheetState& b,
                     std::span<const SheetEdge> edges_b, std::span<const std::int32_t> folded_b,
                     double skin, double path);

/// Adds the forces of one step to those of each sheet's nodes, N. dt: the step that led to these
/// positions, s. path: mm, as of contact/near_list.hpp.
void edge_forces(EdgeContact& contact, const SheetState& a, const SheetState& b, double dt,
                 double path, std::span<Vec3> force_a, std::span<Vec3> force_b);

/// Row sums of the contact stiffness matrix, N/mm, of pairs that touch or are within `margin` (mm)
/// of it.
void add_edge_stiffness(const EdgeContact& contact, double margin, std::span<double> rows_a,
                        std::span<double> rows_b);

} // namespace plyform
