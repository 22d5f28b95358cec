// SPDX-License-Identifier: GPL-3.0-or-later
// Draw-in: how far the border of a ply has come nearer to the ply's middle.
//
// Eight straight walks in the unformed ply, from the middle of its bounding box to where each first
// meets the border: both ways along the two yarns, and both ways along the two lines that halve the
// angles between them. The draw-in of a walk is how much nearer, seen from above, the place of the
// border that it met came to where the middle was. Holes are walked over. Of a ply with planes of
// symmetry only the modelled part is known, so the middle is that of this part.
#pragma once

#include "core/results/ply_frame.hpp"

#include <array>
#include <string>

namespace plyform {

struct DrawIn {
  std::array<double, 4> yarns_deg{}, bisectors_deg{}; ///< directions of the walks, from x
  std::array<double, 4> yarns{}, bisectors{};         ///< mm
  std::string unknown; ///< why there is none, else empty; then the numbers mean nothing
  double mean() const; ///< mm, of all eight
  double largest() const;
};

/// fibre_angle_deg: from warp to weft before forming, about +z.
DrawIn draw_in(const PlyFrame& ply, double fibre_angle_deg);

} // namespace plyform
