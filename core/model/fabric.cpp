// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/model/fabric.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

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

double TensionLaw::largest_slope() const {
  return strain.empty() ? stiffness : steepest(strain, tension);
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

LawPoint ShearLaw::at(double g) const {
  if (!angle.empty()) return odd(angle, torque, g);
  LawPoint r{0.0, 0.0, 0.0};
  const double g2 = g * g;
  double power = 1.0; // g^(2i)
  for (std::size_t i = 0; i < k.size(); ++i) {
    const double order = 2.0 * static_cast<double>(i) + 1.0; // exponent of g
    r.value += k[i] * power * g;
    r.slope += k[i] * order * power;
    r.energy += k[i] * power * g2 / (order + 1.0);
    power *= g2;
  }
  return r;
}

double ShearLaw::secant(double g) const {
  constexpr double small = 1e-9; // rad: below it Cs(g) / g equals the slope at 0 to rounding
  const LawPoint law = at(g);
  return std::abs(g) > small ? law.value / g : law.slope;
}

LawPoint MomentLaw::at(double kappa) const {
  if (!curvature.empty()) return odd(curvature, moment, kappa);
  return {stiffness * kappa, stiffness, 0.5 * stiffness * kappa * kappa};
}

double MomentLaw::largest_slope() const {
  return curvature.empty() ? stiffness : steepest(curvature, moment);
}

bool BendingLaw::any() const {
  return warp.largest_slope() > 0.0 || weft.largest_slope() > 0.0 || twist > 0.0 ||
         in_plane[0] > 0.0 || in_plane[1] > 0.0;
}

bool balanced(const Fabric& fabric) {
  const auto same = [](const TensionLaw& a, const TensionLaw& b) {
    return a.stiffness == b.stiffness && a.strain == b.strain && a.tension == b.tension &&
           a.compression == b.compression && a.buckling_force == b.buckling_force;
  };
  const MomentLaw &a = fabric.bending.warp, &b = fabric.bending.weft;
  const auto& in_plane = fabric.bending.in_plane;
  const bool bend = a.stiffness == b.stiffness && a.curvature == b.curvature &&
                    a.moment == b.moment && in_plane[0] == in_plane[1];
  return bend && same(fabric.warp, fabric.weft) && fabric.warp_density == fabric.weft_density;
}

} // namespace plyform
