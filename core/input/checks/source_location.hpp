// SPDX-License-Identifier: GPL-3.0-or-later
// Where the parts of a case stand in its file, for what is found in the scene as a whole.
#pragma once

#include "base/diagnostics.hpp"

#include <string>
#include <vector>

namespace plyform {

/// Position of a part of the case in the file, for errors that are found in the scene as a whole.
struct SourceLocation {
  Place at;
  std::string item;
  double scale = 1.0;       ///< mm per unit of its file, of tools and blanks that give one
  bool scale_given = false; ///< in the case, rather than a default
};

struct CaseParts {
  std::vector<SourceLocation> blanks, plies, tools, boundaries;
  SourceLocation gravity, solver; ///< tables or values, or the file where they are not given
};

} // namespace plyform
