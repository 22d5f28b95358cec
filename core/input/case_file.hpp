// SPDX-License-Identifier: GPL-3.0-or-later
// Reads case.toml (and the fabric files that it names) into a Case, and reports all errors at once.
#pragma once

#include "base/diagnostics.hpp"
#include "core/mesh/mesh_blank.hpp"
#include "core/model/case.hpp"

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <utility>
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

/// Result of reading a case file with overrides.
struct CaseReading {
  std::filesystem::path file;
  std::optional<Case> value;        ///< only when there is no error
  CaseParts parts;                  ///< positions in the file
  std::set<std::string> overridden; ///< keys set by overrides, as dotted paths
  std::string identity; ///< version of plyform, every key with its value, and the files they name
  std::vector<CaseError> errors;
  std::vector<std::string> warnings;
};

/// One --set KEY=VALUE: dotted path with list items by number from 0 (ply.2.angle), and TOML value
/// (a bare word that is not a TOML value is read as a string).
using Override = std::pair<std::string, std::string>;

/// Reads a case file, applies overrides and checks keys and values against the table of keys. Paths
/// are relative to the file that contains them. An error in an override is reported with file
/// "--set", line 1, and the column within KEY=VALUE. Never throws because of the content of the
/// files. Missing values of fabrics are estimated (core/model/fabric_estimates.hpp); a requested
/// accuracy is not applied, and the scene as a whole not checked: core/setup/prepare_case.hpp does
/// both.
CaseReading read_case(const std::filesystem::path& file, const std::vector<Override>& overrides);

/// Checks the scene that will run, reading.value: blanks that cannot be meshed, plies overlapping
/// at the start, a tool inside a ply, tool clearance less than the stack, meshes too coarse. Adds
/// to errors and warnings; if there is an error, reading.value is reset. Returns the meshes of the
/// plies, one per ply.
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
