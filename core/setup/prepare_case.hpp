// SPDX-License-Identifier: GPL-3.0-or-later
// From a case file to the scene that will run: read as it is, the cost parameters for the accuracy
// asked for, checked as a whole and meshed, once.
#pragma once

#include "core/input/case_file.hpp"

namespace plyform {

/// What a case says once its cost parameters are picked; its scene is not checked yet.
struct PickedCase {
  CaseReading reading;
  double coarsening = 1.0; ///< element sizes over those of the file, for the accuracy asked for
  std::vector<std::string> notes; ///< what the accuracy asked for did not change, a sentence each
};

/// read_case, pick_cost_parameters. What an override sets stays as it is where an accuracy is asked
/// for: the others are picked around it, and a note says so.
PickedCase pick_case(const std::filesystem::path& file, const std::vector<Override>& overrides);

struct PreparedCase {
  std::optional<Case> value;     ///< only when there is no error
  std::vector<BlankMesh> meshes; ///< of its plies, one each
  double coarsening = 1.0;       ///< as of PickedCase
  std::vector<CaseError> errors;
  std::vector<std::string> warnings;
  std::vector<std::string> notes; ///< as of PickedCase
};

/// pick_case, check_case.
PreparedCase prepare_case(const std::filesystem::path& file,
                          const std::vector<Override>& overrides);

} // namespace plyform
