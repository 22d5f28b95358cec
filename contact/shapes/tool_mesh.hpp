// SPDX-License-Identifier: GPL-3.0-or-later
// Internal to contact/: polygons of a mesh file, before they are cleaned and become a tool.
#pragma once

#include "contact/shapes/tool_shape.hpp"

#include <filesystem>
#include <string>

namespace plyform {

struct PolygonSoup {
  std::vector<Vec3> points;
  std::vector<std::vector<std::size_t>> polygons;
};

/// The points (in the file's unit) and polygons of an STL, OBJ, PLY or OFF file, unchanged. Throws
/// std::runtime_error: file missing, extension unknown, empty, truncated, unreadable, or a
/// coordinate is not finite.
PolygonSoup read_polygons(const std::filesystem::path& file);

/// Makes a tool of polygons (mm): merges duplicates, drops degenerate faces, triangulates, orients
/// and checks them, and builds the search tree. `report`, if not null, receives what was changed.
/// Throws std::runtime_error, whose text begins with `name`, as load_tool_mesh.
MeshShapePtr make_mesh_shape(PolygonSoup soup, const std::string& name, MeshReport* report);

} // namespace plyform
