// SPDX-License-Identifier: GPL-3.0-or-later
// Draw-in: by how much the border of a ply has moved towards the ply's middle.
//
// It is measured along eight straight lines (walks) in the undeformed ply, from the middle of its
// bounding box to where each first meets the outer border: in both directions along the two yarns,
// and along the two bisectors of the angles between them. The draw-in of a walk is the decrease,
// seen from above, of the distance of that point of the border from the original position of the
// middle. Holes are ignored. With planes of symmetry the middle is that of the modelled part.
#pragma once

#include "core/model/ply_frame.hpp"

#include <array>
#include <string>

namespace plyform {

struct DrawIn {
  std::array<double, 4> yarns_deg{}, bisectors_deg{}; ///< directions of the walks, from x
  std::array<double, 4> yarns{}, bisectors{};         ///< mm
  std::string unknown; ///< empty, or why it could not be measured: then the numbers are not valid
  double mean() const; ///< mm, of all eight
  double largest() const;
};

/// The draw-in of a ply. Its two yarns are the first two families; across the fibres where there is
/// one family alone, across angle_deg where there is none.
DrawIn draw_in(const PlyFrame& ply);

} // namespace plyform
