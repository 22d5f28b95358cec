// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of the table of keys (core/input/schema.hpp). Internal to core/input.
#pragma once

#include "core/input/schema.hpp"
#include "core/model/case.hpp"

#include <vector>

namespace plyform {

using Rows = std::vector<KeyRow>;

inline const Range positive{.least = 0.0, .open_least = true};
inline const Range not_negative{.least = 0.0};

inline void append(Rows& all, Rows part) {
  for (KeyRow& row : part)
    all.push_back(std::move(row));
}

/// core/input/schema_bending.cpp: keys of a yarn ("warp", "weft") and of the fabric.
Rows yarn_bending_rows(const std::string& yarn);
Rows sheet_rows();

/// core/input/schema_fabric.cpp: fabrics.NAME and fabric files.
Rows fabric_rows();

/// core/input/schema_tool.cpp: [[tool]], and its motion. Shapes: core/input/tool_shapes.cpp.
Rows tool_rows();
Rows shape_rows();
Rows motion_rows();

/// core/input/schema_boundary.cpp: [[boundary]].
Rows boundary_rows();

} // namespace plyform
