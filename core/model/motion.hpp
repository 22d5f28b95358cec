// SPDX-License-Identifier: GPL-3.0-or-later
// How far and how smoothly the tools and boundaries of a case move.
#pragma once

#include "core/model/case.hpp"

namespace plyform {

/// Stroke of the first driven tool, or else of the first driven boundary, mm; 0 if there is none.
double whole_stroke(const Case& data);

/// Longest strokes, mm, of any driven tool and of any boundary; 0 where there is none.
struct Strokes {
  double tool = 0.0, boundary = 0.0;
  double longest() const { return tool > boundary ? tool : boundary; }
};
Strokes longest_strokes(const Case& data);

/// Smooth way from 0 to `end` over `duration`: the speed rises over the first quarter of the time
/// by w^2 (3 - 2 w), stays, and falls in the same way over the last, so that the acceleration has
/// no jump. Against a polynomial over all of the time, with its higher peak of speed, stacks come
/// out as near to a slow run in a tenth less time (docs/developers.md). Displacement of a driven
/// tool (mm), force of a pushed one (N).
double smooth_step(double end, double t, double duration);
constexpr double ramp_share = 0.25;                           ///< of the duration, each
constexpr double peak_speed_ratio = 1.0 / (1.0 - ramp_share); ///< largest speed over the mean

} // namespace plyform
