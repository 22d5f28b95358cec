// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the crimp of a crossing: [crimp] of a weave, [crossing.crimp] of any other.
#pragma once

#include "core/input/keys/schema_check.hpp"
#include "core/model/fabric.hpp"

namespace plyform {

/// Gives a crossing of `fabric`, whose families are known, the cell that the table describes; none
/// if there is no table. Reports waves that cannot be, with those that could.
void read_crimp(const TableView& section, const Fabric& fabric, Crossing& crossing,
                Diagnostics& diagnostics);

} // namespace plyform
