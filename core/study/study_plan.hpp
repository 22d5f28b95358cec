// SPDX-License-Identifier: GPL-3.0-or-later
// From a study to the list of its runs, and to the points of its chart, each of them one run.
#pragma once

#include "core/input/toml_tree.hpp"
#include "core/study/study.hpp"

#include <limits>
#include <string>
#include <vector>

namespace plyform {

/// One call of `plyform run`.
struct StudyRun {
  std::string name;                  ///< of its folder: fibre_softening=30
  std::vector<std::string> settings; ///< KEY=VALUE
  std::string accuracy;              ///< of --accuracy; empty: not given
  /// What the results depend on besides the threads: version, settings, and a hash of the case file
  /// and all files it names.
  std::string inputs;
};

enum class PointKind { reference, plain, preset, dial };

/// One row of chart.csv.
struct StudyPoint {
  PointKind kind = PointKind::plain;
  std::string line{};    ///< dial's name, preset, reference or case
  std::string setting{}; ///< what makes this run: KEY=VALUE, a preset's name
  std::string label{};   ///< the same, short
  int dial = -1;         ///< index into Study::dials
  std::size_t run = 0;   ///< index into StudyPlan::runs
  /// Of a dial: the value as a number, NaN for a word.
  double value = std::numeric_limits<double>::quiet_NaN();
};

struct StudyPlan {
  std::vector<StudyRun> runs;     ///< the reference, which takes longest, first
  std::vector<StudyPoint> points; ///< reference, case, presets, dials
  /// By dial: the case's own value, a factor of 1 for element_size; NaN where it is no number.
  std::vector<double> own;
};

/// The runs of a study. A dial's value that is the case's own is the case's run, not one more.
/// Throws std::runtime_error if the case cannot be read (any more).
StudyPlan plan_study(const Study& study);

/// The case as it stands in its file, with settings done and defaults put in; nothing and reports
/// if it cannot be read.
std::optional<TomlNode> case_entries(const std::filesystem::path& file,
                                     const std::vector<Override>& settings,
                                     Diagnostics& diagnostics);

/// A setting for each blank that has an element_size: its own times `factor`.
std::vector<std::string> element_size_settings(const TomlNode& root, double factor);

/// A name as a part of a file name: letters, digits, . + - _; everything else becomes _.
std::string file_name_of(const std::string& text);

} // namespace plyform
