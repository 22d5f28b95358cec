// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/model/attachment.hpp"

#include "core/model/boundary.hpp"

#include <algorithm>

namespace plyform {
namespace {

/// Sets the shares of nodes on an edge: half the way to the neighbours on either side, mm. All to 1
/// if there is one node only.
void share_by_length(const HeldPlace& edge, std::span<const Vec3> x0,
                     std::vector<AttachedNode>& on) {
  const Vec2 along = (edge.ends[1] - edge.ends[0]).normalized();
  std::vector<std::pair<double, AttachedNode*>> order;
  for (AttachedNode& node : on)
    order.emplace_back(along.dot(x0[node.node].head<2>()), &node);
  std::sort(order.begin(), order.end());
  for (std::size_t i = 0; i + 1 < order.size(); ++i) {
    const double half = 0.5 * (order[i + 1].first - order[i].first);
    order[i].second->share += half;
    order[i + 1].second->share += half;
  }
  if (order.size() == 1) order[0].second->share = 1.0;
}

/// A third of the area of each triangle at a node, mm^2.
void share_by_area(const SheetBefore& ply, std::vector<AttachedNode>& in) {
  std::vector<double> area(ply.x0.size(), 0.0);
  for (const Triangle& t : ply.triangles) {
    const Vec3& a = ply.x0[t[0]];
    const double twice = (ply.x0[t[1]] - a).cross(ply.x0[t[2]] - a).norm();
    for (const int n : t)
      area[n] += twice / 6.0;
  }
  for (AttachedNode& node : in)
    node.share = area[node.node];
}

/// Adds the part of `axis` that is orthogonal to those in `held`.
void add_axis(std::vector<Vec3>& held, Vec3 axis) {
  for (const Vec3& taken : held)
    axis -= axis.dot(taken) * taken;
  constexpr double nothing_new = 1e-9;
  if (held.size() < 3 && axis.norm() > nothing_new) held.push_back(axis.normalized());
}

/// The directions in which a gripper cannot move: normals of the planes of symmetry that hold nodes
/// of it, and those at right angles to its guide.
std::vector<Vec3> held_directions(const std::vector<Boundary>& boundaries, const Gripper& gripper,
                                  const std::vector<AttachedNode>& nodes,
                                  const std::vector<SheetBefore>& plies) {
  std::vector<Vec3> held;
  for (const Boundary& b : boundaries) {
    const auto* plane = std::get_if<SymmetryPlane>(&b.kind);
    if (!plane) continue;
    if (std::any_of(nodes.begin(), nodes.end(), [&](const AttachedNode& n) {
          return holds(b, n.ply, plies[n.ply].x0[n.node].head<2>());
        }))
      add_axis(held, {plane->normal.x(), plane->normal.y(), 0.0});
  }
  if (!gripper.guided) return held;
  std::vector<Vec3> all{gripper.direction};
  for (const Vec3& axis : held)
    add_axis(all, axis);
  for (int k = 0; k < 3; ++k)
    add_axis(all, Vec3::Unit(k));
  all.erase(all.begin());
  return all;
}

} // namespace

Attachment attach(const std::vector<Boundary>& boundaries, std::size_t index,
                  const std::vector<SheetBefore>& plies) {
  const Boundary& b = boundaries[index];
  const HeldPlace& place = *place_of(b);
  Attachment found;
  found.boundary = static_cast<int>(index);
  double sum = 0.0;
  for (std::size_t p = 0; p < plies.size(); ++p) {
    const int ply = static_cast<int>(p);
    std::vector<AttachedNode> nodes;
    for (std::size_t n = 0; n < plies[p].x0.size(); ++n)
      if (holds(b, ply, plies[p].x0[n].head<2>())) nodes.push_back({ply, static_cast<int>(n), 0.0});
    if (place.on_edge)
      share_by_length(place, plies[p].x0, nodes);
    else
      share_by_area(plies[p], nodes);
    for (const AttachedNode& node : nodes)
      sum += node.share;
    found.nodes.insert(found.nodes.end(), nodes.begin(), nodes.end());
  }
  const double equal = 1.0 / static_cast<double>(found.nodes.size()); // of nodes without triangles
  for (AttachedNode& node : found.nodes) {
    node.share = sum > 0.0 ? node.share / sum : equal;
    found.start += node.share * plies[node.ply].x0[node.node];
  }
  if (const auto* gripper = std::get_if<Gripper>(&b.kind)) {
    found.held = held_directions(boundaries, *gripper, found.nodes, plies);
    return found;
  }
  const auto& spring = b.as<TensionSpring>();
  found.length = (spring.anchor - found.start).norm();
  found.natural_length =
      spring.natural_length.value_or(found.length - spring.preload / spring.stiffness);
  return found;
}

double spring_tension(const TensionSpring& spring, const Attachment& attached, double length,
                      double risen) {
  const double first =
      std::max(0.0, spring.stiffness * (attached.length - attached.natural_length));
  const double tension =
      spring.stiffness * (length - attached.natural_length) - (1.0 - risen) * first;
  return std::clamp(tension, 0.0, spring.max_force);
}

} // namespace plyform
