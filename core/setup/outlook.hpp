// SPDX-License-Identifier: GPL-3.0-or-later
// What will be modelled, what to look at before, and how long it takes.
#pragma once

#include "core/setup/prepare_case.hpp"

#include <functional>
#include <string>
#include <vector>

namespace plyform {

struct Outlook {
  /// As `plyform check` prints them; those of a part that need a look start with "    warning: "
  /// or "    note: ".
  std::vector<std::string> lines;
  double stable_step = 0.0, step = 0.0; ///< s, at the start: stable, and used
  double steps = 0.0;                   ///< about, in the whole run
  double seconds = 0.0;                 ///< about, wall time of it
  std::string stop;                     ///< why the first steps went wrong; else empty
};

/// What is looked at now, and the fraction of all that is done; some ten times in the whole.
using OutlookProgress = std::function<void(const std::string& words, double fraction)>;

/// Makes the scene of a case without mistakes and times some steps of it. Of a mesh that is still
/// to be found from the scene nothing is said of where it is too coarse for a tool: it will not be.
Outlook look_ahead(const PreparedCase& prepared, int threads, const OutlookProgress& progress = {},
                   bool mesh_to_come = false);

} // namespace plyform
