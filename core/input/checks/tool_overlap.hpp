// SPDX-License-Identifier: GPL-3.0-or-later
// How near two tools are, or how deep in each other: of whole faces, since two meshes of a few
// large triangles may cross without a corner of one in the other.
//
// A face of a with its middle m and corners within r of it is no nearer to b than d(m) - r. Faces
// are halved fourfold, those with the least bound first, until no bound is below the least distance
// found.
#pragma once

#include "core/input/checks/initial_scene.hpp"

namespace plyform {

/// A tool and its surface as at the start (mm, in space), moved by `shift`.
struct PlacedTool {
  const Tool& tool;
  const TriMesh& surface;
  Vec3 shift = Vec3::Zero();
};

struct LeastGap {
  double gap = std::numeric_limits<double>::infinity(); ///< mm, below 0: a lies in b
  Vec3 where = Vec3::Zero();
};

/// The least distance (mm) of the surface of a to b, of the part of it above or below `area`. Gaps
/// from `interest` on are not looked at closely; others are the least ones but for `resolution`
/// (mm), or, of surfaces that are nearly everywhere as near as that, for a tenth of a millimetre or
/// so.
LeastGap least_gap(const PlacedTool& a, const PlacedTool& b, const Eigen::AlignedBox2d& area,
                   double interest, double resolution);

/// How deep (mm) two tools are in each other: the deepest point of either one's surface in the
/// other, or, of solids whose surfaces coincide, the deepest common point. gap is minus the depth;
/// what is not deeper than `touching` is none, an infinite gap.
LeastGap deepest_overlap(const PlacedTool& a, const PlacedTool& b, const Eigen::AlignedBox2d& area,
                         double touching);

/// Whether every edge has two triangles.
bool is_closed(const TriMesh& surface);

} // namespace plyform
