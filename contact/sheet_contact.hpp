// SPDX-License-Identifier: GPL-3.0-or-later
// Contact of two plies: nodes of the slave sheet against the faces of the master sheet. Run both
// ways, each with half the stiffness, so that neither sheet is preferred.
//
//   x_s  mm  slave node;  x_c = sum_j w_j x_j  mm  closest point of the master's faces
//   d = |x_s - x_c|,  n = (x_s - x_c)/d,  h = half the sum of both thicknesses,  p = h - d
//   E = 1/2 A k p^2;  F_s = A k p n,  F_j = -w_j F_s                                         (S)
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
// turn and the couple's forces: face_turn.hpp. (M) does the work of T on (P); its moments cancel,
// and two sheets that move as one rigid body do not slip.
#pragma once

#include "contact/candidates.hpp"
#include "contact/contact_law.hpp"
#include "contact/tool_contact.hpp"

#include <span>
#include <vector>

namespace plyform {

/// One slave node and one connected patch of master faces near it (two patches: a fold). Laid out
/// in rows of 32 bytes, SheetKernelPoint (contact/sheet_kernel.hpp).
struct alignas(32) SheetContactPoint {
  ContactMemory memory;
  double area = 0.0;           ///< mm^2 that the contact stands for
  double gap = 0.0;            ///< mm, d - h when last looked at; infinite: not since the search
  std::array<double, 3> w{};   ///< weights of the closest point
  double slack = 0.0;          ///< mm, gap when the search was done
  Vec3 normal = Vec3::Zero();  ///< n
  double other = 0.0;          ///< mm, at the search, to the next face that shares no node with it
  std::int32_t node, face = 0; ///< closest face; of those that tie the first
  int side = 0;                ///< +1: on the side of the face normal, -1: other, 0: not known
  std::int32_t first_face, end_face; ///< range in SheetContact::faces
  std::array<std::int32_t, 3> unused{};
};

/// A node that got to the wrong side or deeper than half of h: the contact cannot be resolved.
struct ContactFault {
  int node = -1, face = -1;
  double distance = 0.0; ///< mm
};

struct SheetContact {
  ContactLaw law;                              ///< with half of the pair's stiffness
  double distance = 0.0;                       ///< h, mm
  std::vector<SheetContactPoint> points;       ///< ascending by node
  std::vector<std::int32_t> faces;             ///< of each point, nearest first
  std::vector<double> face_distance;           ///< mm, when the search was done
  std::vector<std::int32_t> near;              ///< points to look at: slack <= near_way
  double near_way = -1.0;                      ///< mm
  std::vector<Vec3> slave_force, master_force; ///< N, one a node of each sheet
  ContactSums sums;
  ContactFault fault;
  ContactTime time;
};

/// Renews the points from the broad phase's candidates (sorted by node and face). Contacts keep
/// their memory.
void find_sheet_points(SheetContact& contact, std::span<const Candidate> candidates,
                       const SheetState& slave, const SheetState& master,
                       std::span<const Triangle> master_triangles);

/// Forces of one step (S), (N), (T), (M). dt: the step that led to these positions, s. way: mm,
/// that no node of one sheet has moved further than, relative to any of the other, since the
/// search; points and faces that were further off than that cannot touch and are not looked at.
void sheet_forces(SheetContact& contact, const SheetState& slave, const SheetState& master,
                  std::span<const Triangle> master_triangles, double dt, double way);

/// Row sums of the contact stiffness matrix, N/mm, added to each sheet's nodes: of contacts that
/// touch or are, as far as is known, within `margin` (mm) of it.
void add_sheet_stiffness(const SheetContact& contact, const SheetState& master,
                         std::span<const Triangle> master_triangles, double margin,
                         std::span<double> slave_rows, std::span<double> master_rows);

} // namespace plyform
