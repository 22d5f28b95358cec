// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/model/motion.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {

namespace {

std::vector<Stage> stages_of(const Tool& tool) {
  constexpr double force_rise = 0.05; // of the duration
  if (!tool.programme.empty()) return tool.programme;
  if (tool.motion == Motion::fixed) return {};
  return {tool.motion == Motion::driven ? Stage{1.0, tool.stroke} : Stage{force_rise, tool.force}};
}

} // namespace

double whole_stroke(const Case& data) {
  for (const Tool& t : data.tools)
    if (t.motion == Motion::driven && t.stroke != 0.0) return t.stroke;
  for (const Boundary& b : data.boundaries)
    if (b.stroke != 0.0) return b.stroke;
  return 0.0;
}

Strokes longest_strokes(const Case& data) {
  Strokes s;
  for (const Tool& t : data.tools) {
    if (t.motion != Motion::driven) continue;
    s.tool = std::max(s.tool, t.stroke);
    Stage before{0.0, 0.0};
    for (const Stage& stage : stages_of(t)) {
      s.at_full_speed = std::max(s.at_full_speed, std::abs(stage.value - before.value) /
                                                      (stage.share - before.share));
      before = stage;
    }
  }
  for (const Boundary& b : data.boundaries)
    s.boundary = std::max(s.boundary, b.stroke);
  s.at_full_speed = std::max(s.at_full_speed, s.boundary);
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

double motion_at(const Tool& tool, double t, double duration) {
  Stage before{0.0, 0.0};
  for (const Stage& stage : stages_of(tool)) {
    const double begin = before.share * duration, length = (stage.share - before.share) * duration;
    if (t < begin + length)
      return before.value + smooth_step(stage.value - before.value, t - begin, length);
    before = stage;
  }
  return before.value;
}

} // namespace plyform
