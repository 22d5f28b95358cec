// SPDX-License-Identifier: GPL-3.0-or-later
// Keys of how a fabric gives way through its thickness: [compaction].
#pragma once

#include "core/input/keys/schema_case.hpp"

namespace plyform {

/// Fibre volume fraction of circles that touch all round, pi / (2 sqrt(3)): no fibres are denser.
inline constexpr double densest_packing = 0.9069;

/// Rows below fabrics.NAME.
Rows compaction_rows();

} // namespace plyform
