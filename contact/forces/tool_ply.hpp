// SPDX-License-Identifier: GPL-3.0-or-later
// Contact of one rigid tool with the plies: nodes against the tool's signed distance.
//
// A tool pushed by a force has one freedom, its displacement along `direction`. It is not stepped
// explicitly but brought into equilibrium every step,
//
//   M (delta/dt - v) / dt = F - R(delta)                                                    (B)
//
// R: reaction of the contacts, a monotone function of the motion delta of this step, with a pole
// where a contact has no room left. With M = 0 the plies feel exactly F at every moment and the
// tool cannot bounce. Removing a freedom by its own equilibrium never raises the largest frequency,
// so the stable step stays.
#pragma once

#include "contact/forces/contact_law.hpp"
#include "contact/search/active_list.hpp"
#include "contact/shapes/tool_shape.hpp"
#include "contact/stopwatch.hpp"

#include <span>
#include <vector>

namespace plyform {

/// Where a rigid tool is and how it moves.
struct ToolBody {
  ToolShape shape;
  Vec3 position = Vec3::Zero();                           ///< mm, of the tool frame at the start
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity(); ///< tool frame to space
  Vec3 displacement = Vec3::Zero();                       ///< mm, since the start
  Vec3 motion = Vec3::Zero();                             ///< mm, of the last step
  // for a tool pushed by a force:
  bool force_controlled = false;
  Vec3 direction = Vec3::Zero();
  double force = 0.0;              ///< N
  double mass = 0.0;               ///< t; 0: in equilibrium at every step
  double speed = 0.0;              ///< mm/s along direction
  double max_approach_speed = 0.0; ///< mm/s, closing speed while it meets no resistance
};

/// Its normal as a vector of Eigen, which the point itself must not know.
inline Eigen::Map<Vec3> normal_of(ToolPlyPoint& point) {
  return Eigen::Map<Vec3>(point.normal);
}
inline Eigen::Map<const Vec3> normal_of(const ToolPlyPoint& point) {
  return Eigen::Map<const Vec3>(point.normal);
}

/// mm, gap of this step; of an inactive point: when it was deactivated.
inline double latest_gap(const ToolPlyPoint& point) {
  return std::isinf(point.gap) ? point.last_gap : point.gap;
}

/// A tool against one ply. `points` hold the nodes within reach, ascending.
struct ToolPlyContact {
  ContactLaw law;
  double half_thickness = 0.0; ///< mm, of the ply
  std::vector<ToolPlyPoint> points;
  ActiveList list;         ///< of the points
  std::vector<float> free; ///< mm, one a node of the ply: path before which it cannot touch
  std::vector<Vec3> force; ///< one a node of the ply, N; zero where there is no point. Empty: none
  ContactTotals sums;
  double renew_depth = 0.0; ///< mm, penetration at which the stable step is due again
  ContactTime time;         ///< without the balance of a pushed tool, which all its plies share
};

/// A ply as contact sees it: spans of n nodes.
struct SurfaceKinematics {
  std::span<const Vec3> x;      ///< mm
  std::span<const Vec3> motion; ///< mm, displacement in the last step
  std::span<const double> area; ///< mm^2
  std::span<const double>
      fold_bound; ///< of faces (contact/search/fold_bound.hpp); empty: not known
};

/// Signed distance (mm) and normal, in space, of a tool where it stands now.
SurfacePoint distance_to_tool(const ToolBody& tool, const Vec3& x, int& hint);

/// Updates the points: every node that may have a gap <= reach (mm). Contacts keep their memory.
/// path_length: as paths[i] of tool_ply_forces; nodes that were too far off, when last measured, to
/// be near by now are not measured again.
void find_tool_ply_points(ToolPlyContact& contact, const ToolBody& tool,
                          const SurfaceKinematics& ply, double reach, double path_length);

/// Forces of one step of one tool on all its plies; contacts[i] is with plies[i]. dt: the step
/// that led to these positions, s. paths[i]: mm, of ply i and the tool
/// (contact/search/active_list.hpp), the tool's own motion in this call included. For a pushed tool
/// also moves it by (B), limited to dt * max_approach_speed. Returns the force (N) of the plies on
/// the tool.
Vec3 tool_ply_forces(ToolBody& tool, std::span<ToolPlyContact> contacts,
                     std::span<const SurfaceKinematics> plies, std::span<const double> paths,
                     double dt);

/// Adds each contact to rows[node]: row sums of the contact matrices. Of contacts that touch or
/// were within `margin` (mm) of it when last looked at.
void add_tool_ply_stiffness(const ToolPlyContact& contact, std::span<const double> area,
                            double margin, std::span<ContactRow> rows);

} // namespace plyform
