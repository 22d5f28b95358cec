// SPDX-License-Identifier: GPL-3.0-or-later
// How a ply fills its mould, in numbers: its fibre volume fraction, and where a closed mould is
// wider than the stack, where resin runs ahead, or as narrow as its densest packing, where it
// cannot close further (core/run/closed_gap.hpp).
//
//   mean of the fibre volume fraction: sum V A t over sum A t of the formed triangles
//   wider: the gap left is more than a twentieth of the gap, which flat triangles do not leave
//   packed: the packing is 0.999 or more
#pragma once

#include "core/model/ply_frame.hpp"

#include <optional>

namespace plyform {

struct FibreVolume {
  double mean = 0.0, least = 0.0, largest = 0.0;
  Vec3 least_at = Vec3::Zero(), largest_at = Vec3::Zero(); ///< mm, formed
};

/// Of a ply; none where it is not known.
std::optional<FibreVolume> fibre_volume_of(const PlyFrame& ply);

/// Areas in mm^2 of the unformed ply.
struct MouldFill {
  double area = 0.0;                      ///< between the closed tools
  double least_gap = 0.0, mean_gap = 0.0; ///< mm, there
  double wider = 0.0, packed = 0.0;       ///< of that
  double widest = 0.0;                    ///< mm, the largest gap left
  Vec3 widest_at = Vec3::Zero();          ///< mm, formed
};

/// Of a ply; none in a run without a closed mould of plies that give way.
std::optional<MouldFill> mould_fill_of(const PlyFrame& ply);

} // namespace plyform
