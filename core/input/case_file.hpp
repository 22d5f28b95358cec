// SPDX-License-Identifier: GPL-3.0-or-later
// From case.toml (and the fabric files it names) to a Case, with every mistake found at once.
#pragma once

#include "core/base/diagnostics.hpp"
#include "core/model/case.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace plyform {

struct CaseReading {
  std::optional<Case> value; ///< only when there is no error
  std::vector<CaseError> errors;
  std::vector<std::string> warnings;
};

/// One --set KEY=VALUE: dotted path with list items by number from 0 (ply.2.angle), TOML value
/// (a bare word that is no TOML value is taken as a string).
using Override = std::pair<std::string, std::string>;

/// Reads, overrides, validates; files are sought relative to the file that names them. Also checks
/// the scene as a whole: plies overlapping at the start, a tool inside a ply, tool clearance less
/// than the stack. An error in an override is reported with file "--set", line 1, and the column
/// within KEY=VALUE. Never throws for anything that stands in the files.
CaseReading read_case(const std::filesystem::path& file, const std::vector<Override>& overrides);

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
