// SPDX-License-Identifier: GPL-3.0-or-later
// What could be read of a case file that has mistakes, for a picture of it.
#pragma once

#include "core/input/checks/source_location.hpp"
#include "core/model/case.hpp"

#include <set>
#include <string>
#include <vector>

namespace plyform {

/// Words of a case file that a Case has as numbers, in the order of its parts: as they stand there,
/// whether they name anything or not; empty where they are missing or no strings.
struct CaseWords {
  std::vector<std::string> ply_fabrics, ply_blanks, tool_shapes, boundary_kinds;
};

/// A case as far as it could be read. Parts in which no mistake is are as in a case without any;
/// others may hold NaN, numbers of parts that are not there, and what contradicts itself.
struct CaseSketch {
  Case data;
  std::set<std::string> mistaken; ///< dotted paths of what mistakes name

  /// The keys of a part that mistakes name, sorted: "radius" for tool.1.radius and what is inside.
  /// An empty one stands for the part itself, or for what it is in. part: dotted path, tool.1.
  std::vector<std::string> mistaken_keys(const std::string& part) const;
};

} // namespace plyform
