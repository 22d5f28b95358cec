// SPDX-License-Identifier: GPL-3.0-or-later
// plyform identify.
#include "base/format.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/progress_line.hpp"
#include "tools/identify/identify.hpp"

namespace plyform {

bool print_diagnostics(const Diagnostics& diagnostics) {
  for (const std::string& warning : diagnostics.warnings)
    fmt::print(stderr, "{}\n", warning);
  for (const CaseError& error : diagnostics.errors)
    fmt::print(stderr, "{}\n", error.text());
  return !diagnostics.errors.empty();
}

int identify_command(const IdentifyArguments& arguments) {
  ProgressLine line;
  const Identification outcome = identify(arguments, [&](double fraction) {
    line.show("chooses the law of shear", fraction);
    if (fraction == 1.0) line.end(); // what it prints comes after
  });
  if (print_diagnostics(outcome.diagnostics)) return exit_case_wrong;
  fmt::print("{}", outcome.said);
  return exit_done;
}

} // namespace plyform
