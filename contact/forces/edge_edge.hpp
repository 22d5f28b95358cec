// SPDX-License-Identifier: GPL-3.0-or-later
// Edge-edge contact between two plies, or of a ply with itself.
//
// Node-to-face contact keeps every node no less than h - delta_n from the other sheet (delta_n: its
// depth limit, h/4). Between its nodes a straight edge can still come closer, but only where both
// sheets are folded: over a flat part of one sheet, all of a segment is as far away as its ends.
// Edge contact begins at h/2, since on smoothly curved stacks edges are a little closer than h by
// construction, and its force becomes infinite at h/4. Searched are therefore ridges of one
// sheet towards ridges of the other (contact/search/sheet_ridges.hpp).
//
//   y_a = (1-s) x_1 + s x_2,  y_b = (1-t) x_3 + t x_4   closest points of the two edges, inside
//   d = side * |y_a - y_b|,  negative once the edges have crossed;  p = h/2 - d
//   energy and force by contact_law.hpp, along +-n as in (S) of ply_ply.hpp
//
// Edge-edge contact has no friction: node-to-face contacts of the nodes around carry it.
#pragma once

#include "base/stopwatch.hpp"
#include "contact/forces/contact_law.hpp"
#include "contact/search/sheet_ridges.hpp"
#include "contact/simd/edge_edge_kernel.hpp"
#include "contact/surface_kinematics.hpp"

#include <span>
#include <vector>

namespace plyform {

/// The nodes of an edge.
struct EdgeNodes {
  std::int32_t a, b;
};

/// Two edges that the search found close to each other.
struct EdgeCandidate {
  std::array<std::int32_t, 2> edge{}; ///< numbers of the two edges
  float free_until = 0.0F;            ///< mm, path length of its group before which it cannot touch
};

/// Candidates of the edges of one patch of each sheet, a range of EdgeEdgeContact::candidates.
struct EdgeGroup {
  std::array<std::int32_t, 2> patch{};
  std::int32_t first = 0, end = 0;
  /// mm, sum over the steps since the search of the largest relative displacement of a node of one
  /// patch and one of the other: what contact/search/active_list.hpp calls a path length
  double path_length = 0.0;
  double ahead = 0.0;      ///< mm, path length for which candidates are measured ahead of it
  double free_until = 0.0; ///< mm, smallest of its candidates
};

/// A candidate that may touch soon and is measured at every step.
struct EdgePair {
  std::int32_t candidate = 0; ///< its number
  EdgeNodes a, b;
  int side = 0;          ///< orientation when the closest points became interior to both; 0: not so
  double area = 0.0;     ///< mm^2, tributary area of the contact
  double distance = 0.0; ///< mm, d, signed; twice the contact's distance if side is 0
  double s = 0.0, t = 0.0;
};

/// What is measured in a step; kept only to spare allocations.
struct EdgeMeasurements {
  std::vector<std::array<std::int32_t, 2>> due; ///< numbers of candidates and of their groups
  std::vector<std::array<std::int32_t, 4>> nodes;
  std::vector<EdgeEdgeDistance> distances;
  std::vector<EdgePair> last; ///< EdgeEdgeContact::pairs of the step before
};

struct EdgeEdgeContact {
  ContactLaw law;                        ///< stiffness and damping per area; friction is not used
  double distance = 0.0;                 ///< h/2, mm
  std::vector<EdgeCandidate> candidates; ///< by groups, in each in ascending order of their edges
  std::vector<EdgeGroup> groups; ///< in ascending order of their patches, none without candidates
  std::vector<EdgePair> pairs;   ///< in ascending order of their candidates
  double renew_depth = 0.0; ///< mm, penetration at which the stable time step is computed again
  ContactTotals sums;
  ContactTime time;
  EdgeMeasurements measurements;
};

/// For checkpoints: base/archive.hpp.
template <class F>
void each_member(EdgeEdgeContact& c, F&& f) {
  auto& [law, distance, candidates, groups, pairs, renew_depth, sums, time, measurements] = c;
  f("candidates", candidates);
  f("groups", groups);
  f("pairs", pairs);
  f("renew_depth", renew_depth);
  f("sums", sums);
}

/// A sheet whose edges are in contact.
struct EdgeSheet {
  SurfaceKinematics state;
  const SheetEdges& edges;
  std::span<const Box3> patch_motion; ///< mm, as of patch_motions, of the last step
  /// SheetRidges::sides; empty: all edges count as ridges towards both sides
  std::span<const char> ridge_sides = {};
};

/// Self-contact of a sheet: edges that share a node or are closer than `apart` (mm) in the
/// undeformed sheet, with nodes at x0 (mm), are neighbours and form no pair; each pair is listed
/// once.
struct SelfEdges {
  std::span<const Vec3> x0; ///< empty: two sheets
  double apart = 0.0;
};

/// Searches the candidates anew: pairs of edges at a distance <= contact.distance + skin (mm) that
/// may be ridges towards each other, among the edges with the numbers some_a and some_b, ascending,
/// and those that are closed now. For self-contact a and b are the same sheet, and `self` is given.
void find_edge_pairs(EdgeEdgeContact& contact, const EdgeSheet& a,
                     std::span<const std::int32_t> some_a, const EdgeSheet& b,
                     std::span<const std::int32_t> some_b, double skin, const SelfEdges& self = {});

/// Adds the candidates that ridges have which are new since the last search: new_a and new_b,
/// ascending, those of them that are among some_a and some_b with all ridges of the other sheet.
/// The others stay as they are. Arguments as of find_edge_pairs.
void add_edge_pairs(EdgeEdgeContact& contact, const EdgeSheet& a,
                    std::span<const std::int32_t> some_a, std::span<const std::int32_t> new_a,
                    const EdgeSheet& b, std::span<const std::int32_t> some_b,
                    std::span<const std::int32_t> new_b, double skin, const SelfEdges& self = {});

/// Distance (mm) of two edges as segments, one by one. a, b: positions of the nodes of their
/// sheets, mm.
double edge_distance(const EdgeNodes& edge_a, std::span<const Vec3> a, const EdgeNodes& edge_b,
                     std::span<const Vec3> b);

/// Whether a pair is closed or has a gap of no more than `margin` (mm) and no more than half of the
/// contact's distance: the edges of flat plies on each other, h apart, then do not count.
inline bool within(const EdgeEdgeContact& contact, const EdgePair& pair, double margin) {
  return pair.side != 0 &&
         pair.distance <= contact.distance + std::min(margin, 0.5 * contact.distance);
}

/// Measures pairs of edges, four at a time. nodes: of the edge of a, and of that of b. a, b:
/// positions of the nodes of their sheets, mm.
void measure_edges(std::span<const std::array<std::int32_t, 4>> nodes, std::span<const Vec3> a,
                   std::span<const Vec3> b, std::vector<EdgeEdgeDistance>& distances);

/// Adds the forces (N) of one step, (N) of contact_law.hpp, to those of each sheet's nodes. dt: s,
/// the time step that led to these positions.
void edge_forces(EdgeEdgeContact& contact, const EdgeSheet& a, const EdgeSheet& b, double dt,
                 std::span<Vec3> force_a, std::span<Vec3> force_b);

/// Adds the row sums of the contact matrices, N/mm and N s/mm, to the rows of each sheet's nodes:
/// of pairs that are within(contact, pair, margin), margin in mm.
void add_edge_stiffness(const EdgeEdgeContact& contact, double margin, std::span<ContactRow> rows_a,
                        std::span<ContactRow> rows_b);

} // namespace plyform
