// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/input/parts/case_parts.hpp"

namespace plyform {

/// Reports a fabric whose surface_density, fibre_density and thickness leave less room than its
/// fibres have in their densest packing; whether they do not.
bool check_fibre_volume(const TableView& fabric_section, const Fabric& fabric,
                        Diagnostics& diagnostics);

/// Reads [compaction], `section`, of a fabric whose other keys have been read.
void read_compaction(const TableView& section, Fabric& fabric, Diagnostics& diagnostics);

} // namespace plyform
