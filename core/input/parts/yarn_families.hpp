// SPDX-License-Identifier: GPL-3.0-or-later
// Reads families of yarns and what is between them: laws as constants or tables.
#pragma once

#include "core/input/keys/schema_check.hpp"
#include "core/model/fabric.hpp"

namespace plyform {

/// A family from its table.
YarnFamily read_family(const TableView& section, Diagnostics& diagnostics);

/// Tension against strain from a table that starts at the origin and falls nowhere.
void read_table(const TableView& section, const std::string& key, std::vector<double>& strain,
                std::vector<double>& force, Diagnostics& diagnostics);

/// A law of shear from its table.
ShearLaw read_shear(const TableView& section, Diagnostics& diagnostics);

/// Reads the families, crossings and sheet of a fabric: [[family]], [[crossing]], [sheet]. Reports
/// names that cannot stand beside each other and crossings of no two families.
void read_families(const TableView& section, Fabric& fabric, Diagnostics& diagnostics);

} // namespace plyform
