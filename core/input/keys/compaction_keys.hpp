// SPDX-License-Identifier: GPL-3.0-or-later
// Keys of how a fabric gives way through its thickness: [compaction].
#pragma once

#include "core/input/keys/schema_case.hpp"

namespace plyform {

/// Rows below fabrics.NAME.
Rows compaction_rows();

} // namespace plyform
