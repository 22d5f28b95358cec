// SPDX-License-Identifier: GPL-3.0-or-later
// The state of one ply at one time, as it is output. Units: mm, N, degrees, N per yarn.
#pragma once

#include "base/geometry.hpp"

#include <array>
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
  std::vector<Vec3> reaction;           ///< n, N, of boundaries; empty where there are none
};

/// A column of the results: its name in every file, and its member of PlyFrame.
template <class Value>
struct Column {
  const char* name;
  std::vector<Value> PlyFrame::*values;
};

// Fields of a ply that files contain besides positions and triangles; a new field needs an entry
// here.
inline constexpr std::array<Column<double>, 6> cell_scalars = {{
    {"shear_angle_deg", &PlyFrame::shear_deg},
    {"warp_strain", &PlyFrame::warp_strain},
    {"weft_strain", &PlyFrame::weft_strain},
    {"warp_tension_N", &PlyFrame::warp_tension},
    {"weft_tension_N", &PlyFrame::weft_tension},
    {"thickness_mm", &PlyFrame::thickness},
}};
inline constexpr std::array<Column<Vec3>, 2> cell_vectors = {{
    {"warp", &PlyFrame::warp},
    {"weft", &PlyFrame::weft},
}};
inline constexpr std::array<Column<double>, 1> node_scalars = {{
    {"contact_pressure", &PlyFrame::contact_pressure},
}};
/// Columns that are left out of the files of plies for which they are empty.
inline constexpr std::array<Column<Vec3>, 1> node_vectors = {{
    {"reaction_N", &PlyFrame::reaction},
}};

/// Area of each triangle before forming, mm^2; m of them.
std::vector<double> areas_before(const PlyFrame& ply);

} // namespace plyform
