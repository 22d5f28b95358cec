// SPDX-License-Identifier: GPL-3.0-or-later
// Specification of a blank: its outline and its mesh.
#pragma once

#include "contact/geometry.hpp"

#include <filesystem>
#include <vector>

namespace plyform {

/// Simple polygon (anticlockwise or clockwise, mm) with simple, disjoint holes inside it.
struct Outline {
  std::vector<Vec2> boundary;
  std::vector<std::vector<Vec2>> holes;
};

enum class MeshKind {
  diagonal,    ///< squares with one diagonal, all parallel
  alternating, ///< squares with one diagonal, its direction alternating: no preferred direction
  crossed,     ///< squares with both diagonals (a node in the middle)
  fibres,      ///< cells with sides along both fibre directions, one diagonal
  free,        ///< Delaunay refinement (CGAL Mesh_2)
  file,        ///< read from `file`
};

struct BlankSpec {
  Outline outline;
  MeshKind mesh = MeshKind::diagonal;
  double element_size = 0.0;  ///< mm: side of a square or cell; mean edge of a free mesh
  std::filesystem::path file; ///< STL, OBJ, PLY or OFF whose z is constant; for MeshKind::file
};

} // namespace plyform
