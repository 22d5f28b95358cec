// SPDX-License-Identifier: GPL-3.0-or-later
// Wanted element sizes of the triangles of a coarse mesh, evened out into a grid that a blank can
// be meshed by (SizeGrid, core/model/blank_spec.hpp).
//
// Bisected meshes have elements of their largest size over a power of 2^(1/2), and up to 2^(1/4)
// times what is wanted. The grid asks for a little less (`asked_share`), so that they have 1.1
// times at most, and the largest size is chosen so that the smallest is what is wanted.
#pragma once

#include "core/model/case.hpp"
#include "core/model/ply_frame.hpp"
#include "core/setup/chord_sizes.hpp"

namespace plyform {

/// The grid of a ply, seen from the origin of its blank. sizes: of each triangle of `ply`; largest:
/// mm. A size holds within `held` of a side of the triangle's square: at 0.3 its places are as far
/// apart, and stand for their neighbours between two states that were looked at. Farther off sizes
/// grow by size_growth.
SizeGrid size_grid(const PlyFrame& ply, const Ply& place, const AskedSizes& sizes, double largest,
                   double held);

/// The share of wanted sizes that a grid has.
constexpr double asked_share = 0.92;

/// mm: the largest size up to `largest` from which bisections lead to the least that the grid was
/// made for.
double aligned_size(const SizeGrid& grid, double largest);

/// Gives a ply a blank of its own with these sizes, and the largest size that aligned_size says.
void set_sizes(Case& data, std::size_t ply, SizeGrid sizes);

/// mm per mm: how fast sizes may grow from place to place. A bisected mesh doubles them within two
/// or three elements, which is as steep.
constexpr double size_growth = 0.3;

} // namespace plyform
