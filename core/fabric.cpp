// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fabric.hpp"

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

} // namespace

LawPoint TensionLaw::at(double eps) const {
  if (!(eps > 0.0)) return {0.0, 0.0, 0.0};
  if (strain.empty()) return {stiffness * eps, stiffness, 0.5 * stiffness * eps * eps};
  return on_table(strain, tension, eps);
}

double TensionLaw::largest_slope() const {
  if (strain.empty()) return stiffness;
  double slope = 0.0;
  for (std::size_t i = 1; i < strain.size(); ++i)
    slope = std::max(slope, (tension[i] - tension[i - 1]) / (strain[i] - strain[i - 1]));
  return slope;
}

LawPoint ShearLaw::at(double g) const {
  if (!angle.empty()) {
    const LawPoint r = on_table(angle, torque, std::abs(g));
    return {std::copysign(r.value, g), r.slope, r.energy};
  }
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

bool balanced(const Fabric& fabric) {
  const auto same = [](const TensionLaw& a, const TensionLaw& b) {
    return a.stiffness == b.stiffness && a.strain == b.strain && a.tension == b.tension;
  };
  return same(fabric.warp, fabric.weft) && fabric.warp_density == fabric.weft_density;
}

} // namespace plyform
