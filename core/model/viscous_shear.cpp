// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/model/viscous_shear.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

/// c0 + c2 g^2 + c4 g^4 ...
double even_polynomial(const std::vector<double>& c, double g) {
  double sum = 0.0;
  for (std::size_t i = c.size(); i-- > 0;)
    sum = sum * g * g + c[i];
  return sum;
}

} // namespace

double RateCurve::at(double g) const {
  const double x = std::abs(g);
  const auto next = std::upper_bound(angle.begin(), angle.end(), x);
  if (next == angle.begin()) return torque.front();
  if (next == angle.end()) return torque.back();
  const auto i = static_cast<std::size_t>(next - angle.begin());
  return torque[i - 1] +
         (torque[i] - torque[i - 1]) * (x - angle[i - 1]) / (angle[i] - angle[i - 1]);
}

double ViscousShear::torque(double angle, double rate) const {
  if (curves.empty()) return even_polynomial(c, angle) * rate;
  const double v = std::abs(rate);
  double v0 = 0.0, d0 = 0.0, slope = 0.0;
  for (const RateCurve& curve : curves) {
    const double d = curve.at(angle);
    slope = (d - d0) / (curve.rate - v0);
    if (curve.rate >= v) break;
    v0 = curve.rate, d0 = d;
  }
  return std::copysign(d0 + slope * (v - v0), rate);
}

double ViscousShear::viscosity(double angle, double driven, double spring_dt, double factor) const {
  if (curves.empty()) return factor * even_polynomial(c, angle);
  const double wanted = std::abs(driven);
  double v0 = 0.0, d0 = 0.0, v = 0.0;
  for (const RateCurve& curve : curves) {
    const double d = factor * curve.at(angle), slope = (d - d0) / (curve.rate - v0);
    // D + K dt v is linear between rates
    v = v0 + (wanted - d0 - spring_dt * v0) / (slope + spring_dt);
    const bool last = &curve == &curves.back();
    if (v <= curve.rate || last) return v > 0.0 ? (d0 + slope * (v - v0)) / v : slope;
    v0 = curve.rate, d0 = d;
  }
  return 0.0;
}

double ViscousShear::instant_modulus() const {
  double sum = 0.0;
  for (const MaxwellBranch& branch : branches)
    sum += branch.modulus;
  return sum;
}

std::optional<std::array<double, 2>> ViscousShear::known_rates() const {
  if (measured_rates || curves.empty()) return measured_rates;
  return std::array{curves.front().rate, curves.back().rate};
}

MaxwellStep maxwell_step(const MaxwellBranch& branch, double dt) {
  const double s = dt / branch.time;
  return {std::exp(-s), branch.modulus * -std::expm1(-s) / s};
}

} // namespace plyform
