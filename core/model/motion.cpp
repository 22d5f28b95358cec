// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/model/motion.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {

double whole_stroke(const Case& data) {
  for (const Tool& t : data.tools)
    if (t.motion == Motion::driven && t.stroke != 0.0) return t.stroke;
  for (const Boundary& b : data.boundaries)
    if (b.stroke != 0.0) return b.stroke;
  return 0.0;
}

Strokes longest_strokes(const Case& data) {
  Strokes s;
  for (const Tool& t : data.tools)
    if (t.motion == Motion::driven) s.tool = std::max(s.tool, std::abs(t.stroke));
  for (const Boundary& b : data.boundaries)
    s.boundary = std::max(s.boundary, b.stroke);
  return s;
}

double smooth_step(double end, double t, double duration) {
  constexpr double r = ramp_share;
  const double u = std::clamp(t / duration, 0.0, 1.0);
  const auto ramp = [](double from_end) {
    const double w = from_end / r;
    return peak_speed_ratio * r * w * w * w * (1.0 - 0.5 * w);
  };
  if (u < r) return end * ramp(u);
  if (u > 1.0 - r) return end * (1.0 - ramp(1.0 - u));
  return end * peak_speed_ratio * (u - 0.5 * r);
}

} // namespace plyform
