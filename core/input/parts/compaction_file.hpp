// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/input/parts/case_parts.hpp"

namespace plyform {

/// Reads [compaction], `section`, of a fabric whose other keys have been read.
void read_compaction(const TableView& section, Fabric& fabric, Diagnostics& diagnostics);

} // namespace plyform
