// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of sheets without yarns in a fabric file: for each the word of the key `law`, its keys and
// its reader.
#pragma once

#include "core/input/keys/schema_case.hpp"
#include "core/input/keys/schema_check.hpp"

namespace plyform {

/// Words of fabrics.NAME.law: woven, then the laws of sheets.
std::vector<std::string> fabric_laws();

/// Rows below fabrics.NAME.
Rows sheet_law_rows();

/// Reads the law of a sheet and its bending into a fabric whose thickness has been read; false if
/// the fabric has yarns.
bool read_sheet(const TableView& section, Fabric& fabric);

} // namespace plyform
