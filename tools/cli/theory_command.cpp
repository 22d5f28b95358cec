// SPDX-License-Identifier: GPL-3.0-or-later
// plyform theory: fabric file -> the curve that a shear test should give.
#include "base/format.hpp"
#include "base/write_whole.hpp"
#include "tools/cli/commands.hpp"
#include "tools/identify/identify_parts.hpp"
#include "tools/identify/theory.hpp"

namespace plyform {

int theory_command(const TheoryArguments& arguments) {
  Diagnostics diagnostics;
  check_output("--output", arguments.output, {arguments.fabric}, diagnostics);
  const auto curve = theory_curve(arguments, diagnostics);
  if (print_diagnostics(diagnostics)) return exit_case_wrong;
  std::string rows = "displacement_mm,shear_deg,force_N\n";
  for (std::size_t i = 0; i < curve->force.size(); ++i)
    rows += fmt::format("{:.9g},{:.9g},{:.9g}\n", curve->displacement[i], curve->shear_deg[i],
                        curve->force[i]);
  if (curve->bending > 0.0)
    fmt::print("in-plane bending adds {:.2g} % to the load by (40)\n", 100.0 * curve->bending);
  if (curve->stitched) fmt::print("stitches pull beside the crossing, and break for good\n");
  write_whole(arguments.output, rows);
  fmt::print("written: {}, {} rows\n", arguments.output, arguments.points + 1);
  return exit_done;
}

} // namespace plyform
