// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace plyform {

/// A simulation that cannot go on: says step, time, ply, element or node and value.
struct Stop {
  std::string message;
};

} // namespace plyform
