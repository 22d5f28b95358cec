// SPDX-License-Identifier: GPL-3.0-or-later
// Work on files that a library may crash on, in a process of its own.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace plyform {

struct HelperLimits {
  unsigned seconds = 10;       ///< of processor time
  std::size_t bytes = 1 << 30; ///< of memory beyond that of this process
};

struct HelperResult {
  enum class End {
    done,    ///< text: what the work returned
    refused, ///< text: of its exception
    crashed, ///< text: how, "ended by signal 11"
    timeout,
  } end = End::done;
  std::string text;
};

/// Calls `work` in a copy of this process and brings back what it returns or throws. What it
/// changes in memory stays there. Throws std::runtime_error if no process can be had.
HelperResult in_helper_process(const std::function<std::string()>& work, HelperLimits limits);

} // namespace plyform
