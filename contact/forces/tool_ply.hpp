// SPDX-License-Identifier: GPL-3.0-or-later
// Contact of one rigid tool with the plies: their nodes against the tool's signed distance.
//
// A tool pushed by a force has one degree of freedom, its displacement along `direction`. It is not
// integrated explicitly but brought into equilibrium in every step,
//
//   M (delta/dt - v) / dt = F - R(delta)                                                    (B)
//
// M: mass of the tool (t), v: its speed (mm/s), F: the prescribed force, R: reaction of the
// contacts (N), a monotone function of the displacement delta (mm) of this step, with a pole where
// a contact reaches its depth limit. With M = 0 the plies are loaded with exactly F at every time
// and the tool cannot bounce. Eliminating a degree of freedom by its own equilibrium (static
// condensation) never raises the largest frequency, so the stable time step is not reduced.
#pragma once

#include "base/stopwatch.hpp"
#include "contact/forces/contact_law.hpp"
#include "contact/search/active_list.hpp"
#include "contact/shapes/tool_shape.hpp"
#include "contact/surface_kinematics.hpp"

#include <span>
#include <vector>

namespace plyform {

/// How far a rigid tool has gone and how it moves.
struct ToolMotion {
  Vec3 displacement = Vec3::Zero(); ///< mm, since the start
  Vec3 motion = Vec3::Zero();       ///< mm, of the last step
  double force = 0.0;               ///< N, only for a tool pushed by a force; so speed
  double speed = 0.0;               ///< mm/s along its direction
};

/// For checkpoints: base/archive.hpp.
template <class F>
void each_member(ToolMotion& tool, F&& f) {
  auto& [displacement, motion, force, speed] = tool;
  f("displacement", displacement);
  f("motion", motion);
  f("force", force);
  f("speed", speed);
}

/// Where a rigid tool is and how it moves.
struct ToolBody : ToolMotion {
  ToolShape shape;
  Vec3 position = Vec3::Zero();                           ///< mm, of the tool frame at the start
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity(); ///< tool frame to space
  std::optional<double> temperature;                      ///< degC, now; nothing: not known
  // Only for a tool pushed by a force:
  bool force_controlled = false;
  Vec3 direction = Vec3::Zero();
  double mass = 0.0;               ///< t; 0: in equilibrium at every step
  double max_approach_speed = 0.0; ///< mm/s, limit of its speed, reached where nothing resists
};

/// The normal of a point as an Eigen vector; ToolPlyPoint itself must not depend on Eigen.
inline Eigen::Map<Vec3> normal_of(ToolPlyPoint& point) {
  return Eigen::Map<Vec3>(point.normal);
}
inline Eigen::Map<const Vec3> normal_of(const ToolPlyPoint& point) {
  return Eigen::Map<const Vec3>(point.normal);
}

/// Gap (mm) of the last step; for an inactive point that at which it was deactivated.
inline double latest_gap(const ToolPlyPoint& point) {
  return std::isinf(point.gap) ? point.last_gap : point.gap;
}

/// Contact of a tool with one ply. `points`: the nodes within reach, ascending.
struct ToolPlyContact {
  ContactLaw law;
  double half_thickness = 0.0;    ///< mm, of the ply before forming
  bool thickness_follows = false; ///< whether r of contact_law.hpp is asked for; else it is 1
  std::vector<ToolPlyPoint> points;
  ActiveList list;         ///< of the points
  std::vector<float> free; ///< mm, per node of the ply: path length before which it cannot touch
  std::vector<SurfaceHint>
      hints;                     ///< per node of the ply, of those without a point; mesh tools only
  std::vector<Vec3> force;       ///< N, per node of the ply; zero without a point. Empty: no points
  std::vector<double> compacted; ///< mm, per node of the ply: greatest depth; of some laws only
  std::vector<double> kept;      ///< SlidingPlace::kept per node of the ply; of some laws only
  ContactTotals sums;
  double renew_depth = 0.0; ///< mm, penetration at which the stable time step is computed again
  ContactTime time; ///< s, without the equilibrium of a pushed tool, which all its plies share
};

/// For checkpoints: base/archive.hpp.
template <class F>
void each_member(ToolPlyContact& c, F&& f) {
  auto& [law, half_thickness, thickness_follows, points, list, free, hints, force, compacted, kept,
         sums, renew_depth, time] = c;
  f("points", points);
  f("list", list);
  f("free", free);
  f("hints", hints);
  f("force", force);
  f("compacted", compacted);
  f("kept", kept);
  f("sums", sums);
  f("renew_depth", renew_depth);
}

/// r of contact_law.hpp of the ply at a node.
inline double thickness_ratio_at(const ToolPlyContact& contact, const SurfaceKinematics& ply,
                                 std::int32_t node) {
  return contact.thickness_follows ? ply.thickness_ratio[static_cast<std::size_t>(node)] : 1.0;
}

/// Signed distance (mm) and normal at x (mm), in the global frame, of a tool in its present
/// position. hint: as of signed_distance.
SurfacePoint distance_to_tool(const ToolBody& tool, const Vec3& x, SurfaceHint& hint);

/// Updates the points: every node that may have a gap <= reach (mm). Contacts that persist keep
/// their history. path_length: as paths[i] of tool_ply_forces; nodes that, by their gap when last
/// measured and the path length since, cannot be within reach are not measured.
void find_tool_ply_points(ToolPlyContact& contact, const ToolBody& tool,
                          const SurfaceKinematics& ply, double reach, double path_length);

/// Forces (N) and (T) of one step of one tool on all its plies, stored in contacts[i].force (N);
/// contacts[i] is with plies[i]. dt: s, the time step that led to these positions. paths[i]: mm,
/// path length of ply i and the tool (contact/search/active_list.hpp), the tool's own motion in
/// this call included. Also moves a pushed tool by (B), by no more than dt * max_approach_speed.
/// Returns the force (N) of the plies on the tool.
Vec3 tool_ply_forces(ToolBody& tool, std::span<ToolPlyContact> contacts,
                     std::span<const SurfaceKinematics> plies, std::span<const double> paths,
                     double dt);

/// Adds the row sums of the contact matrices, N/mm and N s/mm, to rows[node]: of contacts that are
/// closed or whose last measured gap is <= margin (mm).
void add_tool_ply_stiffness(const ToolPlyContact& contact, const SurfaceKinematics& ply,
                            double margin, std::span<ContactRow> rows);

} // namespace plyform
