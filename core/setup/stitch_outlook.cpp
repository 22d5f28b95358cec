// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/setup/stitch_outlook.hpp"

#include "base/format.hpp"
#include "base/text.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace plyform {
namespace {

constexpr double furthest = 80.0 * degree; // of shear

/// (L).
double stretch_at(const Fabric& fabric, const Stitch& stitch, double gamma) {
  const MaterialAxes axes = material_axes(fabric);
  const Vec2 s = axes.components(stitch.angle);
  return std::sqrt(s.squaredNorm() + 2.0 * s.x() * s.y() * std::cos(axes.between() - gamma));
}

/// N/mm, energy per area of a sheet whose yarns keep their length.
double energy_at(const Fabric& fabric, double gamma) {
  double energy = 0.0;
  for (const Crossing& c : fabric.crossings)
    energy += cells_per_area(fabric, c) * c.shear.at(gamma).energy;
  for (const Stitch& s : fabric.stitches)
    energy += s.density * s.law.at(stretch_at(fabric, s, gamma) - 1.0).energy;
  if (!fabric.sheet) return energy;
  const MaterialAxes axes = material_axes(fabric);
  const double omega = axes.between() - gamma;
  const Vec2 across = axes.components(axes.first + 0.5 * std::numbers::pi);
  const Vec3 k1 = Vec3::UnitX(), k2(std::cos(omega), std::sin(omega), 0.0);
  return energy +
         std::visit(
             [&](const auto& law) { return law.at(k1, across.x() * k1 + across.y() * k2).energy; },
             *fabric.sheet);
}

/// N/mm, torque per area.
double torque_at(const Fabric& fabric, double gamma) {
  constexpr double h = 1e-5; // rad
  return (energy_at(fabric, gamma + h) - energy_at(fabric, gamma - h)) / (2.0 * h);
}

std::string degrees_of(double angle) {
  return fmt::format("{:.3g} degrees", angle / degree);
}

/// Whether two families of yarns can shear.
bool has_two(const Fabric& fabric) {
  const double second = material_axes(fabric).second;
  return std::any_of(fabric.families.begin(), fabric.families.end(),
                     [&](const YarnFamily& family) { return family.angle == second; });
}

/// "taut from 12 degrees of shear on", "taut from a strain of 0.1 on, which shear does not reach".
std::string reach_of(const Fabric& fabric, const Stitch& stitch, double strain,
                     const std::string& what) {
  if (has_two(fabric)) {
    if (const auto gamma = shear_at_strain(fabric, stitch, strain))
      return fmt::format("{} {} of shear", what, degrees_of(*gamma));
    return fmt::format("{} a strain of {:.3g}, which shear does not bring about", what, strain);
  }
  return fmt::format("{} a strain of {:.3g}", what, strain);
}

} // namespace

std::optional<double> shear_at_strain(const Fabric& fabric, const Stitch& stitch, double strain) {
  const MaterialAxes axes = material_axes(fabric);
  const Vec2 s = axes.components(stitch.angle);
  const double both = 2.0 * s.x() * s.y(), length = 1.0 + strain;
  constexpr double parallel = 1e-6;
  if (std::abs(both) < parallel) return std::nullopt;
  const double cosine = (length * length - s.squaredNorm()) / both;
  if (!(std::abs(cosine) <= 1.0)) return std::nullopt;
  const double gamma = axes.between() - std::acos(cosine);
  if (std::abs(gamma) > furthest) return std::nullopt;
  return gamma;
}

double free_shear(const Fabric& fabric) {
  if (!has_pretension(fabric) || !has_two(fabric)) return 0.0;
  const double at_rest = torque_at(fabric, 0.0);
  constexpr double none = 1e-9; // N/mm: legs of a zigzag that balance each other
  if (std::abs(at_rest) < none) return 0.0;
  const double way = at_rest > 0.0 ? -1.0 : 1.0, step = 0.1 * degree;
  double before = 0.0, behind = step; // between which the balance is
  while (behind < furthest && torque_at(fabric, way * behind) * at_rest > 0.0)
    before = behind, behind += step;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (before + behind);
    (torque_at(fabric, way * middle) * at_rest > 0.0 ? before : behind) = middle;
  }
  return way * behind;
}

std::vector<std::string> describe_stitches(const Fabric& fabric) {
  std::vector<std::string> lines;
  for (const Stitch& s : fabric.stitches) {
    const double pull = s.law.at(0.0).value;
    std::string line = fmt::format("{}: {} at {:.4g} degrees, {:.3g} a mm: ", fabric.name, s.name,
                                   s.angle / degree, s.density);
    if (pull > 0.0)
      line += fmt::format("pulls by {:.3g} N each from the start, {}", pull,
                          reach_of(fabric, s, s.law.taut_at, "slack at"));
    else if (s.law.taut_at > 0.0)
      line += reach_of(fabric, s, s.law.taut_at, "taut from");
    else
      line += "taut from the start";
    const double breaks = s.law.breaking_strain();
    line += std::isfinite(breaks) ? fmt::format(", {}", reach_of(fabric, s, breaks, "breaks at"))
                                  : std::string(", does not break");
    lines.push_back(line);
  }
  constexpr double considerable = 1.0 * degree;
  if (const double alone = free_shear(fabric); std::abs(alone) > considerable)
    lines.push_back(fmt::format(
        "{}: the pre-tension of its stitches shears a ply that nothing holds by {}, where the "
        "laws of shear balance it; results count shear from the shape of the case",
        fabric.name, degrees_of(alone)));
  return lines;
}

std::vector<std::string> describe_stitches(const Case& data) {
  std::vector<std::string> lines;
  std::set<int> told;
  for (const Ply& ply : data.plies)
    if (told.insert(ply.fabric).second)
      for (std::string& line : describe_stitches(data.fabrics[at(ply.fabric)]))
        lines.push_back(std::move(line));
  return lines;
}

} // namespace plyform
