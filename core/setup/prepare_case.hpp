// SPDX-License-Identifier: GPL-3.0-or-later
// Prepares a case file for a run: reads it, sets the cost parameters for the requested accuracy,
// checks the whole scene and meshes the blanks.
#pragma once

#include "core/accuracy/cost_parameters.hpp"
#include "core/input/case_file.hpp"

namespace plyform {

/// A case with the cost parameters chosen; its scene is not checked yet.
struct PickedCase {
  CaseReading reading;
  double coarsening = 1.0; ///< element sizes over those of the file, for the requested accuracy
  /// parameters that the requested accuracy did not change, a sentence each
  std::vector<std::string> notes;
  FixedParameters fixed; ///< those set by an override
};

/// read_case, pick_cost_parameters. Parameters set by an override are fixed for
/// pick_cost_parameters, which chooses the others around them; a note says so.
PickedCase pick_case(const std::filesystem::path& file, const std::vector<Override>& overrides);

/// Whether a case may be of any size, or one that is too_large (size_ahead.hpp) is an error before
/// its blanks are meshed, and by the meshes that were made.
enum class CaseSize { any, sensible };

struct PreparedCase {
  std::optional<Case> value;                              ///< only when there is no error
  std::vector<BlankMesh> meshes;                          ///< one per ply
  double coarsening = 1.0;                                ///< as in PickedCase
  std::string identity;                                   ///< as in CaseReading
  std::vector<std::pair<std::string, std::string>> given; ///< likewise
  std::vector<CaseError> errors;
  std::vector<std::string> warnings;
  std::vector<std::string> notes; ///< as in PickedCase
  FixedParameters fixed;          ///< as in PickedCase
  CaseParts parts = {};           ///< where they stand
  CaseSize size = CaseSize::any;
  std::optional<Case> whole = {}; ///< of which `value` is a part: core/setup/part_of_scene.hpp
};

/// pick_case, check_case.
PreparedCase prepare_case(const std::filesystem::path& file, const std::vector<Override>& overrides,
                          CaseSize size = CaseSize::any);

/// Reports that the case with its meshes is too large, if it is and must not be; it has no value
/// then.
void check_meshes(PreparedCase& prepared);

} // namespace plyform
