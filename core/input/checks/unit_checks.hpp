// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies in another unit than the others: a tool mesh in inches, a drawing in metres.
//
// Sizes of a scene that can be formed stand in usual ratios to each other, seen along z: the blank
// to the tools that support it, the punch to the blank and to the opening that it goes through. If
// one of these ratios is far off, each body's sizes are multiplied by 25.4, 10, 1000 and their
// inverses; a body is suspected with the factor that brings all ratios into their ranges. Where
// several do, it is that with the least sum of squares of the logarithms of ratios over usual ones.
#pragma once

#include "core/input/checks/source_location.hpp"
#include "core/model/case.hpp"

#include <optional>

namespace plyform {

struct UnitSuspicion {
  SourceLocation at; ///< of the body
  std::string name;  ///< of a tool; empty for a blank
  std::string rule, remedy;
  bool is_drawing = false; ///< whose scale is not given: a mistake of the file, until it is
  bool from_file = false;  ///< its sizes; else they are numbers of the case
};

/// The body that is suspected, if any. broken: whether the scene cannot work as it is; then sizes
/// that are usual in some scenes count too, as of a punch wider than its opening.
std::optional<UnitSuspicion> suspect_unit(const Case& scene, const CaseParts& parts, bool broken);

} // namespace plyform
