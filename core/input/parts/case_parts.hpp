// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the parts of a Case from entries that were checked against the table of keys. Each function
// reports errors that the table cannot express (names, files, inconsistent numbers) and fills in
// what is valid: the case is used only if there was no error at all.
#pragma once

#include "core/input/keys/motion_keys.hpp"
#include "core/model/case.hpp"

#include <filesystem>
#include <vector>

namespace plyform {

/// core/input/parts/fabric_file.cpp: fabric files and tables.
std::vector<Fabric> read_fabrics(const TableView& root, Diagnostics& diagnostics);

/// core/input/parts/blank_file.cpp: one blank. `folder` is the case file's.
BlankSpec read_blank(const TableView& section, const std::filesystem::path& folder,
                     Diagnostics& diagnostics);

/// core/input/parts/zone_file.cpp: the zones of a blank that has its outline; those along tools
/// without their places. Reports zones beside the blank, or with larger elements than its own.
void read_zones(const TableView& section, BlankSpec& blank, Diagnostics& diagnostics);

/// core/input/parts/zone_file.cpp: the places of zones along tools. Reports names of no tool, and
/// zones beside a ply that has the blank.
void place_tool_zones(const TableView& root, Case& built, Diagnostics& diagnostics);

/// core/input/parts/tool_file.cpp: tools, their shapes, places and motions. `folder` is the case
/// file's.
std::vector<Tool> read_tools(const TableView& root, const std::filesystem::path& folder,
                             Diagnostics& diagnostics);

/// core/input/parts/boundary_file.cpp: grips, frames, planes of symmetry, springs and grippers.
std::vector<Boundary> read_boundaries(const TableView& root, const std::vector<Ply>& plies,
                                      const std::vector<Tool>& tools, Diagnostics& diagnostics);

} // namespace plyform
