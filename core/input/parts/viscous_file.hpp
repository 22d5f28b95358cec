// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/input/keys/schema_check.hpp"
#include "core/model/viscous_shear.hpp"

#include <optional>

namespace plyform {

/// What the crossing of a table of shear resists by rates; nothing if it has no keys of that.
std::optional<ViscousShear> read_viscous_shear(const TableView& shear, Diagnostics& diagnostics);

} // namespace plyform
