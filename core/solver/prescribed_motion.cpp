// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/prescribed_motion.hpp"

#include "core/model/motion.hpp"
#include "core/solver/attached_motion.hpp"
#include "core/solver/nodal_forces.hpp"

namespace plyform {
namespace {

/// (R) of core/model/boundary.hpp for one node: the reaction that moves it to its prescribed
/// position at the end of the step. Adds to force, load and work of its boundaries.
void hold_node(Layup& layup, std::vector<BoundaryState>& boundaries, const PrescribedNode& held) {
  PlyBody& ply = layup.plies[held.ply];
  const auto n = static_cast<std::size_t>(held.node);
  const Vec3 before = ply.reaction[n];
  ply.reaction[n].setZero();
  const Vec3 free = acceleration(ply, held.node, mass_loads(layup.data));
  const double span = 0.5 * (layup.dt + layup.next_dt);
  Vec3 reaction = Vec3::Zero(), displacement = reaction, slope = reaction;
  int last = -1; // boundary of the axis before: mostly the same, its position is then reused
  for (std::size_t i = 0; i < static_cast<std::size_t>(held.count); ++i) {
    const Vec3& axis = held.axis[i];
    const auto b = static_cast<std::size_t>(held.boundary[i]);
    BoundaryState& state = boundaries[b];
    if (held.boundary[i] != last) {
      const Boundary& boundary = layup.data.boundaries[b];
      displacement = prescribed_position(boundary, ply.x0[n], state.next_displacement) - ply.x[n];
      slope = prescribed_slope(boundary, ply.x0[n], state.displacement);
      last = held.boundary[i];
    }
    const double wanted =
        (axis.dot(displacement) / layup.next_dt - axis.dot(ply.velocity[n])) / span;
    const Vec3 r = ply.mass[n] * (wanted - axis.dot(free)) * axis;
    reaction += r;
    state.force += r;
    state.load += r.dot(slope);
    state.work += 0.5 * axis.dot(before + r) * axis.dot(ply.motion[n]);
  }
  ply.reaction[n] = reaction;
}

} // namespace

void prescribe_nodes(BoundaryForces& of, Layup& layup) {
  const double duration = layup.data.solver.duration;
  for (std::size_t b = 0; b < of.boundaries.size(); ++b) {
    const Boundary& boundary = layup.data.boundaries[b];
    if (!prescribes(boundary)) continue;
    BoundaryState& state = of.boundaries[b];
    state.displacement = motion_at(boundary, layup.time, duration);
    state.next_displacement = motion_at(boundary, layup.time + layup.next_dt, duration);
    state.load = 0.0;
    state.force.setZero();
  }
  for (const PrescribedNode& held : of.held)
    hold_node(layup, of.boundaries, held);
  for (const Attachment& attached : of.attachments)
    if (layup.data.boundaries[attached.boundary].is<Gripper>())
      move_gripper(layup, attached, of.boundaries[attached.boundary]);
}

} // namespace plyform
