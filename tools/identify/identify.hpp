// SPDX-License-Identifier: GPL-3.0-or-later
// From measured curves to a law in a fabric file, or in a part of a case.
#pragma once

#include "base/diagnostics.hpp"
#include "tools/identify/arguments.hpp"

#include <functional>

namespace plyform {

struct Identification {
  Diagnostics diagnostics; ///< errors: nothing was found, and nothing written but the report
  std::string said;        ///< what was found, for people
};

/// Reads the curves, finds the law and writes arguments.output, its fit and its report. `progress`:
/// fraction of a choice that takes seconds; may be empty. Throws std::runtime_error for a file that
/// cannot be written.
Identification identify(const IdentifyArguments& arguments,
                        const std::function<void(double fraction)>& progress);

} // namespace plyform
