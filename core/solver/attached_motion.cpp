// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/attached_motion.hpp"

#include "core/model/motion.hpp"
#include "core/solver/force_kinds.hpp"
#include "core/solver/nodal_forces.hpp"

namespace plyform {
namespace {

const Boundary& boundary_of(const Layup& layup, const Attachment& attached) {
  return layup.data.boundaries[attached.boundary];
}

/// The spring's force on its nodes (F), added up, N.
Vec3 pull_of(const Layup& layup, const std::vector<ToolState>& tools, const Attachment& attached,
             BoundaryState& state) {
  const auto& spring = boundary_of(layup, attached).as<TensionSpring>();
  Vec3 way = spring.anchor;
  if (spring.carrier >= 0) way += tools[spring.carrier].body.displacement;
  for (const AttachedNode& node : attached.nodes)
    way -= node.share * layup.plies[node.ply].x[node.node];
  const double length = way.norm();
  state.displacement = length - attached.length;
  state.load =
      spring_tension(spring, attached, length, force_share(layup.time, layup.data.solver.duration));
  constexpr double no_direction = 1e-9; // mm
  if (length < no_direction) return Vec3::Zero();
  return state.load / length * way;
}

/// N, P of (G).
double pull_along(const Layup& layup, const Boundary& gripper, double gone) {
  const double now = motion_at(gripper, layup.time, layup.data.solver.duration);
  const double stiffness = gripper.as<Gripper>().stiffness;
  return stiffness > 0.0 ? stiffness * (now - gone) : now;
}

/// t, of a gripper and its nodes.
double whole_mass(const Layup& layup, const Attachment& clamp) {
  double mass = boundary_of(layup, clamp).as<Gripper>().mass;
  for (const AttachedNode& node : clamp.nodes)
    mass += layup.plies[node.ply].membrane.node_mass[node.node];
  return mass;
}

/// Part of node j in the mean place of what a spring or a drive moves, and the share of the
/// stiffness that acts there: of a gripper by mass, as it moves as one piece.
struct Stiff {
  double stiffness;          ///< N/mm
  std::vector<double> share; ///< sum 1
};

Stiff stiffness_of(const Layup& layup, const Attachment& attached) {
  const Boundary& b = boundary_of(layup, attached);
  if (b.is<TensionSpring>()) {
    Stiff of{b.as<TensionSpring>().stiffness, {}};
    for (const AttachedNode& node : attached.nodes)
      of.share.push_back(node.share);
    return of;
  }
  Stiff of{b.as<Gripper>().stiffness, {}};
  const double whole = whole_mass(layup, attached), nodes = whole - b.as<Gripper>().mass;
  for (const AttachedNode& node : attached.nodes)
    of.share.push_back(layup.plies[node.ply].membrane.node_mass[node.node] / nodes);
  of.stiffness *= nodes / whole; // so that omega^2 is k over the whole mass
  return of;
}

} // namespace

void pull_springs(BoundaryForces& of, Layup& layup, const std::vector<ToolState>& tools) {
  for (PlyBody& ply : layup.plies)
    std::fill(ply.pull.begin(), ply.pull.end(), Vec3::Zero());
  for (const Attachment& attached : of.attachments) {
    if (!boundary_of(layup, attached).is<TensionSpring>()) continue;
    BoundaryState& state = of.boundaries[attached.boundary];
    const Vec3 force = pull_of(layup, tools, attached, state);
    Vec3 motion = Vec3::Zero();
    for (const AttachedNode& node : attached.nodes) {
      PlyBody& ply = layup.plies[node.ply];
      ply.pull[node.node] += node.share * force;
      motion += node.share * ply.motion[node.node];
    }
    state.work += 0.5 * (state.force + force).dot(motion);
    state.force = force;
  }
}

void move_gripper(Layup& layup, const Attachment& clamp, BoundaryState& state) {
  const auto& gripper = boundary_of(layup, clamp).as<Gripper>();
  const MassLoads loads = mass_loads(layup.data);
  // All nodes have gone the same way at the same speed: the first one stands for the gripper.
  const AttachedNode& first = clamp.nodes.front();
  const PlyBody& of_first = layup.plies[first.ply];
  const Vec3 gone = of_first.x[first.node] - of_first.x0[first.node];
  const Vec3 velocity = of_first.velocity[first.node], motion = of_first.motion[first.node];
  state.displacement = gone.dot(gripper.direction);
  Vec3 sum = pull_along(layup, boundary_of(layup, clamp), state.displacement) * gripper.direction;
  double mass = gripper.mass;
  std::vector<Vec3> free;
  for (const AttachedNode& node : clamp.nodes) {
    PlyBody& ply = layup.plies[node.ply];
    ply.reaction[node.node].setZero();
    free.push_back(acceleration(ply, node.node, loads));
    sum += ply.mass[node.node] * free.back();
    mass += ply.mass[node.node];
  }
  Vec3 acceleration = sum / mass;
  for (const Vec3& axis : clamp.held)
    acceleration -= axis.dot(acceleration) * axis;
  const double span = 0.5 * (layup.dt + layup.next_dt);
  const Vec3 goes = gone + (velocity + span * acceleration) * layup.next_dt;
  Vec3 force = Vec3::Zero();
  for (std::size_t j = 0; j < clamp.nodes.size(); ++j) {
    const auto n = static_cast<std::size_t>(clamp.nodes[j].node);
    PlyBody& ply = layup.plies[clamp.nodes[j].ply];
    const Vec3 wanted = ((ply.x0[n] + goes - ply.x[n]) / layup.next_dt - ply.velocity[n]) / span;
    ply.reaction[n] = ply.mass[n] * (wanted - free[j]);
    force += ply.reaction[n];
  }
  state.work += 0.5 * (state.force + force).dot(motion);
  state.force = force;
  state.load = force.dot(gripper.direction);
}

void add_attachment_stiffness(const BoundaryForces& forces, const Layup& layup, std::size_t ply,
                              std::span<ContactRow> rows) {
  for (const Attachment& attached : forces.attachments) {
    const Stiff of = stiffness_of(layup, attached);
    for (std::size_t j = 0; j < of.share.size(); ++j)
      if (at(attached.nodes[j].ply) == ply)
        rows[at(attached.nodes[j].node)].stiffness += of.stiffness * of.share[j];
  }
}

void add_attachment_forces(const BoundaryForces& forces, const Layup& layup, double factor,
                           const std::vector<std::vector<Vec3>>& y,
                           std::vector<std::vector<Vec3>>& f) {
  for (const Attachment& attached : forces.attachments) {
    const Boundary& b = boundary_of(layup, attached);
    const Stiff of = stiffness_of(layup, attached);
    Vec3 mean = Vec3::Zero();
    for (std::size_t j = 0; j < of.share.size(); ++j)
      mean += of.share[j] * y[attached.nodes[j].ply][attached.nodes[j].node];
    if (const auto* gripper = std::get_if<Gripper>(&b.kind))
      mean = gripper->direction.dot(mean) * gripper->direction;
    for (std::size_t j = 0; j < of.share.size(); ++j)
      f[attached.nodes[j].ply][attached.nodes[j].node] +=
          factor * of.stiffness * of.share[j] * mean;
  }
}

} // namespace plyform
