// SPDX-License-Identifier: GPL-3.0-or-later
// Picture frames of 100 mm of a weave of yarns at right angles, and what theory says of them: all
// cells have the shear angle gamma of the frame, and the load F along its diagonal does the work of
// their torques C, F = cells C / (side sin(pi/4 - gamma/2)).
#pragma once

#include "core/model/motion.hpp"
#include "support/boundary_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace plyform {

constexpr double frame_side = 100.0, frame_end = 50.0 * std::numbers::pi / 180.0; ///< mm, rad

/// mm, of the diagonal, to a shear angle (rad).
inline double frame_stroke(double gamma) {
  return 2.0 * frame_side * std::cos(0.25 * std::numbers::pi - 0.5 * gamma) -
         frame_side * std::sqrt(2.0);
}

/// rad, at a stroke (mm).
inline double frame_angle_at(double stroke) {
  return 0.5 * std::numbers::pi -
         2.0 * std::acos((frame_side * std::sqrt(2.0) + stroke) / (2.0 * frame_side));
}

/// A frame around a square of that side, with this stroke, mm.
inline Boundary square_frame(double side, double stroke) {
  HingedFrame f;
  const double a = 0.5 * side;
  f.hinges = {Vec2(-a, -a), Vec2(a, -a), Vec2(a, a), Vec2(-a, a)};
  f.stroke = stroke;
  return {"frame", -1, f};
}

/// A frame that shears to frame_end in 1 s, with little inertia.
inline Case picture_frame(MeshKind mesh = MeshKind::alternating) {
  Case data = stack_of({0.0}, rectangle(frame_side, frame_side, 25.0, mesh));
  data.boundaries = {square_frame(frame_side, frame_stroke(frame_end))};
  set_friction(data, 0.0);
  data.solver.duration = 1.0;
  return data;
}

/// rad, at a time (s) of the simulation.
inline double frame_angle(const Case& data, double time) {
  const double end = data.solver.duration;
  return frame_angle_at(motion_at(data.boundaries[0], std::min(time, end), end));
}

/// Unit cells in the frame.
inline double frame_cells(const Case& data) {
  const Fabric& f = data.fabrics[0];
  return f.families[0].density * f.families[1].density * frame_side * frame_side;
}

/// N, of the frame with this torque (N mm) in all cells.
inline double frame_load(const Case& data, double gamma, double torque) {
  return frame_cells(data) * torque /
         (frame_side * std::sin(0.25 * std::numbers::pi - 0.5 * gamma));
}

/// All outputs of a run, whose balance must hold.
inline std::vector<Frame> outputs_of(const Case& data) {
  std::vector<Frame> outputs;
  RunHooks hooks;
  hooks.frame = [&](const Frame& f) { outputs.push_back(f); };
  const RunResult run = run_case(data, 1, hooks);
  EXPECT_TRUE(ended(run.summary.status)) << run.summary.message;
  EXPECT_LT(std::abs(run.last.energy.balance_error()), 0.01);
  return outputs;
}

} // namespace plyform
