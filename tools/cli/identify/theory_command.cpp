// SPDX-License-Identifier: GPL-3.0-or-later
// plyform theory: fabric file -> the curve that a shear test should give.
#include "base/format.hpp"
#include "base/write_whole.hpp"
#include "core/identify/stitch_load.hpp"
#include "tools/cli/identify/identify_parts.hpp"

namespace plyform {

int theory_command(const TheoryArguments& arguments) {
  Diagnostics diagnostics;
  check_output("--output", arguments.output, {arguments.fabric}, diagnostics);
  const std::optional<ShearTest> test = test_of(arguments.test, arguments.specimen, diagnostics);
  const FabricReading fabric = fabric_of(arguments.fabric, true, diagnostics);
  for (const std::string& missing : fabric.missing)
    if (missing == "shear")
      diagnostics.error({arguments.fabric, 1, 1}, "shear", "", "is missing",
                        "give the law of shear, or identify it from a measured curve");
  if (!(arguments.to > 0.0 && arguments.to < 90.0))
    option_error("--to", fmt::format("{:g}", arguments.to), "must be above 0 and below 90",
                 "give the last shear angle, in degrees", diagnostics);
  if (arguments.points < 1 || arguments.points > 1000000)
    option_error("--points", fmt::format("{}", arguments.points), "must be 1 to 1000000",
                 "give the number of rows", diagnostics);
  if (print_diagnostics(diagnostics)) return exit_case_wrong;
  std::string rows = "displacement_mm,shear_deg,force_N\n";
  const double end = extension_at(*test, arguments.to * degree);
  const double bending = in_plane_bending_share(*test, *fabric.value).mean();
  for (int i = 0; i <= arguments.points; ++i) {
    const double d = end * i / arguments.points;
    const double angle = shear_angle(*test, d) / degree;
    const double load =
        (1.0 + bending) * test_load(*test, *fabric.value, d, arguments.negative) +
        stitch_load(*test, *fabric.value, stitches_of(*fabric.value), d, arguments.negative);
    rows += fmt::format("{:.9g},{:.9g},{:.9g}\n", d, arguments.negative ? -angle : angle, load);
  }
  if (bending > 0.0)
    fmt::print("in-plane bending adds {:.2g} % to the load by (40)\n", 100.0 * bending);
  if (!fabric.value->stitches.empty())
    fmt::print("stitches pull beside the crossing, and break for good\n");
  write_whole(arguments.output, rows);
  fmt::print("written: {}, {} rows\n", arguments.output, arguments.points + 1);
  return exit_done;
}

} // namespace plyform
