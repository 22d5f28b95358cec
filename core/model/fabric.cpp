// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/model/fabric.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plyform {
namespace {

constexpr double right_angle = 0.5 * std::numbers::pi;

/// Piecewise linear law through (x, y), both starting at 0, beyond the end with the last slope.
LawPoint on_table(const std::vector<double>& x, const std::vector<double>& y, double at) {
  LawPoint r{0.0, 0.0, 0.0};
  for (std::size_t i = 1; i < x.size(); ++i) {
    r.slope = (y[i] - y[i - 1]) / (x[i] - x[i - 1]);
    const bool last = i + 1 == x.size();
    const double end = last ? at : std::min(at, x[i]);
    const double dx = end - x[i - 1];
    r.value = y[i - 1] + r.slope * dx;
    r.energy += 0.5 * (y[i - 1] + r.value) * dx;
    if (at <= x[i]) break;
  }
  return r;
}

double steepest(const std::vector<double>& x, const std::vector<double>& y) {
  double slope = 0.0;
  for (std::size_t i = 1; i < x.size(); ++i)
    slope = std::max(slope, (y[i] - y[i - 1]) / (x[i] - x[i - 1]));
  return slope;
}

/// An odd law from its table for positive arguments.
LawPoint odd(const std::vector<double>& x, const std::vector<double>& y, double at) {
  const LawPoint r = on_table(x, y, std::abs(at));
  return {std::copysign(r.value, at), r.slope, r.energy};
}

/// Stiffness of a bending law whose families have the slopes slope_of(law).
template <class SlopeOf>
Eigen::Matrix3d stiffness_of(const BendingLaw& law, const SlopeOf& slope_of) {
  Eigen::Matrix3d d = Eigen::Matrix3d::Zero();
  for (const FamilyBending& family : law.families)
    d += slope_of(family.law) * (family.of_axes() * family.of_axes().transpose());
  d(0, 1) += law.coupling, d(1, 0) += law.coupling, d(2, 2) += law.twist;
  return d;
}

} // namespace

LawPoint TensionLaw::at(double eps) const {
  if (!(eps > 0.0)) {
    if (compression == 0.0) return {0.0, 0.0, 0.0};
    const LawPoint straight{compression * eps, compression, 0.5 * compression * eps * eps};
    if (!buckles()) return straight;
    const double beyond = std::max(0.0, -buckling_strain() - eps);
    const double less = (1.0 - buckled_share) * compression; // decrease of the slope there
    return {straight.value + less * beyond, beyond > 0.0 ? compression - less : compression,
            straight.energy - 0.5 * less * beyond * beyond};
  }
  if (strain.empty()) return {stiffness * eps, stiffness, 0.5 * stiffness * eps * eps};
  return on_table(strain, tension, eps);
}

double TensionLaw::strain_at(double force) const {
  if (strain.empty()) return force / stiffness;
  std::size_t i = 1; // the line on which it is
  while (i + 1 < strain.size() && tension[i] < force)
    ++i;
  const double slope = (tension[i] - tension[i - 1]) / (strain[i] - strain[i - 1]);
  if (slope > 0.0) return strain[i - 1] + (force - tension[i - 1]) / slope;
  return tension[i] < force ? std::numeric_limits<double>::infinity() : strain[i];
}

double TensionLaw::largest_slope() const {
  return strain.empty() ? stiffness : steepest(strain, tension);
}

double StitchLaw::breaking_strain() const {
  return taut_at + tension.strain_at(breaking_force);
}

double effective_softening(const TensionLaw& law, double asked) {
  return law.compression > 0.0 ? std::min(asked, law.largest_slope() / law.compression) : asked;
}

TensionLaw softened(TensionLaw law, double asked) {
  const double by = effective_softening(law, asked);
  law.stiffness /= by;
  for (double& n : law.tension)
    n /= by;
  return law;
}

LawPoint MomentLaw::at(double kappa) const {
  if (!curvature.empty()) return odd(curvature, moment, kappa);
  return {stiffness * kappa, stiffness, 0.5 * stiffness * kappa * kappa};
}

double MomentLaw::largest_slope() const {
  return curvature.empty() ? stiffness : steepest(curvature, moment);
}

bool BendingLaw::any() const {
  return twist > 0.0 || in_plane() ||
         std::any_of(families.begin(), families.end(),
                     [](const FamilyBending& f) { return f.law.largest_slope() > 0.0; });
}

bool BendingLaw::in_plane() const {
  return std::any_of(families.begin(), families.end(),
                     [](const FamilyBending& f) { return f.in_plane > 0.0; });
}

Eigen::Matrix3d BendingLaw::stiffness_at_rest() const {
  return stiffness_of(*this, [](const MomentLaw& m) { return m.at(0.0).slope; });
}

Eigen::Matrix3d BendingLaw::largest_stiffness() const {
  return stiffness_of(*this, [](const MomentLaw& m) { return m.largest_slope(); });
}

