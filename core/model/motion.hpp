// SPDX-License-Identifier: GPL-3.0-or-later
// Strokes of the tools and boundaries of a case, and the time function of their motion.
#pragma once

#include "core/model/case.hpp"

#include <optional>

namespace plyform {

/// Stroke of the first driven tool, or else of the first driven boundary, mm; 0 if there is none.
double whole_stroke(const Case& data);

/// Longest strokes, mm, of any driven tool and of any boundary; 0 where there is none.
struct Strokes {
  double tool = 0.0, boundary = 0.0;
  /// mm, that a body would travel if it moved all the time at the mean speed of its fastest stage:
  /// the longest stroke, unless there is a programme
  double at_full_speed = 0.0;
  double longest() const { return tool > boundary ? tool : boundary; }
};
Strokes longest_strokes(const Case& data);

/// Smooth ramp from 0 to `end` at time t (s) of `duration` (s), for the displacement of a driven
/// tool (mm) or the force of a pushed one (N). The rate rises over the first quarter of the time as
/// w^2 (3 - 2 w), is constant, and falls likewise over the last quarter, so that the acceleration
/// is continuous. Compared with a polynomial over the whole time, whose peak speed is higher,
/// stacks come as close to the result of a slow run in a tenth less time (docs/tried.md).
double smooth_step(double end, double t, double duration);

/// Value of a programme at time t (s) of `duration` (s): one stage after the other, each by
/// smooth_step from the value before to its own; what comes after the last one stays.
double programme_value(const std::vector<Stage>& stages, double t, double duration);

/// Displacement (mm) of a driven tool along its direction, or the force (N) on a pushed one, at
/// time t (s) of `duration` (s). One stage after the other, each by smooth_step from the value
/// before to its own; what comes after the last one stays. Without a programme a stroke takes the
/// duration, and a force rises over a twentieth of it, to avoid an impact. 0 of a fixed tool.
double motion_at(const Tool& tool, double t, double duration);

/// Likewise the displacement (mm) of a grip, a frame or the drive of a gripper, or the force (N) on
/// a gripper without a drive; 0 of springs and planes of symmetry.
double motion_at(const Boundary& boundary, double t, double duration);

/// N/mm^2 of all loads on a ply at time t (s), positive upwards, from below; nothing: none acts on
/// it.
std::optional<double> pressure_on(const Case& data, std::size_t ply, double t);

/// N/mm^2 that all loads on a ply come to at most, whichever way they push.
double largest_pressure_on(const Case& data, std::size_t ply);

/// Two plies with a load between them.
struct Enclosure {
  int lower = 0, upper = 0;           ///< indices into Case::plies
  const PressureLoad* load = nullptr; ///< of the two that it is, the one on `lower`
};

/// Of each [[load]] that has `between`; they point into Case::loads.
std::vector<Enclosure> enclosures_of(const Case& data);

/// Leaves a tool that is pushed, or a gripper, 1 / `by` of what pushes or drives it and of its
/// mass.
void divide_forces(Tool& tool, double by);
void divide_forces(Gripper& gripper, double by);

/// Share of a force that has come up at time t (s) where it has no programme: of the preload of a
/// spring.
double force_share(double t, double duration);

/// mm/s, at most, of a pushed tool, reached where nothing resists: a fast press.
constexpr double closing_speed = 1000.0;
constexpr double ramp_share = 0.25;                           ///< of the duration, each
constexpr double peak_speed_ratio = 1.0 / (1.0 - ramp_share); ///< largest speed over the mean

} // namespace plyform
