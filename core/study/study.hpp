// SPDX-License-Identifier: GPL-3.0-or-later
// A study: one case over settings of its dials, for `plyform chart`. From its file to plain data,
// with every mistake found at once; docs/users/chart.md describes the file.
#pragma once

#include "core/input/case_file.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace plyform {

/// The key of a dial that stands for the element_size of all blanks; its values are factors.
inline constexpr const char* element_size_key = "element_size";

struct StudyDial {
  std::string name;
  std::string key;                 ///< dotted path as in --set, or element_size_key
  std::vector<std::string> values; ///< as they stand behind KEY= in --set
};

/// What the reference run is finer by: factors of the case's own values.
struct StudyReference {
  double step = 0.5;                 ///< of solver.step_factor
  double duration = 2.0;             ///< of solver.duration
  double element_size = 0.5;         ///< of every blank's element_size
  std::vector<std::string> settings; ///< KEY=VALUE, before the factors
};

struct Study {
  std::string title;
  std::filesystem::path case_file;
  std::vector<std::string> settings; ///< KEY=VALUE, of every run
  std::vector<std::string> presets{"draft", "standard", "reference"};
  StudyReference reference;
  std::vector<StudyDial> dials;
};

struct StudyReading {
  std::optional<Study> value; ///< only when there is no error
  std::vector<CaseError> errors;
};

/// Reads a study and checks it whole: its own keys, the case it names, and that case with the
/// settings of each run, so that no run is started that would be refused. A mistake of the case
/// itself is told with its place in the case, every other with its place in the study. Never throws
/// for anything that stands in the files.
StudyReading read_study(const std::filesystem::path& file);

/// KEY=VALUE as an override; nothing if it is none.
std::optional<Override> split_setting(const std::string& setting);

/// The same of a list, whose items all must be KEY=VALUE.
std::vector<Override> split_settings(const std::vector<std::string>& settings);

} // namespace plyform
