// SPDX-License-Identifier: GPL-3.0-or-later
// Where the stitches of a ply are broken. Stitches of one direction are evenly spread in the
// unformed ply, so that the share of their length is that of the area.
#pragma once

#include "core/model/ply_frame.hpp"

#include <string>
#include <vector>

namespace plyform {

/// Stitches of one direction of a ply. Areas are those before forming.
struct BrokenStitches {
  std::string name;
  double share = 0.0;           ///< of their length that is broken
  double area = 0.0;            ///< mm^2, on which they are
  double patch_area = 0.0;      ///< mm^2, of the largest patch of triangles that share sides
  Vec3 patch_at = Vec3::Zero(); ///< mm, its centre in the formed ply; only where there is one
};

/// One for each direction of stitches.
std::vector<BrokenStitches> broken_stitches(const PlyFrame& ply);

/// Share of the length that is broken of those stitches of a ply that are broken most. NaN: it has
/// none.
double broken_share(const PlyFrame& ply);

} // namespace plyform
