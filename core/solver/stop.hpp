// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace plyform {

/// Reason why a simulation cannot go on: names step, time, ply, element or node and value.
struct Stop {
  std::string message;
};

} // namespace plyform
