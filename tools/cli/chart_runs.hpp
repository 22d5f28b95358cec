// SPDX-License-Identifier: GPL-3.0-or-later
// The runs of a study, each a process of its own.
#pragma once

#include "core/study/study_plan.hpp"

#include <filesystem>
#include <vector>

namespace plyform {

struct RunOptions {
  std::filesystem::path folder; ///< of all runs; each has one of its own in it
  int jobs = 1;                 ///< runs at a time
  int threads = 1;              ///< of each
};

/// How the runs ended.
struct RunsEnd {
  int code = 0;                        ///< exit code for the study, 0 if it can go on
  std::vector<bool> done;              ///< by run: exit code 0, now or at an earlier time
  std::vector<std::string> troubles{}; ///< what the user should hear of, a line or more each
};

/// Runs whatever the plan has that is not done yet: a run is done if its folder has a summary.json
/// with status "done" or "doubtful" and a settings.txt that says the same inputs and threads. The
/// first run that is refused (exit code 2), the reference stopping, and Ctrl-C end all others; what
/// was finished stays. Throws std::runtime_error or std::filesystem::filesystem_error where the
/// folder cannot be written or no process be started.
RunsEnd run_all(const StudyPlan& plan, const std::filesystem::path& case_file,
                const RunOptions& options);

/// Processor time of a finished run, s; NaN if it is not known.
double cpu_time(const std::filesystem::path& run_folder);

} // namespace plyform
