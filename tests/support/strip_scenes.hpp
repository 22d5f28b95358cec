// SPDX-License-Identifier: GPL-3.0-or-later
// Strips of weave between two clamps, one of which moves.
#pragma once

#include "support/stress_scenes.hpp"

#include <array>
#include <cmath>

namespace plyform {

struct Strip {
  double free_length, width, size; ///< mm, between the clamps; mm; mm, of the squares
  double in_plane, bending;        ///< N mm
  double yarn;                     ///< N per yarn, softened in tension and pressed
};

/// Warp along x, two columns of squares beyond the free length at either end, held by `left`
/// entirely and by `right` along y and z. The slope is then held, too; the columns of nodes at the
/// ends bend by half a square on either side, so that the strip is one square longer than
/// free_length.
inline Case strip_case(const Strip& strip) {
  const double length = strip.free_length + 4.0 * strip.size;
  Case data = stack_of({0.0}, rectangle(length, strip.width, strip.size));
  Fabric& fabric = data.fabrics[0];
  fabric.families[0].tension.compression = fabric.families[1].tension.compression = strip.yarn;
  fabric.families[0].bending.stiffness = fabric.families[1].bending.stiffness = fabric.twist =
      strip.bending;
  for (YarnFamily& family : fabric.families)
    family.in_plane_bending = strip.in_plane;
  const double end = 0.5 * length, side = 0.5 * strip.width, clamp = 0.5 * strip.free_length;
  data.boundaries = {hold("left", {-end, -side}, {-clamp, side}, Vec3::UnitX(), 0.0),
                     hold("right", {clamp, -side}, {end, side}, Vec3::UnitX(), 0.0)};
  set_friction(data, 0.0);
  data.solver.fibre_softening = fabric.families[0].tension.stiffness / strip.yarn;
  data.solver.step_factor = 0.9;
  return data;
}

/// Keeps all nodes where they are along some axes.
inline void hold_all(Case& data, const std::array<bool, 3>& axes) {
  Boundary all = hold("all", {-1e3, -1e3}, {1e3, 1e3}, Vec3::UnitX(), 0.0);
  all.as<Grip>().held = axes;
  data.boundaries.push_back(all);
}

inline double right_load(const RunResult& run) {
  for (const BoundaryFrame& b : run.last.boundaries)
    if (b.name == "right") return b.force_N;
  return std::nan("");
}

} // namespace plyform
