// SPDX-License-Identifier: GPL-3.0-or-later
// The edges of two plies against each other, where both are folded.
//
// Node-to-face contact keeps every node no less than h - delta_n from the other sheet (delta_n: its
// depth limit, h/4). Between its nodes a straight edge can still come closer, but only where both
// sheets are folded there: over a flat part of one sheet a segment whose ends stay away stays away.
//
//   phi   rad  fold: angle between the normals on both sides of an edge
//   L, l  mm   length of the longest edge that may cross it; of the edge itself
//   sag   mm   L/2 tan(phi/2): how far the sheet falls off from its edge under the ends of the one
//              that crosses it; times L/(2 l) where that spans more than the two triangles      (1)
//
// Two edges so stay h - delta_n - min(sag_a, sag_b) apart. Contact begins at h/2, closer than which
// only edges of a sag of h/4 or more come, and ends, without limit, at h/4. It looks at those that
// have a sag of 0.15 h, since folds grow until the next search, and at rims. On smoothly curved
// stacks edges are a little closer than h by construction, which is no penetration.
//
//   y_a = (1-s) x_1 + s x_2,  y_b = (1-t) x_3 + t x_4   closest points of the two edges, inside
//   d = side * |y_a - y_b|,  negative once the edges have crossed;  p = h/2 - d
//   energy and force by contact_law.hpp, along +-n as in (S) of sheet_contact.hpp
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

/// Of the contact distance h: the least sag of edges that contact looks at.
constexpr double least_sag = 0.15;

/// Numbers of the edges that are rims or have a sag (1) of at least `least` mm; other_length: L,
/// mm.
std::vector<std::int32_t> folded_edges(std::span<const SheetEdge> edges,
                                       std::span<const Triangle> triangles, std::span<const Vec3> x,
                                       double least, double other_length);

/// The nodes of an edge.
struct EdgeNodes {
  std::int32_t a, b;
};

/// One pair of edges.
struct EdgePair {
  EdgeNodes a, b;
  int side = 0;          ///< orientation since the closest points are inside both; 0: they are not
  double area = 0.0;     ///< mm^2
  double distance = 0.0; ///< mm, signed
  double s = 0.0, t = 0.0;
};

struct EdgeContact {
  ContactLaw law;        ///< stiffness and damping per area; friction is not used
  double distance = 0.0; ///< h/2, mm
  std::vector<EdgePair> pairs;
  NearList list;            ///< of the pairs
  double renew_depth = 0.0; ///< mm, penetration at which the stable step is due again
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

/// mm, of two edges wherever their closest points are.
double edge_distance(const EdgePair& pair, const SheetState& a, const SheetState& b);

/// Brings a pair up to date, its distance to `far` (mm) while the closest points are not inside
/// both edges; returns the unit vector from b to a across the gap, or zero then.
Vec3 measure_edges(EdgePair& pair, const SheetState& a, const SheetState& b, double far);

/// Adds the forces of one step to those of each sheet's nodes, N. dt: the step that led to these
/// positions, s. path: mm, as of contact/near_list.hpp.
void edge_forces(EdgeContact& contact, const SheetState& a, const SheetState& b, double dt,
                 double path, std::span<Vec3> force_a, std::span<Vec3> force_b);

/// Row sums of the contact matrices, of pairs that touch or are within `margin` (mm) of it.
void add_edge_stiffness(const EdgeContact& contact, double margin, std::span<ContactRow> rows_a,
                        std::span<ContactRow> rows_b);

} // namespace plyform
