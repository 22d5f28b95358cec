// SPDX-License-Identifier: GPL-3.0-or-later
// Bridging of a ply in numbers: where it spans a hollow of a tool that it is pressed towards
// (core/run/bridging.hpp finds its height).
//
// The border of the spanned area runs through triangles, where the height, linear between nodes, is
// half of the ply's thickness.
#pragma once

#include "core/model/ply_frame.hpp"

#include <string>

namespace plyform {

struct Bridging {
  double height = 0.0;     ///< mm, the largest; 0: none
  Vec3 at = Vec3::Zero();  ///< mm, its node in the formed ply
  double area = 0.0;       ///< mm^2, of the unformed ply
  std::string family = {}; ///< whose yarns have the largest tension there; empty: no yarns
  double largest_tension = 0.0, mean_tension = 0.0; ///< N per yarn, of that family, there
};

/// Of a ply whose bridging_height is filled.
Bridging bridging_of(const PlyFrame& ply);

} // namespace plyform
