// SPDX-License-Identifier: GPL-3.0-or-later
// Node-to-face contact of two plies: nodes of the slave sheet against the faces of the master
// sheet. Computed in both directions with half the stiffness each (two-pass), so that neither sheet
// is preferred.
//
//   x_s  mm  slave node;  x_c = sum_j w_j x_j  mm  closest point of the master's faces
//   d = |x_s - x_c|,  n = (x_s - x_c)/d,  h = half the sum of both thicknesses,  p = h - d
//   E(p) and N(p) of contact_law.hpp;  F_s = N n,  F_j = -w_j F_s                            (S)
//
// (S) is the exact gradient of E: x_c minimises the distance, so the derivatives of the w_j drop
// out (envelope theorem). The distance to a polyhedral surface is continuous across edges and
// around the free edge of the sheet, and so is the force. The mid-surfaces stay about h apart, so
// the direction n is always well defined. Each point stores on which side of the face its node is;
// a node found on the other side is a fault that stops the run.
//
// Friction acts where the surfaces touch, away from the two mid-surfaces. Therefore slip is
// measured at the end of a rigid arm r = x_s - x_c that is fixed to the master's face and rotates
// with it, and the friction force on that arm loads the face with a couple:
//   slip of a step = tangential part of u_s - sum_j w_j u_j - turn x r                       (P)
//   F_s = T,  F_j = -w_j T + nodal forces of the couple -r x T on the face                   (M)
// The rotation `turn` and the nodal forces of a couple: face_rotation.hpp. (M) is work-conjugate to
// (P), its moments cancel, and two sheets that move as one rigid body do not slip.
//
// Where a vacuum of q (N/mm^2) presses the sheets on each other, contact that just touches bears
// it, and what is left of it pulls on what has opened by g = -p, with the stiffness k of both
// passes:
//   N -= b A q min(g / g_q, 1) min(2 - g / g_q, 1) for 0 < g < 2 g_q,  g_q = q_most / k     (V)
// A being the smaller area of node and face now, b is 1/2 of the larger one and 1 - A / (2 A_face)
// of the smaller, so that both passes come to q. What opens no further than g_q stays conservative,
// and nothing is pushed at rest, whatever the meshes, where pressures on nodes against forces at
// other nodes dent both. Beyond g_q air pushes on the nodes instead
// (core/solver/vacuum_contact.hpp). Friction feels what contact bears.
//
// A point keeps its face, without a search of the others, as long as none of them can be closer. A
// face found late would be closer than the one before, and each such change would add energy.
#pragma once

#include "base/stopwatch.hpp"
#include "contact/forces/contact_law.hpp"
#include "contact/search/active_list.hpp"
#include "contact/search/sheet_bvh.hpp"
#include "contact/surface_kinematics.hpp"

#include <span>
#include <vector>

