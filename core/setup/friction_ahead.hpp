// SPDX-License-Identifier: GPL-3.0-or-later
// What `plyform check` says of laws of friction with rates: the slip speeds and Hersey numbers that
// a run will reach, beside what their curves hold.
#pragma once

#include "core/model/case.hpp"

#include <string>
#include <vector>

namespace plyform {

/// Lines; those of a curve that does not reach so far start with "    warning: ". Faces slide on
/// each other at most as fast as the fastest tool, grip or frame moves.
std::vector<std::string> friction_ahead(const Case& data);

} // namespace plyform
