// SPDX-License-Identifier: GPL-3.0-or-later
// Tool meshes that stay in memory between readings of a case, for a program in which it is being
// written: making a million facets clean takes some seconds.
#pragma once

#include "contact/shapes/tool_shape.hpp"

#include <filesystem>

namespace plyform {

/// From now on keeps meshes that are loaded, those used last, of so many facets together; 0, as at
/// the start of the program, keeps none. Thread-safe.
void keep_tool_meshes(std::size_t facets);

/// load_tool_mesh without a report, or the mesh kept from before, unless the file has changed since
/// then (its time, size and place on the disk). Thread-safe. Throws as load_tool_mesh.
MeshShapePtr cached_tool_mesh(const std::filesystem::path& file, double scale);

} // namespace plyform
