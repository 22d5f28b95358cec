// SPDX-License-Identifier: GPL-3.0-or-later
// Vertical planes of symmetry of a whole scene: those that tools, boundaries, gravity, blanks and
// fibres of all plies share, and what breaks the others.
#pragma once

#include "core/mesh/mesh_blank.hpp"
#include "core/model/case.hpp"

#include <string>
#include <vector>

namespace plyform {

struct PlaneAhead {
  SymmetryPlane plane;
  std::string name;                 ///< "x = 0"
  std::vector<std::string> broken;  ///< by what, a sentence's rest each; empty: it holds
  std::vector<std::string> assumed; ///< what would have to be alike that differs by less than 5 %
  /// Of each tool and boundary, its mirror image; itself where none is.
  std::vector<int> tools = {}, boundaries = {};
};

/// Planes along x, along y and between them through the middle of the tools, that hold or nearly
/// do: no tool and no blank is off its image by more than a fiftieth of its size. None where the
/// case models a part already. meshes: of the plies.
std::vector<PlaneAhead> symmetry_planes(const Case& data, const std::vector<BlankMesh>& meshes);

/// What check says of them.
std::vector<std::string> symmetry_ahead(const Case& data, const std::vector<BlankMesh>& meshes);

} // namespace plyform
