// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the stitches of a fabric.
#pragma once

#include "core/input/keys/schema_case.hpp"
#include "core/input/keys/schema_check.hpp"
#include "core/model/fabric.hpp"

namespace plyform {

/// Of the [[stitch]] with this number, from 0, that has no name: stitch, stitch_2 ...
std::string stitch_name(std::size_t number);

/// Reads [[stitch]] of a fabric whose families have been read; those of a zigzag are two in the
/// fabric. Reports laws that cannot be, and names that cannot stand beside each other.
void read_stitches(const TableView& section, Fabric& fabric, Diagnostics& diagnostics);

} // namespace plyform
