// SPDX-License-Identifier: GPL-3.0-or-later
// The commands of plyform, one file each. Each returns the exit code.
#pragma once

#include "core/case.hpp"

#include <optional>
#include <string>
#include <vector>

namespace plyform {

enum ExitCode { exit_done = 0, exit_other = 1, exit_case_wrong = 2, exit_stopped = 3 };

/// What names a case on the command line.
struct CaseArguments {
  std::string file;                  ///< case.toml, or its folder
  std::vector<std::string> settings; ///< KEY=VALUE
  std::string accuracy = "standard";
};

struct RunArguments {
  CaseArguments input;
  std::string output;
  int threads = 0; ///< 0: as many as there are cores
};

/// Reads the case; prints every mistake to standard error and returns nothing if there is one.
std::optional<Case> load_case(const CaseArguments& arguments);

int run_command(const RunArguments& arguments);
int check_command(const CaseArguments& arguments);
int keys_command();

} // namespace plyform
