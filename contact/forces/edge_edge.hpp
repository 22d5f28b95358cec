// SPDX-License-Identifier: GPL-3.0-or-later
// The edges of two plies against each other, or of a ply against its own.
//
// Node-to-face contact keeps every node no less than h - delta_n from the other sheet (delta_n: its
// depth limit, h/4). Between its nodes a straight edge can still come closer, but only where both
// sheets are folded there: over a flat part of one sheet a segment whose ends stay away stays away.
// Contact of edges begins at h/2, since on smoothly curved stacks they are a little closer than h
// by construction, and ends, without limit, at h/4. All edges are looked at, whatever their fold:
// folds grow between two searches.
//
//   y_a = (1-s) x_1 + s x_2,  y_b = (1-t) x_3 + t x_4   closest points of the two edges, inside
//   d = side * |y_a - y_b|,  negative once the edges have crossed;  p = h/2 - d
//   energy and force by contact_law.hpp, along +-n as in (S) of ply_ply.hpp
//
// No friction here: the nodes around carry it.
#pragma once

#include "contact/forces/contact_law.hpp"
#include "contact/forces/tool_ply.hpp"
#include "contact/search/active_list.hpp"

#include <span>
#include <vector>

namespace plyform {

/// An edge of a sheet: its nodes, and whether it has a triangle on one side only.
struct SheetEdge {
  std::int32_t a, b;
  bool rim;
};

/// All edges of a sheet, in ascending order of their nodes. Non-manifold edges are given once for
/// each further triangle.
std::vector<SheetEdge> sheet_edges(std::span<const Triangle> triangles);

/// The nodes of an edge.
struct EdgeNodes {
  std::int32_t a, b;
};

/// One pair of edges that may touch.
struct EdgePair {
  std::array<std::int32_t, 2> edge{}; ///< its numbers
  EdgeNodes a, b;
  int side = 0;          ///< orientation since the closest points are inside both; 0: they are not
  double area = 0.0;     ///< mm^2
  double distance = 0.0; ///< mm, signed; twice the contact's where side is 0
  double s = 0.0, t = 0.0;
};

/// Edges of a sheet, and which of them to look at, ascending.
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
  double renew_depth = 0.0; ///< mm, penetration at which the stable step is due again
  ContactTotals sums;
  ContactTime time;
};

/// A sheet with itself: edges that are nearer than `apart` (mm) in the unformed sheet, with nodes
/// at x0, are neighbours in any fold and no pair; and each pair is listed once.
struct SelfEdges {
  std::span<const Vec3> x0; ///< empty: two sheets
  double apart = 0.0;
};

/// Renews the candidates: pairs of edges within distance + skin. path: mm,
/// as of contact/search/active_list.hpp.
void find_edge_pairs(EdgeEdgeContact& contact, const SurfaceKinematics& a, const EdgeSet& edges_a,
                     const SurfaceKinematics& b, const EdgeSet& edges_b, double skin,
                     double path_length, const SelfEdges& self = {});

/// mm, of two edges wherever their closest points are.
double edge_distance(const EdgeNodes& edge_a, std::span<const Vec3> a, const EdgeNodes& edge_b,
                     std::span<const Vec3> b);

/// Whether a pair touches or is within `margin` (mm) of it, but no more than half of its distance:
/// edges of flat plies on each other are as far apart as they should be.
inline bool within(const EdgeEdgeContact& contact, const EdgePair& pair, double margin) {
  return pair.side != 0 &&
         pair.distance <= contact.distance + std::min(margin, 0.5 * contact.distance);
}

/// Adds the forces of one step to those of each sheet's nodes, N. dt: the step that led to these
/// positions, s. path: mm, as of contact/search/active_list.hpp.
void edge_forces(EdgeEdgeContact& contact, const SurfaceKinematics& a,
                 std::span<const SheetEdge> edges_a, const SurfaceKinematics& b,
                 std::span<const SheetEdge> edges_b, double dt, double path_length,
                 std::span<Vec3> force_a, std::span<Vec3> force_b);

/// Row sums of the contact matrices, of pairs that touch or are within `margin` (mm) of it.
void add_edge_stiffness(const EdgeEdgeContact& contact, double margin, std::span<ContactRow> rows_a,
                        std::span<ContactRow> rows_b);

} // namespace plyform