namespace plyform {

/// Barycentric weights w_j of all three corners at the closest point.
inline std::array<double, 3> weights_of(const PlyPlyPoint& point) {
  return {1.0 - point.w[0] - point.w[1], point.w[0], point.w[1]};
}

/// Gap (mm) of the last step; for an inactive point that at which it was deactivated.
inline double latest_gap(const PlyPlyPoint& point) {
  return std::isinf(point.gap) ? double{point.gap_when_deactivated} : point.gap;
}

/// A node that got to the other side of a face or beyond the valid depth of the contact law: the
/// contact cannot be resolved, and the run stops.
struct ContactFault {
  int node = -1, face = -1;
  double distance = 0.0; ///< mm
};

struct PlyPlyContact {
  ContactLaw law;                   ///< with half of the pair's stiffness
  double distance = 0.0;            ///< h, mm, before forming
  double slave_share = 0.5;         ///< of it, of the slave's half
  bool thickness_follows = false;   ///< whether r of contact_law.hpp is asked for; else it is 1
  std::vector<PlyPlyPoint> points;  ///< ascending by node
  std::vector<std::int32_t> faces;  ///< faces of each point in turn, in ascending distance
  std::vector<float> face_distance; ///< mm, of faces[i] from the node at the last search, at most
  ActiveList list;                  ///< of the points
  double renew_depth = 0.0; ///< mm, penetration at which the stable time step is computed again
  std::vector<double> compacted; ///< mm, per slave node: greatest depth; of some laws only
  double vacuum_gap = 0.0;       ///< mm, g_q of (V); 0: there is no vacuum between the two
  /// N/mm^2, q of (V) in this step and in the one before
  double vacuum = 0.0, vacuum_before = 0.0;
  ContactTotals sums;
  ContactFault fault;
  ContactTime time;
};

/// r of contact/forces/contact_law.hpp at a point.
double thickness_ratio_at(const PlyPlyContact& contact, const PlyPlyPoint& point,
                          const SurfaceKinematics& slave, const SurfaceKinematics& master,
                          std::span<const Triangle> master_triangles);

/// For checkpoints: base/archive.hpp.
template <class F>
void each_member(PlyPlyPoint& point, F&& f) {
  auto& [memory, area, gap, w, other, gap_when_deactivated, node, face, first_face, end_face, side,
         by_angle, kept] = point;
  f("memory", memory);
  f("area", area);
  f("gap", gap);
  f("w", w);
  f("other", other);
  f("gap_when_deactivated", gap_when_deactivated);
  f("node", node);
  f("face", face);
  f("first_face", first_face);
  f("end_face", end_face);
  f("side", side);
  f("by_angle", by_angle);
  f("kept", kept);
}

template <class F>
void each_member(PlyPlyContact& c, F&& f) {
  auto& [law, distance, slave_share, thickness_follows, points, faces, face_distance, list,
         renew_depth, compacted, vacuum_gap, vacuum, vacuum_before, sums, fault, time] = c;
  f("points", points);
  f("faces", faces);
  f("face_distance", face_distance);
  f("list", list);
  f("renew_depth", renew_depth);
  f("compacted", compacted);
  f("vacuum", vacuum);
  f("sums", sums);
}

/// Relative motion of two sheets, mm. max_displacement: upper bound of the displacement, since the
/// last search, of any node of one relative to any node of the other. path_length: as of
/// contact/search/active_list.hpp.
struct RelativeMotion {
  double max_displacement = 0.0, path_length = 0.0;
};

/// Updates the points from the candidates of the broad phase (sorted by node and face). Contacts
/// that persist keep their history; the energy of those that do not is released. path_length: mm,
/// as of RelativeMotion.
void find_ply_ply_points(PlyPlyContact& contact, std::span<const Candidate> candidates,
                         const SurfaceKinematics& slave, const SurfaceKinematics& master,
                         std::span<const Triangle> master_triangles, double path_length);

/// Adds the forces (N) of one step, (S), (N), (T) and (M), to those of each sheet's nodes. dt: s,
/// the time step that led to these positions. Points and faces that cannot have come close enough
/// since the last search, by the relative motion, are skipped. A fault is stored in contact.fault.
void ply_ply_forces(PlyPlyContact& contact, const SurfaceKinematics& slave,
                    const SurfaceKinematics& master, std::span<const Triangle> master_triangles,
                    double dt, const RelativeMotion& moved, std::span<Vec3> slave_force,
                    std::span<Vec3> master_force);

/// Unit normal n of a point. slave, master: the positions (mm) at which its forces were last
/// computed.
Vec3 contact_normal(const PlyPlyPoint& point, std::span<const Vec3> slave,
                    std::span<const Vec3> master, std::span<const Triangle> master_triangles);

/// Adds the row sums of the contact matrices, N/mm and N s/mm, to the rows of each sheet's nodes:
/// of contacts that are closed or whose last measured gap is <= margin (mm).
void add_ply_ply_stiffness(const PlyPlyContact& contact, const SurfaceKinematics& slave,
                           const SurfaceKinematics& master,
                           std::span<const Triangle> master_triangles, double margin,
                           std::span<ContactRow> slave_rows, std::span<ContactRow> master_rows);

} // namespace plyform
