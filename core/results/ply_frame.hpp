// SPDX-License-Identifier: GPL-3.0-or-later
// One ply at one time, as results hold it. Units: mm, N, degrees, N per yarn.
#pragma once

#include "contact/geometry.hpp"

#include <string>
#include <vector>

namespace plyform {

/// One ply at one time. Sizes: n nodes, m triangles.
struct PlyFrame {
  std::string name;
  double angle_deg = 0;
  std::vector<Vec3> x0, x;                        ///< n, mm: before and now
  std::vector<Triangle> triangles;                ///< m
  std::vector<Vec3> warp, weft;                   ///< m, unit vectors of the fibres now
  std::vector<double> shear_deg;                  ///< m, signed
  std::vector<double> warp_strain, weft_strain;   ///< m
  std::vector<double> warp_tension, weft_tension; ///< m, N per yarn
  std::vector<double> thickness;                  ///< m, mm, from constant volume
  std::vector<double> contact_pressure; ///< n, N/mm^2, normal contact force over node area
  std::vector<Vec3> reaction; ///< n, N, of grips, frames and symmetry; empty if none holds the ply
};

/// Area of each triangle before forming, mm^2; m of them.
std::vector<double> areas_before(const PlyFrame& ply);

} // namespace plyform
