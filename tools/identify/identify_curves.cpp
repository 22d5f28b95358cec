// SPDX-License-Identifier: GPL-3.0-or-later
// The curves that plyform identify is given: FILE or FILE:COLUMN, and what a curve of a shear test
// is made ready with before a law is fitted to it.
#include "base/format.hpp"
#include "base/text.hpp"
#include "core/identify/measured_angle.hpp"
#include "core/identify/normalised_force.hpp"
#include "core/identify/slip.hpp"
#include "tools/identify/identify_parts.hpp"
#include "tools/identify/identify_rubber.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

namespace fs = std::filesystem;

bool is_file(const std::string& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

bool all_normalised(const std::vector<Curve>& curves) {
  return std::all_of(curves.begin(), curves.end(),
                     [](const Curve& curve) { return curve.y_is == Quantity::force_per_length; });
}

bool any_normalised(const std::vector<Curve>& curves) {
  return std::any_of(curves.begin(), curves.end(),
                     [](const Curve& curve) { return curve.y_is == Quantity::force_per_length; });
}

/// Whether the user corrects an extension, so that it counts.
bool corrects_extension(const FitOptions& options) {
  return options.corrections.compliance.value_or(0.0) > 0.0 || options.corrections.fit_slip;
}

std::string percent_more(double share) {
  return fmt::format("{:+.2g} %", 100.0 * share);
}

/// What a report says where the angle was measured.
std::vector<std::string> lines_of(const SlipEffect& effect) {
  std::vector<std::string> angles, torques;
  for (const SlipAt& at : effect.at) {
    if (std::isnan(at.formula)) continue;
    const double degrees = at.angle / degree;
    angles.push_back(fmt::format("{:.1f} degrees for {:g}", at.formula / degree, degrees));
    if (!std::isnan(at.torque))
      torques.push_back(fmt::format("{} at {:g}", percent_more(at.torque), degrees));
  }
  std::vector<std::string> lines;
  if (!angles.empty())
    lines.push_back(fmt::format(
        "the formula without slip would say {}; torque of a law by it {}", joined(angles),
        effect.refusal.empty() ? joined(torques) + " degrees" : "none: " + effect.refusal));
  lines.push_back(fmt::format("{:.2g} % of the work of the load goes into what slips or gives way; "
                              "were it shear, the torque would be {:.2g} % larger in the mean",
                              100.0 * effect.work, 100.0 * effect.work / (1.0 - effect.work)));
  return lines;
}

/// What it says where it was not.
std::string possible_line(const SlipEffect& effect) {
  std::vector<std::string> torques;
  for (const SlipAt& at : effect.at)
    torques.push_back(fmt::format("{} at {:g}", percent_more(at.torque), at.angle / degree));
  return fmt::format(
      "yarns slip in such tests from about {:g} degrees on: with the lag of the middle behind the "
      "formula measured of a plain weave, 4 degrees at 26 and 8.5 at 44, of which up to 3.5 are "
      "an uneven middle and no slip, this torque would be off by {}; --to {:g} leaves it "
      "out, --angle-column or --angle-file takes a measured angle",
      slip_begins / degree, torques.empty() ? "what cannot be said" : joined(torques) + " degrees",
      slip_begins / degree);
}

/// Displacement and shear angle of --angle-file.
std::optional<Curve> angles_of(const IdentifyArguments& a, Diagnostics& diagnostics) {
  const CurveArgument argument = curve_argument(a.angle_file);
  CurveColumns columns;
  columns.x_word = "displacement";
  columns.y_word = "shear angle";
  columns.y_is = Quantity::angle;
  columns.y_preferred = "shear gamma";
  columns.y_wanted = "shear angle";
  columns.y = {argument.column.empty() ? a.angle.name : argument.column, a.angle.unit};
  columns.y_option = "--angle-column";
  return read_curve(argument.file, columns, diagnostics);
}

} // namespace

CurveArgument curve_argument(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (!is_file(text) && equals != std::string::npos && equals > 0 &&
      text.substr(0, equals).find('/') == std::string::npos) {
    CurveArgument named = curve_argument(text.substr(equals + 1));
    named.laboratory = text.substr(0, equals);
    return named;
  }
  CurveArgument result{text, "", ""};
  for (std::size_t colon = text.rfind(':');
       colon != std::string::npos && colon > 0 && !is_file(result.file);
       colon = text.rfind(':', colon - 1))
    if (is_file(text.substr(0, colon)))
      result = {text.substr(0, colon), text.substr(colon + 1), ""};
  return result;
}

