// SPDX-License-Identifier: GPL-3.0-or-later
// Contact of two plies: nodes of the slave sheet against the faces of the master sheet. Run both
// ways, each with half the stiffness, so that neither sheet is preferred.
//
//   x_s  mm  slave node;  x_c = sum_j w_j x_j  mm  closest point of the master's faces
//   d = |x_s - x_c|,  n = (x_s - x_c)/d,  h = half the sum of both thicknesses,  p = h - d
//   E(p) and N(p) of contact_law.hpp;  F_s = N n,  F_j = -w_j F_s                            (S)
//
// (S) is the exact gradient of E: x_c minimises the distance, so the w_j do not count (envelope
// theorem). The distance to a polyhedral surface is continuous across edges, around the rim and
// while the node slides off it, and so is the force. The mid-surfaces stay about h apart, so the
// direction n is always well defined; which side the node is on is remembered, and a node found on
// the other side is a fault that stops the run.
//
// Friction acts where the surfaces touch, the thicknesses apart from the two mid-surfaces. So slip
// is measured, and a couple given, as if an arm r = x_s - x_c stood on the face and turned with it:
//   slip of a step = tangential part of u_s - sum_j w_j u_j - turn x r                       (P)
//   F_s = T,  F_j = -w_j T + those of the couple -r x T on the face                          (M)
// turn and the couple's forces: face_rotation.hpp. (M) does the work of T on (P); its moments
// cancel, and two sheets that move as one rigid body do not slip.
//
// A point keeps its face until it has slid by slide_limit since all its faces were searched, and
// meanwhile takes the closest point of that face alone, so that (S) and (M) stay exact for it. A
// face across an edge that has become closer is seen late, by no more than slide_limit times the
// fold between the two. The faces of all points are searched again when the sheets have gone
// full_search_interval, for folds change too.
#pragma once

#include "contact/forces/contact_law.hpp"
#include "contact/forces/tool_ply.hpp"
#include "contact/search/active_list.hpp"
#include "contact/search/sheet_bvh.hpp"

#include <span>
#include <vector>

namespace plyform {

/// Weights of all three corners at the closest point.
inline std::array<double, 3> weights_of(const PlyPlyPoint& point) {
  return {1.0 - point.w[0] - point.w[1], point.w[0], point.w[1]};
}

/// mm, gap of the last step; of an inactive point: when it was deactivated.
inline double latest_gap(const PlyPlyPoint& point) {
  return std::isinf(point.gap) ? double{point.gap_when_deactivated} : point.gap;
}

/// A node that got to the wrong side or as deep as contact has room: it cannot be resolved.
struct ContactFault {
  int node = -1, face = -1;
  double distance = 0.0; ///< mm
};

struct PlyPlyContact {
  ContactLaw law;                    ///< with half of the pair's stiffness
  double distance = 0.0;             ///< h, mm
  std::vector<PlyPlyPoint> points;   ///< ascending by node
  std::vector<std::int32_t> faces;   ///< of each point, nearest first
  std::vector<double> face_distance; ///< mm, when the search was done
  ActiveList list;                   ///< of the points
  double slide_limit = 0.0;          ///< mm, sliding up to which a point keeps its face; 0: none
  double full_search_interval = 0.0; ///< mm of path length between searches of all faces
  double last_full_search = 0.0;     ///< mm, path length at the last one
  double renew_depth = 0.0;          ///< mm, penetration at which the stable step is due again
  ContactTotals sums;
  ContactFault fault;
  ContactTime time;
};

/// How far two sheets have gone relative to each other, mm: since the search no node of one further
/// than max_displacement relative to any of the other; path_length as of
/// contact/search/active_list.hpp.
struct RelativeMotion {
  double max_displacement = 0.0, path_length = 0.0;
};

/// Updates the points from the broad phase's candidates (sorted by node and face). Contacts keep
/// their memory. path_length: mm, as of RelativeMotion.
void find_ply_ply_points(PlyPlyContact& contact, std::span<const Candidate> candidates,
                         const SurfaceKinematics& slave, const SurfaceKinematics& master,
                         std::span<const Triangle> master_triangles, double path_length);

/// Adds the forces of one step (S), (N), (T), (M) to those of each sheet's nodes, N. dt: the step
/// that led to these positions, s. Points and faces that the sheets have not gone far enough to
/// bring together are not looked at.
void ply_ply_forces(PlyPlyContact& contact, const SurfaceKinematics& slave,
                    const SurfaceKinematics& master, std::span<const Triangle> master_triangles,
                    double dt, const RelativeMotion& gone, std::span<Vec3> slave_force,
                    std::span<Vec3> master_force);

/// n of a point, from the positions that its last forces belong to.
Vec3 contact_normal(const PlyPlyPoint& point, std::span<const Vec3> slave,
                    std::span<const Vec3> master, std::span<const Triangle> master_triangles);

/// Row sums of the contact matrices added to each sheet's nodes: of contacts that touch or were
/// within `margin` (mm) of it when last looked at.
void add_ply_ply_stiffness(const PlyPlyContact& contact, const SurfaceKinematics& master,
                           std::span<const Triangle> master_triangles, double margin,
                           std::span<ContactRow> slave_rows, std::span<ContactRow> master_rows);

} // namespace plyform
