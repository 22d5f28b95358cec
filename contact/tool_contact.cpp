// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/tool_contact.hpp"

#include <limits>

namespace plyform {
namespace {

double area_of(const SheetState& ply, const ToolContactPoint& c) {
  return ply.area[static_cast<std::size_t>(c.node)];
}

void lay_to_rest(ToolContactPoint& c) {
  if (!std::isinf(c.gap)) c.rested = c.gap;
  c.gap = std::numeric_limits<double>::infinity();
}

/// Lists the points that may touch; their gaps and normals where tool and ply stand now.
void measure(ToolContact& contact, const ToolBody& tool, const SheetState& ply, double path) {
  const Stopwatch watch(contact.time.forces);
  renew(contact.list, path,
        [&contact](std::int32_t i) { lay_to_rest(contact.points[static_cast<std::size_t>(i)]); });
  for (const std::int32_t i : contact.list.near) {
    ToolContactPoint& c = contact.points[static_cast<std::size_t>(i)];
    const auto n = static_cast<std::size_t>(c.node);
    const SurfacePoint s = distance_to_tool(tool, ply.x[n], c.hint);
    c.last_gap = c.gap;
    c.gap = s.distance - contact.half_thickness;
    c.normal = s.normal;
    if (std::isinf(c.last_gap)) // a pushed tool has not moved yet in this step
      c.last_gap =
          c.gap - c.normal.dot(tool.pushed ? ply.motion[n] : Vec3(ply.motion[n] - tool.motion));
    if (c.gap > 0.0) contact.list.wake[static_cast<std::size_t>(i)] = path + c.gap;
  }
}

/// Left side minus right side of (B) for a motion `delta`, N, and its slope, N/mm (both fall with
/// delta).
struct Residual {
  double value, slope;
};

Residual residual_of(const ToolBody& tool, std::span<ToolContact> contacts,
                     std::span<const SheetState> plies, double delta, double dt) {
  const double inertia = tool.mass / (dt * dt);
  Residual r{tool.force - inertia * (delta - tool.speed * dt), -inertia};
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const ContactLaw& law = contacts[i].law;
    const double rate = law.damping / dt;
    for (const std::int32_t k : contacts[i].list.near) {
      const ToolContactPoint& c = contacts[i].points[static_cast<std::size_t>(k)];
      const double facing = c.normal.dot(tool.direction);
      const double p = -c.gap + facing * delta;
      if (!(p > 0.0)) continue;
      const double area = area_of(plies[i], c);
      const double n = area * (law.stiffness * p + rate * (p + std::min(c.last_gap, 0.0))); // (N)
      if (!(n > 0.0)) continue;
      r.value -= facing * n;
      r.slope -= facing * facing * area * (law.stiffness + rate);
    }
  }
  return r;
}

/// Solves (B) for delta within what the closing speed allows: Newton's method inside a bracket,
/// halved where a step would leave it (contacts that begin make the residual jump).
double equilibrium_motion(const ToolBody& tool, std::span<ToolContact> contacts,
                          std::span<const SheetState> plies, double dt) {
  double high = tool.speed_limit * dt, low = -high;
  if (residual_of(tool, contacts, plies, high, dt).value >= 0.0) return high;
  if (residual_of(tool, contacts, plies, low, dt).value <= 0.0) return low;
  double delta = std::clamp(tool.speed * dt, 0.5 * low, 0.5 * high);
  constexpr int most_rounds = 60; // the bracket is then at rounding; 3 to 6 rounds are usual
  for (int round = 0; round < most_rounds; ++round) {
    const Residual r = residual_of(tool, contacts, plies, delta, dt);
    if (std::abs(r.value) <= 1e-9 * std::abs(tool.force)) break;
    (r.value > 0.0 ? low : high) = delta;
    const double newton = r.slope < 0.0 ? delta - r.value / r.slope : high;
    delta = newton > low && newton < high ? newton : 0.5 * (low + high);
  }
  return delta;
}

Vec3 contact_forces(ToolContact& contact, const SheetState& ply, const Vec3& tool_motion,
                    double dt) {
  const Stopwatch watch(contact.time.forces);
  Vec3 on_tool = Vec3::Zero();
  contact.sums.elastic = 0.0;
  contact.sums.penetration = 0.0;
  contact.sums.touching = 0;
  for (const std::int32_t k : contact.list.near) {
    ToolContactPoint& c = contact.points[static_cast<std::size_t>(k)];
    const auto n = static_cast<std::size_t>(c.node);
    Vec3& f = contact.force[n];
    f.setZero();
    const double p = -c.gap, dp = c.last_gap - c.gap, area = ply.area[n];
    if (!(p > 0.0)) {
      contact.sums.damping += 0.5 * c.memory.damping_force * dp; // the trapezoid's last half
      c.memory.damping_force = 0.0;
      release(contact.law, area, c.memory, contact.sums);
      continue;
    }
    const NormalForce normal =
        normal_force(contact.law, area, p, p + std::min(c.last_gap, 0.0), dt);
    contact.sums.damping += 0.5 * (normal.damping + c.memory.damping_force) * dp;
    c.memory.damping_force = normal.damping;
    c.memory.normal_force = normal.total;
    f = normal.total * c.normal + friction_force(contact.law, area, normal.total, c.normal,
                                                 ply.motion[n] - tool_motion, c.memory,
                                                 contact.sums);
    on_tool -= f;
    contact.sums.elastic += spring_energy(contact.law, area, p, c.memory);
    contact.sums.penetration = std::max(contact.sums.penetration, p);
    ++contact.sums.touching;
  }
  contact.sums.deepest = std::max(contact.sums.deepest, contact.sums.penetration);
  return on_tool;
}

} // namespace

