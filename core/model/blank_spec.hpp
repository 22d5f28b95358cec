// SPDX-License-Identifier: GPL-3.0-or-later
// Specification of a blank: its outline and its mesh.
#pragma once

#include "contact/geometry.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace plyform {

/// An arc in the place of a straight side, from its first corner to the next about `centre` (mm),
/// at most half a turn: anticlockwise with turn = +1, clockwise with -1.
struct OutlineArc {
  int hole; ///< index into Outline::holes, -1: of the boundary
  std::size_t side;
  Vec2 centre;
  int turn;
};

/// Simple polygon (anticlockwise or clockwise, mm) with simple, disjoint holes inside it. Sides are
/// straight but for arcs, which are listed by loop and side in order.
struct Outline {
  std::vector<Vec2> boundary;
  std::vector<std::vector<Vec2>> holes;
  std::vector<OutlineArc> arcs{};
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
  std::string drawing{};      ///< what the outline was read from, in words; empty: the case file
};

} // namespace plyform
