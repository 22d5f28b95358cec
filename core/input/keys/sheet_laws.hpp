// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of sheets in a fabric file, without yarns or beside them: for each the word of the key
// `law`, its keys and its reader.
#pragma once

#include "core/input/keys/schema_case.hpp"
#include "core/input/keys/schema_check.hpp"

namespace plyform {

/// The word of fabrics.NAME.law for a fabric by its families.
constexpr const char* families_word = "families";

/// Words of fabrics.NAME.law: woven, families, then the laws of sheets without yarns.
std::vector<std::string> fabric_laws();

/// Rows below fabrics.NAME.
Rows sheet_law_rows();

/// Reads the law of a sheet and its bending into a fabric whose thickness has been read; false if
/// the fabric has yarns. Reports constants that no sheet has.
bool read_sheet(const TableView& section, Fabric& fabric, Diagnostics& diagnostics);

/// Rows below fabrics.NAME of a sheet beside yarns, and its reader, into a fabric whose thickness
/// and families have been read.
Rows sheet_beside_rows();
void read_sheet_beside(const TableView& section, Fabric& fabric, Diagnostics& diagnostics);

} // namespace plyform
