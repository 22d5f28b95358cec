// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the simulations of a study, each in a process of its own.
#pragma once

#include "core/study/study_plan.hpp"

#include <filesystem>
#include <vector>

namespace plyform {

struct RunOptions {
  std::filesystem::path folder; ///< of the study; each run has a folder of its own in it
  int jobs = 1;                 ///< number of simultaneous runs
  int threads = 1;              ///< threads per run
};

/// How the runs ended.
struct RunsEnd {
  int code = 0;                        ///< exit code for the study, 0 if it can go on
  std::vector<bool> done;              ///< per run: exit code 0, now or at an earlier time
  std::vector<std::string> troubles{}; ///< messages for the user, one or more lines each
};

/// Runs all runs of the plan that are not done yet: a run is done if its folder has a summary.json
/// with status "done" or "doubtful" and a settings.txt with the same inputs and threads. The first
/// run whose case is rejected (exit code 2), a reference that stops, and Ctrl-C end all others;
/// finished runs are kept. Throws std::runtime_error or std::filesystem::filesystem_error if the
/// folder cannot be written or a process cannot be started.
RunsEnd run_all(const StudyPlan& plan, const std::filesystem::path& case_file,
                const RunOptions& options);

/// Processor time of a finished run, s; NaN if it is not known.
double cpu_time(const std::filesystem::path& run_folder);

} // namespace plyform
