// SPDX-License-Identifier: GPL-3.0-or-later
// Figures of which siblings show no error, whatever they differ by:
//
//   given       the force of a tool that the case pushes with it: all siblings have it
//   held        the draw-in of a ply of which boundaries hold the whole border: likewise
//   unresolved  the largest compression of a ply whose elements are longer than a tool that bears
//               it is round, or have less than 1.8 in a zone of in-plane bending: a maximum there
//               is not to be seen on this mesh, nor on one 1.3 times finer
#pragma once

#include "core/mesh/mesh_blank.hpp"
#include "core/model/case.hpp"
#include "core/results/frame.hpp"

#include <string>
#include <vector>

namespace plyform {

constexpr double fewest_in_layer = 1.8; // elements; of runs that are alike on 1.4 degrees differ

/// Why a figure has no band, a clause; empty: it may have one.
struct NoBand {
  std::vector<std::string> force;            ///< by tool: given
  std::vector<std::string> draw_in, pressed; ///< by ply: held; unresolved
};

/// Of a run of `data` that ended like this.
NoBand figures_without_band(const Case& data, const Frame& last);

/// Whether elements of all plies, meshed so, are no longer than any tool is round, and hold their
/// zones of bending.
bool resolves_all(const Case& data, const std::vector<BlankMesh>& meshes);

/// Whether elements larger by this factor still resolve the transition zones of a ply.
bool resolves_bending(const Case& data, const Ply& ply, double by);

} // namespace plyform
