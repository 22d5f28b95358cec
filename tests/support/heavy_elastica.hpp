// SPDX-License-Identifier: GPL-3.0-or-later
// The heavy elastica: oracle of a strip that bends under its own weight.
#pragma once

#include <cmath>
#include <functional>

namespace plyform {

/// Sag of the end of a clamped strip of length L under its weight w (N/mm^2), from the elastica
/// M' = -w (L - s) cos(theta), theta' = curvature(M), theta(0) = 0, M(L) = 0, by shooting; theta
/// downwards, M per width.
inline double elastica_sag(double length, double w,
                           const std::function<double(double)>& curvature) {
  const int steps = 4000;
  const double h = length / steps;
  double sag = 0.0;
  const auto shoot = [&](double start) { // M(L) for M(0) = start
    double theta = 0.0, moment = start;
    sag = 0.0;
    for (int i = 0; i < steps; ++i) { // midpoint rule
      const double s = i * h;
      const double middle = theta + 0.5 * h * curvature(moment);
      const double moment_middle = moment - 0.5 * h * w * (length - s) * std::cos(theta);
      moment -= h * w * (length - s - 0.5 * h) * std::cos(middle);
      theta += h * curvature(moment_middle);
      sag += h * std::sin(middle);
    }
    return moment;
  };
  double low = 0.0, high = 0.5 * w * length * length; // the linear beam's
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (shoot(middle) < 0.0 ? low : high) = middle;
  }
  return sag;
}

/// The same for a bending stiffness d, N mm.
inline double elastica_sag(double length, double w, double d) {
  return elastica_sag(length, w, [d](double moment) { return moment / d; });
}

} // namespace plyform