Vec2 MaterialAxes::components(double angle) const {
  if (angle == first) return Vec2::UnitX(); // exactly
  if (angle == second) return Vec2::UnitY();
  const double of_second = std::sin(angle - first) / std::sin(between());
  return {std::cos(angle - first) - of_second * std::cos(between()), of_second};
}

Fabric woven_fabric() {
  Fabric fabric;
  fabric.families.resize(2);
  fabric.families[0].name = "warp";
  fabric.families[1].name = "weft";
  fabric.families[1].angle = right_angle;
  fabric.crossings.resize(1);
  return fabric;
}

bool is_weave(const Fabric& fabric) {
  return fabric.families.size() == 2 && fabric.crossings.size() == 1 && !fabric.sheet &&
         fabric.stitches.empty();
}

MaterialAxes material_axes(const Fabric& fabric) {
  MaterialAxes axes;
  if (fabric.families.empty()) return axes;
  axes.first = fabric.families[0].angle;
  axes.second = axes.first + right_angle;
  double most = 1e-3; // sine of the angle between them
  for (const YarnFamily& family : fabric.families)
    if (const double sine = std::sin(family.angle - axes.first); sine > (1.0 + 1e-9) * most) {
      axes.second = family.angle;
      most = sine;
    }
  return axes;
}

int yarn_directions(const Fabric& fabric) {
  constexpr double least = 1e-3; // sine of the angle between two
  std::vector<double> found;
  for (const YarnFamily& family : fabric.families)
    if (std::none_of(found.begin(), found.end(), [&](double angle) {
          return std::abs(std::sin(family.angle - angle)) < least;
        }))
      found.push_back(family.angle);
  return static_cast<int>(found.size());
}

double crossing_angle(const Fabric& fabric, const Crossing& crossing) {
  return std::abs(fabric.families[crossing.second].angle - fabric.families[crossing.first].angle);
}

std::array<double, 2> crossing_spacing(const Fabric& fabric, const Crossing& crossing) {
  const double sine = std::sin(crossing_angle(fabric, crossing));
  return {1.0 / (fabric.families[crossing.second].density * sine),
          1.0 / (fabric.families[crossing.first].density * sine)};
}

double cells_per_area(const Fabric& fabric, const Crossing& crossing) {
  return fabric.families[crossing.first].density * fabric.families[crossing.second].density *
         std::sin(crossing_angle(fabric, crossing));
}

std::pair<std::string, std::string> axes_words(const Fabric& fabric) {
  if (fabric.families.empty()) return {"x", "along y"};
  const double second = material_axes(fabric).second;
  for (const YarnFamily& family : fabric.families)
    if (family.angle == second) return {fabric.families[0].name, "along " + family.name};
  return {fabric.families[0].name, "across"};
}

BendingLaw bending_law(const Fabric& fabric) {
  BendingLaw law;
  const MaterialAxes axes = material_axes(fabric);
  for (const YarnFamily& family : fabric.families)
    law.families.push_back({axes.components(family.angle), family.bending, family.in_plane_bending,
                            family.bending_viscosity});
  if (fabric.plate > 0.0)
    for (const Vec2& axis : {Vec2(Vec2::UnitX()), Vec2(Vec2::UnitY())})
      law.families.push_back({axis, {fabric.plate, {}, {}}, 0.0, fabric.plate_viscosity});
  law.coupling = fabric.plate_coupling;
  law.twist = fabric.twist;
  return law;
}

bool shows_opening(const Fabric& fabric, std::size_t family) {
  return fabric.families[family].opening_limit ||
         std::none_of(fabric.crossings.begin(), fabric.crossings.end(),
                      [&](const Crossing& c) { return c.first == family || c.second == family; });
}

bool bears_compression(const Fabric& fabric) {
  return fabric.has_yarns() &&
         std::all_of(fabric.families.begin(), fabric.families.end(),
                     [](const YarnFamily& family) { return family.tension.compression > 0.0; });
}

bool has_pretension(const Fabric& fabric) {
  return std::any_of(fabric.stitches.begin(), fabric.stitches.end(),
                     [](const Stitch& stitch) { return stitch.law.at(0.0).value > 0.0; });
}

bool balanced(const Fabric& fabric) {
  const auto same = [](const YarnFamily& p, const YarnFamily& q) {
    return p.tension == q.tension && p.bending == q.bending &&
           p.in_plane_bending == q.in_plane_bending && p.density == q.density &&
           p.relaxation == q.relaxation && p.bending_viscosity == q.bending_viscosity;
  };
  const auto same_crimp = [](const Crossing& c) {
    return !c.crimp || (c.crimp->crimp[0] == c.crimp->crimp[1] &&
                        c.crimp->half_wave[0] == c.crimp->half_wave[1]);
  };
  return std::all_of(fabric.families.begin(), fabric.families.end(),
                     [&](const YarnFamily& f) { return same(f, fabric.families.front()); }) &&
         std::all_of(fabric.crossings.begin(), fabric.crossings.end(), same_crimp);
}

} // namespace plyform
