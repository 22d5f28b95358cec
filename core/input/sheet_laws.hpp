// SPDX-License-Identifier: GPL-3.0-or-later
// Sheets without yarns in a fabric file: for each law its word under `law`, its keys, its reader.
#pragma once

#include "core/input/schema_case.hpp"
#include "core/input/schema_check.hpp"

namespace plyform {

/// Words of fabrics.NAME.law: woven, then the laws of sheets.
std::vector<std::string> fabric_laws();

/// Rows below fabrics.NAME.
Rows sheet_law_rows();

/// Reads the law of a sheet and its bending into a fabric whose thickness is known; false if the
/// section is one with yarns.
bool read_sheet(const TableView& section, Fabric& fabric);

} // namespace plyform
