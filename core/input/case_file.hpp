// SPDX-License-Identifier: GPL-3.0-or-later
// From case.toml (and the fabric files it names) to a Case, with every mistake found at once.
#pragma once

#include "core/base/diagnostics.hpp"
#include "core/mesh/mesh_blank.hpp"
#include "core/model/case.hpp"

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace plyform {

/// Where a part of the case stands in the file, for mistakes found in the scene as a whole.
struct SourceLocation {
  Place at;
  std::string item;
};

struct CaseParts {
  std::vector<SourceLocation> blanks, plies, tools, boundaries;
};

/// What a case file and the overrides say, before anything is made of it.
struct CaseReading {
  std::filesystem::path file;
  std::optional<Case> value;        ///< only when there is no error
  CaseParts parts;                  ///< where they stand
  std::set<std::string> overridden; ///< keys that overrides gave, as dotted paths
  std::vector<CaseError> errors;
  std::vector<std::string> warnings;
};

/// One --set KEY=VALUE: dotted path with list items by number from 0 (ply.2.angle), TOML value
/// (a bare word that is no TOML value is taken as a string).
using Override = std::pair<std::string, std::string>;

/// Reads, overrides, checks against the table of keys; files are sought relative to the file that
/// names them. An error in an override is reported with file "--set", line 1, and the column within
/// KEY=VALUE. Never throws for anything that stands in the files. The case is as it is written, but
/// for fabrics whose missing numbers are estimated (core/model/fabric_estimates.hpp): an accuracy
/// that it asks for, and the check of the whole scene, are left to the caller
/// (core/setup/prepare_case.hpp).
CaseReading read_case(const std::filesystem::path& file, const std::vector<Override>& overrides);

/// Checks the scene that will run, reading.value: blanks that cannot be meshed, plies overlapping
/// at the start, a tool inside a ply, tool clearance less than the stack, meshes too coarse. Adds
/// to the mistakes and warnings; with a mistake there is no value any more. Returns the meshes of
/// the plies, one each.
std::vector<BlankMesh> check_case(CaseReading& reading);

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
