// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/forces/tool_ply.hpp"

#include "base/cpu_features.hpp"
#include "contact/forces/pushed_tool.hpp"
#include "contact/shapes/mesh_shape.hpp"
#include "contact/shapes/shape_distance.hpp"
#include "contact/simd/tool_ply_kernel.hpp"

#include <limits>

namespace plyform {
namespace {

void deactivate(ToolPlyPoint& c) {
  if (std::isinf(c.gap)) return;
  c.last_gap = c.gap;
  c.gap = std::numeric_limits<double>::infinity();
}

Vec3 to_tool_frame(const ToolBody& tool, const Vec3& x) {
  return tool.rotation.transpose() * (x - tool.position - tool.displacement);
}

/// Signed distance to a tool in its present position; to_shape(p, hint): to its shape, in the tool
/// frame.
template <class ToShape>
class Placed {
public:
  Placed(const ToolBody& tool, ToShape to_shape)
      : to_shape_(std::move(to_shape)), origin_(tool.position + tool.displacement),
        rotation_(tool.rotation), turned_(!tool.rotation.isIdentity(0.0)) {}

  SurfacePoint operator()(const Vec3& x, SurfaceHint& hint) const {
    const Vec3 from_origin = x - origin_;
    if (!turned_) return to_shape_(from_origin, hint);
    SurfacePoint s = to_shape_(rotation_.transpose() * from_origin, hint);
    s.normal = rotation_ * s.normal;
    return s;
  }

private:
  ToShape to_shape_;
  Vec3 origin_; ///< mm, of the tool frame
  Eigen::Matrix3d rotation_;
  bool turned_;
};

/// Calls use(distance), where distance(x, hint) is distance_to_tool with all that does not depend
/// on x computed once.
template <class Use>
void with_distance(const ToolBody& tool, const Use& use) {
  std::visit([&](const auto& shape) { use(Placed(tool, distance_of(shape))); }, tool.shape);
}

/// Numbers of some of a contact's points.
using Part = std::span<const std::int32_t>;

/// Calls work(part) for all active points in order, in parts that fit into the first-level cache.
template <class Work>
void in_parts(const ActiveList& list, const Work& work) {
  constexpr std::size_t most = 128;
  const Part all = list.active;
  for (std::size_t first = 0; first < all.size(); first += most)
    work(all.subspan(first, std::min(most, all.size() - first)));
}

/// mm, present one of the ply at a node.
double half_thickness_at(const ToolPlyContact& contact, const SurfaceKinematics& ply,
                         std::int32_t node) {
  return contact.half_thickness * thickness_ratio_at(contact, ply, node);
}

/// A lower bound (mm), by its hint, of the gap that a point has left until it touches.
double least_room_of(const ToolPlyContact& contact, const ToolBody& tool,
                     const SurfaceKinematics& ply, const ToolPlyPoint& point) {
  const SurfaceHint& hint = point.hint;
  if (hint.facet < 0) return NoRoom{}(0); // most tools are no meshes: spares the way to them
  const Vec3 at(hint.at[0], hint.at[1], hint.at[2]);
  const Vec3& x = ply.x[static_cast<std::size_t>(point.node)];
  return least_distance(hint, (to_tool_frame(tool, x) - at).norm()) -
         half_thickness_at(contact, ply, point.node) - contact.law.sliding_gap;
}

/// Activates the points that may touch, and deactivates the others.
void update_active(ToolPlyContact& contact, const ToolBody& tool, const SurfaceKinematics& ply,
                   double path_length) {
  const auto room = [&](std::int32_t i) {
    return least_room_of(contact, tool, ply, contact.points[static_cast<std::size_t>(i)]);
  };
  update(contact.list, path_length, 2.0 * contact.half_thickness, room,
         [&contact](std::int32_t i) { deactivate(contact.points[i]); });
}

/// Measures gaps and normals of the points in `part` at the present positions of tool and ply.
template <class Distance>
void measure(ToolPlyContact& contact, const ToolBody& tool, const SurfaceKinematics& ply,
             double path_length, Part part, const Distance& distance) {
  // A pushed tool has not moved yet in this step; tool.motion still is that of the step before.
  const Vec3 tool_motion = tool.force_controlled ? Vec3(Vec3::Zero()) : tool.motion;
  const MeshShapePtr* mesh = std::get_if<MeshShapePtr>(&tool.shape);
  constexpr std::size_t ahead = 6; // points: the time that a facet takes to arrive from memory
  for (std::size_t k = 0; k < part.size(); ++k) {
    if (mesh && k + ahead < part.size()) (*mesh)->prefetch(contact.points[part[k + ahead]].hint);
    const std::int32_t i = part[k];
    ToolPlyPoint& c = contact.points[i];
    const auto n = static_cast<std::size_t>(c.node);
    const SurfacePoint s = distance(ply.x[n], c.hint);
    const bool was_inactive = std::isinf(c.gap);
    c.last_gap = c.gap;
    c.gap = s.distance - half_thickness_at(contact, ply, c.node);
    normal_of(c) = s.normal;
    if (was_inactive) c.last_gap = c.gap - s.normal.dot(ply.motion[n] - tool_motion);
    if (const double room = c.gap - contact.law.sliding_gap; room > 0.0)
      contact.list.free_until[i] = path_length + room;
  }
}

/// Measures all active points of a pushed tool, which (B) needs before any force is computed.
void measure_all(ToolPlyContact& contact, const ToolBody& tool, const SurfaceKinematics& ply,
                 double path_length) {
  const Stopwatch watch(contact.time.forces);
  update_active(contact, tool, ply, path_length);
  if (contact.list.active.empty()) return;
  with_distance(tool, [&](const auto& distance) {
    measure(contact, tool, ply, path_length, contact.list.active, distance);
  });
}

/// Computes the forces of measured points. advance: displacement of the tool since they were
/// measured, mm. Returns the force on the tool, N.
Vec3 press(ToolPlyContact& contact, const ToolBody& tool, const SurfaceKinematics& ply,
           const Vec3& advance, double dt, Part part) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  ToolPlyKernelContact k{};
  static_cast<ContactKernelLaw&>(k) = kernel_law(contact.law, dt);
  k.points = contact.points.data();
  k.active = part.data();
  k.active_count = static_cast<int>(part.size());
  k.area = ply.area.data();
  k.motion = ply.motion.data()->data();
  k.force = contact.force.data()->data();
  Eigen::Map<Vec3>(k.tool_motion) = tool.motion;
  Eigen::Map<Vec3>(k.advance) = advance;
  k.thickness_ratio = contact.thickness_follows ? ply.thickness_ratio.data() : nullptr;
  k.compacted = contact.compacted.empty() ? nullptr : contact.compacted.data();
  if (contact.law.by_temperature() && tool.temperature && !ply.temperature.empty())
    k.celsius = ply.temperature.data(), k.tool_celsius = *tool.temperature;
  k.kept_at = contact.kept.data();
  std::optional<SlidingCall> call;
  if (contact.law.sliding) call.emplace(contact.law, dt);
  ask(k, call);
  const ToolPlyKernelTotals added =
      fastest(tool_ply_kernel_generic, tool_ply_kernel_avx2, tool_ply_kernel_avx512)(k);
  ContactTotals& sums = contact.sums;
  sums.elastic += added.elastic;
  sums.friction += added.friction;
  sums.damping += added.damping;
  sums.compaction += added.compaction;
  sums.penetration = std::max(sums.penetration, added.penetration);
  sums.deepest = std::max(sums.deepest, added.penetration);
  sums.slip = std::max(sums.slip, added.slip);
  sums.touching += added.touching;
  sums.step_ratio = std::min(sums.step_ratio, added.step_ratio);
  if (call) sums.sliding.add(call->seen);
  return -Vec3(added.on_nodes[0], added.on_nodes[1], added.on_nodes[2]);
}

/// Measures all points and computes their forces, part by part, for a tool that does not move by
/// (B). Returns the force on the tool, N.
Vec3 measure_and_press(ToolPlyContact& contact, const ToolBody& tool, const SurfaceKinematics& ply,
                       double path_length, double dt) {
  const Stopwatch watch(contact.time.forces);
  update_active(contact, tool, ply, path_length);
  clear_present(contact.sums);
  Vec3 on_tool = Vec3::Zero();
  if (contact.list.active.empty()) return on_tool;
  with_distance(tool, [&](const auto& distance) {
    in_parts(contact.list, [&](Part part) {
      measure(contact, tool, ply, path_length, part, distance);
      on_tool += press(contact, tool, ply, Vec3::Zero(), dt, part);
    });
  });
  return on_tool;
}

/// Moves a pushed tool, whose contacts have been measured, by (B) and computes the forces. Returns
/// the force on the tool, N.
Vec3 push_and_press(ToolBody& tool, std::span<ToolPlyContact> contacts,
                    std::span<const SurfaceKinematics> plies, double dt) {
  Vec3 advance = Vec3::Zero();
  if (dt > 0.0) {
    const double delta = equilibrium_motion(tool, contacts, plies, dt);
    tool.speed = delta / dt;
    advance = tool.motion = delta * tool.direction;
    tool.displacement += tool.motion;
  }
  Vec3 on_tool = Vec3::Zero();
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Stopwatch watch(contacts[i].time.forces);
    clear_present(contacts[i].sums);
    if (contacts[i].list.active.empty()) continue;
    on_tool += press(contacts[i], tool, plies[i], advance, dt, contacts[i].list.active);
  }
  return on_tool;
}

} // namespace

