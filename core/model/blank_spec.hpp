// SPDX-License-Identifier: GPL-3.0-or-later
// Specification of a blank: its outline and its mesh.
#pragma once

#include "base/geometry.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
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

enum class ZoneKind {
  circle,  ///< a disc, or a ring if it has an inner radius
  polygon, ///< inside an outline of straight sides
  tool,    ///< about the places of a tool where it is tightly rounded, seen from above
};

/// A disc about a tightly rounded place of a tool, seen from above. mm, in space.
struct ToolPlace {
  Vec2 at;
  double reach;
};

/// A part of a blank that has smaller elements. Circles and polygons are seen from the blank's
/// origin, as its outline. Lengths in mm.
struct MeshZone {
  ZoneKind kind = ZoneKind::circle;
  double element_size = 0.0; ///< as BlankSpec::element_size
  Vec2 centre = Vec2::Zero();
  double radius = 0.0, inner_radius = 0.0;
  std::vector<Vec2> outline{};     ///< of a polygon
  int tool = -1;                   ///< index into Case::tools
  std::vector<ToolPlace> places{}; ///< of the tool: core/mesh/tool_zone.hpp
};

/// Wanted element sizes (mm) on a grid of points in the blank's plane, seen from its origin:
/// size[row columns + column] at origin + spacing (column, row), bilinear between, and beyond the
/// grid as on its rim.
struct SizeGrid {
  Vec2 origin = Vec2::Zero(); ///< mm
  double spacing = 0.0;       ///< mm
  int columns = 0, rows = 0;  ///< at least one each
  std::vector<double> size;   ///< mm, above 0

  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
};

/// The word for it in BlankSpec::mesh_from.
constexpr const char* mesh_from_scene_word = "scene";

/// The element size wanted at a place is the least of element_size, that of the zones that hold the
/// place, and that of the grid.
struct BlankSpec {
  Outline outline;
  MeshKind mesh = MeshKind::diagonal;
  double element_size = 0.0;  ///< mm: side of a square or cell; mean edge of a free mesh
  std::filesystem::path file; ///< STL, OBJ, PLY or OFF whose z is constant; for MeshKind::file
  std::string drawing{};      ///< what the outline was read from, in words; empty: the case file
  std::vector<MeshZone> zones{};
  /// "scene", or a file or folder of results whose sizes are taken; empty: neither, as above
  std::string mesh_from{};
  std::optional<SizeGrid> sizes{};
};

/// Makes all elements larger by the factor `by`: element_size, zones and grid.
void scale_elements(BlankSpec& blank, double by);

} // namespace plyform
