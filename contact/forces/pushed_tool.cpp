// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/forces/pushed_tool.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace plyform {
namespace {

/// A point that may be closed by the displacement delta of (B), then at depth p = facing delta -
/// gap.
struct Pressed {
  double facing;    ///< normal . direction of the tool
  double gap;       ///< mm, before the motion
  double area;      ///< mm^2, A / r
  double viscous;   ///< N/mm, A c / (r^2 dt)
  double opened;    ///< mm, -p of the step before if it was closed then, else 0
  double thickness; ///< r
  double compacted; ///< mm, greatest depth before this step
  double per_depth; ///< 1/mm, 1 / delta
  const ContactLaw* law;

  /// (N) at a gap of -p, and its slope (K), N and N/mm.
  std::pair<double, double> force(double p) const {
    if (!(p > 0.0)) return {0.0, 0.0};
    const auto [elastic, slope] =
        law->loading ? on_curve(p / thickness) : on_barrier(p / thickness);
    const double n = elastic + viscous * (p + opened);
    if (!(n > 0.0)) return {0.0, 0.0};
    return {n, slope / thickness + viscous};
  }

  std::pair<double, double> on_curve(double depth) const {
    return {area * law->pressure(depth, compacted), area * law->tangent(depth)};
  }
  /// Spares the law's branches: most of a pushed tool's time.
  std::pair<double, double> on_barrier(double depth) const {
    const double u = depth * per_depth, u2 = u * u;
    const double per_room = 1.0 / std::max(1.0 - u2, least_remaining);
    const double rate = area * law->stiffness * per_room * per_room;
    return {rate * depth, rate * per_room * (1.0 + 3.0 * u2)};
  }
};

/// The points that a displacement of the tool of no more than `most` (mm) may close.
std::vector<Pressed> may_press(const ToolBody& tool, std::span<const ToolPlyContact> contacts,
                               std::span<const SurfaceKinematics> plies, double most, double dt) {
  std::vector<Pressed> pressed;
  std::size_t count = 0;
  for (const ToolPlyContact& contact : contacts)
    count += contact.list.active.size();
  pressed.reserve(count);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const ContactLaw& law = contacts[i].law;
    for (const std::int32_t k : contacts[i].list.active) {
      const ToolPlyPoint& c = contacts[i].points[k];
      const double facing = normal_of(c).dot(tool.direction);
      if (!(std::abs(facing) * most > c.gap)) continue;
      const double thickness = thickness_ratio_at(contacts[i], plies[i], c.node);
      const double area = plies[i].area[c.node] / thickness;
      pressed.push_back({facing, c.gap, area, area * law.damping / (thickness * dt),
                         std::min(c.last_gap, 0.0), thickness,
                         contacts[i].compacted.empty() ? 0.0 : contacts[i].compacted[c.node],
                         1.0 / law.max_depth, &law});
    }
  }
  return pressed;
}

/// Residual of (B), F - R(delta) - M (delta/dt - v) / dt, N, and its slope, N/mm (not positive).
struct Residual {
  double value, slope;
};

Residual residual_of(const ToolBody& tool, std::span<const Pressed> pressed, double delta,
                     double dt) {
  const double inertia = tool.mass / (dt * dt);
  Residual r{tool.force - inertia * (delta - tool.speed * dt), -inertia};
  for (const Pressed& c : pressed) {
    const auto [force, slope] = c.force(c.facing * delta - c.gap);
    r.value -= c.facing * force;
    r.slope -= c.facing * c.facing * slope;
  }
  return r;
}

/// Largest displacement (mm) towards `high` with which no point uses more than half of its
/// remaining depth.
double within_room(std::span<const Pressed> pressed, double high) {
  constexpr double share = 0.5;
  for (const Pressed& c : pressed) {
    const double depth = std::max(-c.gap, 0.0),
                 limit = (c.law->packed() + 1.0 / c.per_depth) * c.thickness;
    const double most = depth + share * std::max(limit - depth, 0.0) + c.gap;
    if (c.facing * high > most) high = most / c.facing;
  }
  return high;
}

} // namespace

// Newton's method inside a bracket, with bisection where a Newton step would leave it (contacts
// that close change the slope abruptly).
double equilibrium_motion(const ToolBody& tool, std::span<const ToolPlyContact> contacts,
                          std::span<const SurfaceKinematics> plies, double dt) {
  const double fastest = tool.max_approach_speed * dt;
  const std::vector<Pressed> pressed = may_press(tool, contacts, plies, fastest, dt);
  double high = within_room(pressed, fastest), low = within_room(pressed, -fastest);
  double delta = std::clamp(tool.speed * dt, 0.5 * low, 0.5 * high);
  bool high_known = false, low_known = false; // whether the root is known to lie below, above it
  // A Newton step squares the relative residual: the one from `nearly` ends below 1e-9.
  constexpr double nearly = 1e-5;
  constexpr int most_rounds = 60; // bisections down to rounding; 2 to 5 iterations are usual
  for (int round = 0; round < most_rounds; ++round) {
    const Residual r = residual_of(tool, pressed, delta, dt);
    if (std::abs(r.value) <= 1e-9 * std::abs(tool.force)) break;
    const bool further = r.value > 0.0;
    (further ? low : high) = delta;
    (further ? low_known : high_known) = true;
    const double newton = r.slope < 0.0 ? delta - r.value / r.slope : further ? high : low;
    if (newton > low && newton < high) {
      delta = newton;
      if (std::abs(r.value) <= nearly * std::abs(tool.force)) break;
      continue;
    }
    if (bool& known = further ? high_known : low_known; !known) {
      known = true;
      const double end = further ? high : low, left = residual_of(tool, pressed, end, dt).value;
      if (further ? left >= 0.0 : left <= 0.0) return end;
    }
    delta = 0.5 * (low + high);
  }
  return delta;
}

} // namespace plyform