SurfacePoint distance_to_tool(const ToolBody& tool, const Vec3& x, SurfaceHint& hint) {
  const auto to_shape = [&](const Vec3& p, SurfaceHint& h) {
    return signed_distance(tool.shape, p, h);
  };
  return Placed(tool, to_shape)(x, hint);
}

void find_tool_ply_points(ToolPlyContact& contact, const ToolBody& tool,
                          const SurfaceKinematics& ply, double reach, double path_length) {
  const Stopwatch watch(contact.time.search);
  std::vector<ToolPlyPoint> old = std::move(contact.points);
  const std::vector<double> old_free_until = std::move(contact.list.free_until);
  contact.points.clear();
  clear(contact.list);
  contact.free.resize(ply.x.size(), -std::numeric_limits<float>::infinity());
  if (contact.law.unloading) contact.compacted.resize(ply.x.size(), 0.0);
  if (contact.law.keeps()) contact.kept.resize(ply.x.size(), 0.0);
  const bool is_mesh = std::holds_alternative<MeshShapePtr>(tool.shape);
  if (is_mesh) contact.hints.resize(ply.x.size());
  const double film = contact.law.sliding_gap;
  std::size_t next_old = 0;
  SurfaceHint near; // of the node before: a start for one of which nothing is known
  for (std::size_t n = 0; n < ply.x.size(); ++n) {
    const bool known = next_old < old.size() && old[next_old].node == static_cast<int>(n);
    const double free_until = known ? old_free_until[next_old] : double{contact.free[n]};
    double room = free_until - path_length; // the gap that is left until it touches
    ToolPlyPoint point{};
    point.node = static_cast<int>(n);
    if (known)
      point = old[next_old++];
    else if (is_mesh && room <= reach) {
      point.hint = contact.hints[n];
      room = std::max(room, least_room_of(contact, tool, ply, point));
    }
    const bool touched = known && point.gap < film; // its tangential spring may store energy
    if (touched || (!known && room <= reach)) {
      if (point.hint.facet < 0) point.hint = near;
      const SurfacePoint at = distance_to_tool(tool, ply.x[n], point.hint);
      near = point.hint;
      room = at.distance - half_thickness_at(contact, ply, point.node) - film;
      normal_of(point) = at.normal;
    }
    contact.free[n] = rounded_down(path_length + room);
    if (room > reach) {
      if (is_mesh && point.hint.facet >= 0) contact.hints[n] = point.hint;
      if (touched) release(contact.law, ply.area[n], point.memory, contact.sums);
      continue;
    }
    if (!touched) {
      if (!known || !std::isinf(point.gap)) point.gap = room + film;
      deactivate(point);
    }
    contact.points.push_back(point);
    contact.list.free_until.push_back(touched ? std::min(path_length, path_length + room)
                                              : path_length + room);
  }
  contact.force.assign(contact.points.empty() ? 0 : ply.x.size(), Vec3::Zero());
}

Vec3 tool_ply_forces(ToolBody& tool, std::span<ToolPlyContact> contacts,
                     std::span<const SurfaceKinematics> plies, std::span<const double> paths,
                     double dt) {
  Vec3 on_tool = Vec3::Zero();
  for (std::size_t i = 0; i < contacts.size(); ++i)
    if (tool.force_controlled)
      measure_all(contacts[i], tool, plies[i], paths[i]);
    else
      on_tool += measure_and_press(contacts[i], tool, plies[i], paths[i], dt);
  return tool.force_controlled ? push_and_press(tool, contacts, plies, dt) : on_tool;
}

void add_tool_ply_stiffness(const ToolPlyContact& contact, const SurfaceKinematics& ply,
                            double margin, std::span<ContactRow> rows) {
  for (const ToolPlyPoint& c : contact.points) {
    if (latest_gap(c) > margin + contact.law.sliding_gap) continue;
    const auto n = static_cast<std::size_t>(c.node);
    rows[n] +=
        ply.area[n] * row_of(contact.law, latest_gap(c), thickness_ratio_at(contact, ply, c.node));
  }
}

} // namespace plyform
