// SPDX-License-Identifier: GPL-3.0-or-later
// Keys of stitches: [[stitch]] of a fabric.
#pragma once

#include "core/input/keys/schema_case.hpp"

namespace plyform {

/// Rows below fabrics.NAME.
Rows stitch_rows();

} // namespace plyform
