// SPDX-License-Identifier: GPL-3.0-or-later
// Internal to contact/: polygons as a mesh file holds them, before they are made a tool.
#pragma once

#include "contact/shapes/tool_shape.hpp"

#include <filesystem>
#include <string>

namespace plyform {

struct PolygonSoup {
  std::vector<Vec3> points;
  std::vector<std::vector<std::size_t>> polygons;
};

/// The points and polygons of an STL, OBJ, PLY or OFF file, as they stand there. Throws
/// std::runtime_error: file missing, extension unknown, empty, truncated, unreadable, or a number
/// that is none.
PolygonSoup read_polygons(const std::filesystem::path& file);

/// Merges, orients, checks and builds; errors begin with `name`.
MeshShapePtr make_mesh_shape(PolygonSoup soup, const std::string& name, MeshReport* report);

} // namespace plyform
