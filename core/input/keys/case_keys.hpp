// SPDX-License-Identifier: GPL-3.0-or-later
// The keys of case and fabric files as users see them: the table that `plyform keys` prints, and
// what --set changes.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace plyform {

/// One --set KEY=VALUE: dotted path with list items by number from 0 (ply.2.angle), and TOML value
/// (a bare word that is not a TOML value is read as a string).
using Override = std::pair<std::string, std::string>;

/// One row of `plyform keys`.
struct KeyInfo {
  std::string key;      ///< dotted path; [[tool]] items as tool[].radius
  std::string type;     ///< number, integer, string, boolean, list of ...
  std::string unit;     ///< mm, N, s, deg, g/m2, 1/mm, - ...
  std::string fallback; ///< default as TOML, or "required", or "required for ..."
  std::string range;    ///< "> 0", "[0, 1]", "one of ..."
  std::string meaning;
};

/// Every key of case and fabric files, from the table the reader itself uses.
std::vector<KeyInfo> case_keys();

} // namespace plyform
