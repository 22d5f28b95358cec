// SPDX-License-Identifier: GPL-3.0-or-later
// Keys of what crossings resist by the rate of shear.
#pragma once

#include "core/input/keys/schema_case.hpp"

namespace plyform {

/// Rows of a table of shear: "fabrics.NAME.shear".
Rows viscous_shear_rows(const std::string& table);

} // namespace plyform
