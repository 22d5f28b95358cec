// SPDX-License-Identifier: GPL-3.0-or-later
// How far a tool is from flat plies, and how far it moves until it touches one, by the distances of
// the shapes themselves.
//
//   d(p)  mm  signed distance of p to the tool;  r  mm  half the diagonal of a box about p
//   gap = min over the ply's mid-surface of d - t/2, t its thickness
//
// A box holds no point nearer than d - r. Boxes that may hold the nearest point are quartered down
// to 1/64 of the ply; the nearest points of the boxes left, and those that corners of the tool are
// above or below, are moved downhill to where d is least: to rounding errors where it is smooth.
// What is narrower than such a box and has no corner there may be missed.
#pragma once

#include "core/input/checks/initial_scene.hpp"

#include <optional>

namespace plyform {

struct PlyGap {
  double gap = std::numeric_limits<double>::infinity(); ///< mm, below 0: the tool is in the ply
  std::size_t ply = 0;                                  ///< the nearest
  Vec3 where = Vec3::Zero(); ///< mm, on the face of the ply that is nearest to the tool
};

/// A tool with points (mm, in space) of its surface as at the start, which may be few.
struct ToolAhead {
  const Tool& tool;
  const std::vector<Vec3>& points;
};

/// Of the tool moved by `shift` (mm) to the nearest of the plies; without plies infinite.
PlyGap nearest_ply(const ToolAhead& tool, const Vec3& shift, const std::vector<FlatPly>& plies);

struct FirstContact {
  double stroke = 0.0; ///< mm, along the tool's direction
  std::size_t ply = 0;
  Vec3 where = Vec3::Zero();    ///< mm, as of PlyGap
  std::optional<double> time{}; ///< s, when; not known of a tool under a force
};

/// Where the tool first touches a ply within this stroke (mm) along its direction, with all else as
/// at the start; a touch that it leaves at once is none. By steps as long as the gap, which are
/// never too far (conservative advancement). start: nearest_ply without a shift.
std::optional<FirstContact> first_contact(const ToolAhead& tool, double stroke, const PlyGap& start,
                                          const std::vector<FlatPly>& plies);

} // namespace plyform
