// SPDX-License-Identifier: GPL-3.0-or-later
// The mesh files of a case's tools, loaded several at a time: making a million facets clean takes
// some seconds of one core.
#pragma once

#include "contact/shapes/tool_shape.hpp"
#include "core/input/keys/schema_check.hpp"

#include <exception>
#include <filesystem>
#include <map>
#include <optional>
#include <utility>

namespace plyform {

class ToolMeshes {
public:
  /// Loads the file of every tool whose shape is a mesh, each once. folder: that of the case file.
  /// What is wrong with a file is kept for of().
  ToolMeshes(const TableView& root, const std::filesystem::path& folder);

  /// The mesh of a tool of that shape; null if its keys name none. Throws what load_tool_mesh does.
  MeshShapePtr of(const TableView& tool) const;

private:
  using Key = std::pair<std::filesystem::path, double>; ///< file and scale
  struct Loaded {
    MeshShapePtr mesh;
    std::exception_ptr error;
  };
  static std::optional<Key> key_of(const TableView& tool, const std::filesystem::path& folder);

  std::filesystem::path folder_;
  std::map<Key, Loaded> meshes_;
};

} // namespace plyform