SurfacePoint distance_to_tool(const ToolBody& tool, const Vec3& x, int& hint) {
  const Vec3 local = tool.rotation.transpose() * (x - tool.position - tool.displacement);
  SurfacePoint s = signed_distance(tool.shape, local, hint);
  s.normal = tool.rotation * s.normal;
  return s;
}

void find_tool_points(ToolContact& contact, const ToolBody& tool, const SheetState& ply,
                      double reach, double path) {
  const Stopwatch watch(contact.time.search);
  std::vector<ToolContactPoint> old = std::move(contact.points);
  const std::vector<double> old_wake = std::move(contact.list.wake);
  contact.points.clear();
  clear(contact.list);
  contact.force.assign(ply.x.size(), Vec3::Zero());
  contact.free.resize(ply.x.size(), -std::numeric_limits<float>::infinity());
  std::size_t next_old = 0;
  for (std::size_t n = 0; n < ply.x.size(); ++n) {
    const bool known = next_old < old.size() && old[next_old].node == static_cast<int>(n);
    double gap = (known ? old_wake[next_old] : static_cast<double>(contact.free[n])) - path;
    ToolContactPoint point{};
    point.node = static_cast<int>(n);
    if (known) point = old[next_old++];
    const bool touched = known && point.gap < 0.0; // it may have a spring to give back
    if (touched || (!known && gap <= reach)) {
      const SurfacePoint at = distance_to_tool(tool, ply.x[n], point.hint);
      gap = at.distance - contact.half_thickness;
      point.normal = at.normal;
    }
    constexpr double below = 1.0 - 1e-6; // that rounding does not raise it
    contact.free[n] = static_cast<float>(below * (path + gap));
    if (gap > reach) {
      if (touched) release(contact.law, ply.area[n], point.memory, contact.sums);
      continue;
    }
    if (!touched) {
      if (!known || !std::isinf(point.gap)) point.gap = gap;
      lay_to_rest(point);
    }
    contact.points.push_back(point);
    contact.list.wake.push_back(touched ? std::min(path, path + gap) : path + gap);
  }
}

Vec3 tool_forces(ToolBody& tool, std::span<ToolContact> contacts, std::span<const SheetState> plies,
                 std::span<const double> paths, double dt) {
  for (std::size_t i = 0; i < contacts.size(); ++i)
    measure(contacts[i], tool, plies[i], paths[i]);
  if (tool.pushed && dt > 0.0) {
    const double delta = equilibrium_motion(tool, contacts, plies, dt);
    tool.speed = delta / dt;
    tool.motion = delta * tool.direction;
    tool.displacement += tool.motion;
    for (ToolContact& contact : contacts)
      for (const std::int32_t k : contact.list.near) {
        ToolContactPoint& c = contact.points[static_cast<std::size_t>(k)];
        c.gap -= c.normal.dot(tool.direction) * delta;
      }
  }
  Vec3 on_tool = Vec3::Zero();
  for (std::size_t i = 0; i < contacts.size(); ++i)
    on_tool += contact_forces(contacts[i], plies[i], tool.motion, dt);
  return on_tool;
}

void add_tool_stiffness(const ToolContact& contact, std::span<const double> area, double margin,
                        std::span<double> rows) {
  for (const ToolContactPoint& c : contact.points) {
    if (c.latest_gap() > margin) continue;
    const auto n = static_cast<std::size_t>(c.node);
    rows[n] += area[n] * contact.law.stiffness;
  }
}

} // namespace plyform
