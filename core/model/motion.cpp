// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/model/motion.hpp"

#include "core/model/boundary.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {

namespace {

constexpr double force_rise = 0.05; // of the duration

std::vector<Stage> stages_of(const Tool& tool) {
  if (!tool.programme.empty()) return tool.programme;
  if (tool.motion == Motion::fixed) return {};
  return {tool.motion == Motion::driven ? Stage{1.0, tool.stroke} : Stage{force_rise, tool.force}};
}

std::vector<Stage> stages_of(const Boundary& b) {
  if (const auto programme = programme_of(b); !programme.empty())
    return {programme.begin(), programme.end()};
  const double force = force_of(b);
  return {force > 0.0 ? Stage{force_rise, force} : Stage{1.0, stroke_of(b)}};
}

/// Largest mean speed of a stage, as the way that it would take over the whole duration, mm.
double fastest(const std::vector<Stage>& stages) {
  double most = 0.0;
  Stage before{0.0, 0.0};
  for (const Stage& stage : stages) {
    most = std::max(most, std::abs(stage.value - before.value) / (stage.share - before.share));
    before = stage;
  }
  return most;
}

} // namespace

double programme_value(const std::vector<Stage>& stages, double t, double duration) {
  Stage before{0.0, 0.0};
  for (const Stage& stage : stages) {
    const double begin = before.share * duration, length = (stage.share - before.share) * duration;
    if (t < begin + length)
      return before.value + smooth_step(stage.value - before.value, t - begin, length);
    before = stage;
  }
  return before.value;
}

double whole_stroke(const Case& data) {
  for (const Tool& t : data.tools)
    if (t.motion == Motion::driven && t.stroke != 0.0) return t.stroke;
  for (const Boundary& b : data.boundaries)
    if (const double stroke = stroke_of(b); stroke != 0.0) return stroke;
  return 0.0;
}

Strokes longest_strokes(const Case& data) {
  Strokes s;
  for (const Tool& t : data.tools) {
    if (t.motion != Motion::driven) continue;
    s.tool = std::max(s.tool, t.stroke);
    s.at_full_speed = std::max(s.at_full_speed, fastest(stages_of(t)));
  }
  for (const Boundary& b : data.boundaries) {
    const double stroke = stroke_of(b);
    if (stroke == 0.0) continue;
    s.boundary = std::max(s.boundary, stroke);
    s.at_full_speed = std::max(s.at_full_speed, fastest(stages_of(b)));
  }
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
  return programme_value(stages_of(tool), t, duration);
}

double motion_at(const Boundary& boundary, double t, double duration) {
  return programme_value(stages_of(boundary), t, duration);
}

std::optional<double> pressure_on(const Case& data, std::size_t ply, double t) {
  std::optional<double> sum;
  for (const PressureLoad& load : data.loads) {
    if (static_cast<std::size_t>(load.ply) != ply) continue;
    const double p = programme_value(load.stages(), t, data.solver.duration);
    sum = sum.value_or(0.0) + (load.side == PlyFace::below ? p : -p);
  }
  return sum;
}

double largest_pressure_on(const Case& data, std::size_t ply) {
  double sum = 0.0;
  for (const PressureLoad& load : data.loads)
    if (static_cast<std::size_t>(load.ply) == ply) sum += load.pressure;
  return sum;
}

std::vector<Enclosure> enclosures_of(const Case& data) {
  std::vector<Enclosure> found;
  for (std::size_t i = 0; i + 1 < data.loads.size(); ++i) {
    const PressureLoad &one = data.loads[i], &other = data.loads[i + 1];
    if (one.entry == other.entry && one.ply != other.ply && one.side != other.side)
      found.push_back({one.ply, other.ply, &one});
  }
  return found;
}

void divide_forces(Tool& tool, double by) {
  if (tool.motion != Motion::force) return;
  tool.force /= by, tool.mass /= by;
  for (Stage& stage : tool.programme)
    stage.value /= by;
}

void divide_forces(Gripper& gripper, double by) {
  gripper.force /= by, gripper.mass /= by, gripper.stiffness /= by;
  if (gripper.stiffness > 0.0) return; // its programme is of strokes
  for (Stage& stage : gripper.programme)
    stage.value /= by;
}

double force_share(double t, double duration) {
  return smooth_step(1.0, t, force_rise * duration);
}

} // namespace plyform
