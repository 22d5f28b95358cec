// SPDX-License-Identifier: GPL-3.0-or-later
// What `plyform run --verify` does after the run: siblings, and a second run if the accuracy asked
// for was missed.
#pragma once

#include "core/results/result_writer.hpp"
#include "core/run/progress_file.hpp"
#include "core/run/run.hpp"
#include "core/setup/prepare_case.hpp"
#include "core/verification/trace.hpp"

#include <atomic>
#include <filesystem>

namespace plyform {

struct VerifyOptions {
  std::filesystem::path folder; ///< of the run
  int threads = 1;
  bool any_size = false; ///< of the second run
  const std::atomic<bool>* interrupt = nullptr;
  ProgressFile* file = nullptr; ///< of the run; never null
  Trace trace{};                ///< of the run, with states
};

/// Verifies a run that has ended and writes its summary again, with the bands. If shear angles are
/// not as near as the case asks for, runs it again once with corrected cost parameters; that run
/// then takes the place of the first one in `result` and in the folder, the files of the first go
/// to FOLDER/first_run. Says on standard error what it does. If it is interrupted, or the second
/// run does not end, the first one stays where it is.
void verify_and_correct(const PreparedCase& prepared, const VerifyOptions& options,
                        ResultWriter& writer, RunResult& result);

void print_verification(const Verification& verification);

} // namespace plyform
