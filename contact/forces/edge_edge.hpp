// SPDX-License-Identifier: GPL-3.0-or-later
// Edge-edge contact between two plies, or of a ply with itself.
//
// Node-to-face contact keeps every node no less than h - delta_n from the other sheet (delta_n: its
// depth limit, h/4). Between its nodes a straight edge can still come closer, but only where both
// sheets are folded: over a flat part of one sheet, all of a segment is as far away as its ends.
// Edge contact begins at h/2, since on smoothly curved stacks edges are a little closer than h by
// construction, and its force becomes infinite at h/4. All edges are searched, also those without a
// fold, since folds grow between two searches.
//
//   y_a = (1-s) x_1 + s x_2,  y_b = (1-t) x_3 + t x_4   closest points of the two edges, inside
//   d = side * |y_a - y_b|,  negative once the edges have crossed;  p = h/2 - d
//   energy and force by contact_law.hpp, along +-n as in (S) of ply_ply.hpp
//
// Edge-edge contact has no friction: node-to-face contacts of the nodes around carry it.
#pragma once

#include "contact/forces/contact_law.hpp"
#include "contact/forces/tool_ply.hpp"
#include "contact/search/active_list.hpp"

#include <span>
#include <vector>

namespace plyform {

/// An edge of a sheet: its nodes, and whether it is a free edge (a triangle on one side only).
struct SheetEdge {
  std::int32_t a, b;
  bool rim;
};

/// All edges of a sheet, in ascending order of their node numbers. An edge of more than two
/// triangles (non-manifold) is listed once for every two of them.
std::vector<SheetEdge> sheet_edges(std::span<const Triangle> triangles);

/// The nodes of an edge.
struct EdgeNodes {
  std::int32_t a, b;
};

/// One pair of edges that may touch.
struct EdgePair {
  std::array<std::int32_t, 2> edge{}; ///< numbers of the two edges
  EdgeNodes a, b;
  int side = 0;          ///< orientation when the closest points became interior to both; 0: not so
  double area = 0.0;     ///< mm^2, tributary area of the contact
  double distance = 0.0; ///< mm, d, signed; twice the contact's distance if side is 0
  double s = 0.0, t = 0.0;
};

/// All edges of a sheet, and the numbers of those to search, ascending.
struct EdgeSet {
  std::span<const SheetEdge> all;
  std::span<const std::int32_t> some;
};

struct EdgeEdgeContact {
  ContactLaw law;        ///< stiffness and damping per area; friction is not used
  double distance = 0.0; ///< h/2, mm
  std::vector<std::array<std::int32_t, 2>> candidates; ///< numbers of edges of a and b, ascending
  ActiveList list;                                     ///< of the candidates
  std::vector<EdgePair> pairs;                         ///< of list.active, in its order
  double renew_depth = 0.0; ///< mm, penetration at which the stable time step is computed again
  ContactTotals sums;
  ContactTime time;
};

/// Self-contact of a sheet: edges that share a node or are closer than `apart` (mm) in the
/// undeformed sheet, with nodes at x0 (mm), are neighbours and form no pair; each pair is listed
/// once.
struct SelfEdges {
  std::span<const Vec3> x0; ///< empty: two sheets
  double apart = 0.0;
};

/// Searches the candidates anew: pairs of edges at a distance <= contact.distance + skin (mm). x of
/// a, b: mm. path_length: mm, as of contact/search/active_list.hpp. For self-contact a and b are
/// the same sheet, and `self` is given.
void find_edge_pairs(EdgeEdgeContact& contact, const SurfaceKinematics& a, const EdgeSet& edges_a,
                     const SurfaceKinematics& b, const EdgeSet& edges_b, double skin,
                     double path_length, const SelfEdges& self = {});

/// Distance (mm) of two edges as segments. a, b: positions of the nodes of their sheets, mm.
double edge_distance(const EdgeNodes& edge_a, std::span<const Vec3> a, const EdgeNodes& edge_b,
                     std::span<const Vec3> b);

/// Whether a pair is closed or has a gap of no more than `margin` (mm) and no more than half of the
/// contact's distance: the edges of flat plies on each other, h apart, then do not count.
inline bool within(const EdgeEdgeContact& contact, const EdgePair& pair, double margin) {
  return pair.side != 0 &&
         pair.distance <= contact.distance + std::min(margin, 0.5 * contact.distance);
}

/// Adds the forces (N) of one step, (N) of contact_law.hpp, to those of each sheet's nodes. dt: s,
/// the time step that led to these positions. path_length: mm, as of
/// contact/search/active_list.hpp.
void edge_forces(EdgeEdgeContact& contact, const SurfaceKinematics& a,
                 std::span<const SheetEdge> edges_a, const SurfaceKinematics& b,
                 std::span<const SheetEdge> edges_b, double dt, double path_length,
                 std::span<Vec3> force_a, std::span<Vec3> force_b);

/// Adds the row sums of the contact matrices, N/mm and N s/mm, to the rows of each sheet's nodes:
/// of pairs that are within(contact, pair, margin), margin in mm.
void add_edge_stiffness(const EdgeEdgeContact& contact, double margin, std::span<ContactRow> rows_a,
                        std::span<ContactRow> rows_b);

} // namespace plyform
