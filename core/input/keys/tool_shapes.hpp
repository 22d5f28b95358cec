// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes of tools in a case file: for each the word of the key `shape`, its keys under tool[], and
// its reader.
#pragma once

#include "core/input/keys/tool_meshes.hpp"

namespace plyform {

/// The shape of one [[tool]].
ToolShape read_shape(const TableView& tool, const ToolMeshes& meshes, Diagnostics& diagnostics);

} // namespace plyform