std::string CurveArgument::name() const {
  return fmt::format("{}{}{}", fs::path(file).filename().string(), column.empty() ? "" : ":",
                     column);
}

std::vector<Curve> curves_of(const IdentifyArguments& a, Diagnostics& diagnostics) {
  std::vector<Curve> curves;
  std::optional<Curve> angles;
  if (!a.angle_file.empty() && !(angles = angles_of(a, diagnostics))) return {};
  for (const std::string& text : a.curves) {
    const CurveArgument argument = curve_argument(text);
    CurveColumns columns = columns_of(a);
    if (!argument.column.empty()) columns.y.column = argument.column;
    if (angles) columns.with_angle = false;
    if (auto curve = read_curve(argument.file, columns, diagnostics)) {
      if (angles && !put_angles(*curve, *angles, diagnostics)) continue;
      if (!argument.column.empty())
        curve->file = fmt::format("{}:{}", curve->file, argument.column);
      curves.push_back(std::move(*curve));
    }
  }
  return curves;
}

std::string files_of(const IdentifyArguments& a) {
  std::vector<std::string> names;
  for (const std::string& curve : a.curves)
    names.push_back(curve_argument(curve).name());
  if (a.others.empty()) return joined(names);
  std::vector<std::string> others;
  for (const std::string& curve : a.others)
    others.push_back(curve_argument(curve).name());
  const char* kind = is_shear_test(a.test)    ? "; negative: "
                     : is_rubber_test(a.test) ? "; equibiaxial: "
                                              : "; weft: ";
  return joined(names) + kind + joined(others);
}

std::optional<PreparedShear> prepare_shear(const IdentifyArguments& a, std::vector<Curve>& curves,
                                           FitOptions& options, Diagnostics& diagnostics) {
  SpecimenArguments sizes = a.specimen;
  const bool frame = a.test == "frame", any_size = frame && std::isnan(sizes.side);
  auto test = any_size ? std::nullopt : test_of(a.test, sizes, diagnostics);
  if ((!any_size && !test) || curves.empty()) return std::nullopt;
  for (const Curve& curve : curves)
    if (extension_counts(a) && curve.x_name.empty()) {
      option_error("--angle-column", a.angle.name, "the curve has no extension that could count",
                   "leave it out, or name the column of the extension with --x-column",
                   diagnostics);
      return std::nullopt;
    }
  if (!options.measured_angle && !extension_counts(a) && !corrects_extension(options))
    options.measured_angle = angles_count(curves, test);
  if (any_size) {
    if (!options.measured_angle || !all_normalised(curves)) {
      option_error("--side", "",
                   "must be given: loads in N, and angles from an extension, are of a frame of "
                   "some size",
                   "give the frame's side from hinge to hinge, in mm", diagnostics);
      return std::nullopt;
    }
    sizes.side = any_side;
    test = test_of(a.test, sizes, diagnostics);
  }
  PreparedShear result{*test, {}};
  if (any_normalised(curves))
    result.assumed.push_back(fmt::format(
        "normalised shear force F L_frame / (2 cos(45 deg - g/2) L_fabric^2), N/mm, of a frame of "
        "any size; loads are of one of {:g} mm",
        sizes.side));
  if (frame)
    for (Curve& curve : curves)
      take_normalised(curve, sizes.side, options.measured_angle);
  return result;
}

std::vector<std::string> slip_lines(const IdentifyArguments& a, const std::vector<Curve>& curves,
                                    const PreparedShear& test, const Fabric& fabric,
                                    const FitOptions& options, const ShearFit& fit) {
  const bool extension = std::none_of(curves.begin(), curves.end(),
                                      [](const Curve& curve) { return curve.x_name.empty(); });
  if (options.measured_angle && extension)
    return lines_of(slip_effect(curves, test.test, fabric, options, fit.law));
  if (options.measured_angle || a.test != "bias" || !(fit.quality.to > slip_begins)) return {};
  return {possible_line(possible_slip(curves, test.test, fabric, options, fit.law))};
}

} // namespace plyform
