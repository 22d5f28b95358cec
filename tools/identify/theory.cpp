// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/identify/theory.hpp"

#include "base/format.hpp"
#include "core/identify/stitch_load.hpp"
#include "tools/identify/identify_parts.hpp"

namespace plyform {

std::optional<TheoryCurve> theory_curve(const TheoryArguments& arguments,
                                        Diagnostics& diagnostics) {
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
  if (!diagnostics.errors.empty()) return std::nullopt;
  TheoryCurve curve;
  const double end = extension_at(*test, arguments.to * degree);
  curve.bending = in_plane_bending_share(*test, *fabric.value).mean();
  curve.stitched = !fabric.value->stitches.empty();
  for (int i = 0; i <= arguments.points; ++i) {
    const double d = end * i / arguments.points;
    const double angle = shear_angle(*test, d) / degree;
    curve.displacement.push_back(d);
    curve.shear_deg.push_back(arguments.negative ? -angle : angle);
    curve.force.push_back(
        (1.0 + curve.bending) * test_load(*test, *fabric.value, d, arguments.negative) +
        stitch_load(*test, *fabric.value, stitches_of(*fabric.value), d, arguments.negative));
  }
  return curve;
}

} // namespace plyform
