// SPDX-License-Identifier: GPL-3.0-or-later
// Reads case.toml (and the fabric files that it names) into a Case, and reports all errors at once.
#pragma once

#include "core/input/case_sketch.hpp"
#include "core/input/checks/source_location.hpp"
#include "core/input/keys/case_keys.hpp"
#include "core/mesh/mesh_blank.hpp"
#include "core/model/case.hpp"

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace plyform {

/// Result of reading a case file with overrides.
struct CaseReading {
  std::filesystem::path file;
  std::optional<Case> value;        ///< only when there is no error
  CaseParts parts;                  ///< positions in the file; of one with errors too
  CaseWords words;                  ///< likewise
  CaseSketch sketch;                ///< of a file with errors
  std::set<std::string> overridden; ///< keys set by overrides, as dotted paths
  std::string identity; ///< version of plyform, every key with its value, and the files they name
  std::vector<std::pair<std::string, std::string>> given; ///< core/input/keys/given_values.hpp
  std::vector<CaseError> errors;
  std::vector<std::string> warnings;
};

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

} // namespace plyform
