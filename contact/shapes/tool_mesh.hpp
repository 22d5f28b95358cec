// SPDX-License-Identifier: GPL-3.0-or-later
// Internal to contact/: polygons of a mesh file, before they are cleaned and become a tool.
#pragma once

#include "base/polygon_file.hpp"
#include "contact/shapes/tool_shape.hpp"

#include <string>

namespace plyform {

/// Makes a tool of polygons (mm): merges duplicates, drops degenerate faces, triangulates, orients
/// and checks them, and builds the search tree. `report`, if not null, receives what was changed.
/// Throws std::runtime_error, whose text begins with `name`, as load_tool_mesh.
MeshShapePtr make_mesh_shape(PolygonSoup soup, const std::string& name, MeshReport* report);

} // namespace plyform
