// SPDX-License-Identifier: GPL-3.0-or-later
// plyform identify: measured curve -> law -> fabric file. plyform theory: fabric file -> curve.
#include "core/base/version.hpp"
#include "core/fit/fit_shear.hpp"
#include "core/input/fabric_file.hpp"
#include "core/results/result_fields.hpp"
#include "tools/cli/commands.hpp"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <numbers>

namespace plyform {
namespace {

namespace fs = std::filesystem;
constexpr double deg = std::numbers::pi / 180.0;

void option_error(const std::string& option, const std::string& value, const std::string& rule,
                  const std::string& remedy, Diagnostics& diagnostics) {
  diagnostics.error({option, 1, 1}, option.substr(2), value, rule, remedy);
}

/// Prints warnings, then errors; returns whether there are errors.
bool print(const Diagnostics& diagnostics) {
  for (const std::string& warning : diagnostics.warnings)
    fmt::print(stderr, "{}\n", warning);
  for (const CaseError& error : diagnostics.errors)
    fmt::print(stderr, "{}\n", error.text());
  return !diagnostics.errors.empty();
}

bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  return fs::weakly_canonical(a, ignored) == fs::weakly_canonical(b, ignored) ||
         fs::equivalent(a, b, ignored);
}

/// Reports an error if an output file is one of the other files read or written, or if its
/// temporary name is.
void check_output(const std::string& option, const fs::path& output,
                  const std::vector<fs::path>& others, Diagnostics& diagnostics) {
  fs::path temporary = output;
  temporary += ".tmp";
  for (const fs::path& other : others)
    if (same_file(output, other) || same_file(temporary, other))
      option_error(option, output.string(), "would overwrite " + other.string(),
                   "give another file", diagnostics);
}

/// The test of the arguments; reports errors and returns nothing if its sizes are invalid.
std::optional<ShearTest> test_of(const std::string& name, const SpecimenArguments& sizes,
                                 Diagnostics& diagnostics) {
  const BiasSpecimen bias{sizes.length, sizes.width};
  const FrameSpecimen frame{sizes.side};
  const auto fault = name == "bias" ? fault_of(bias) : fault_of(frame);
  if (!fault) return name == "bias" ? shear_test(bias) : shear_test(frame);
  option_error("--" + fault->size, fmt::format("{:g}", fault->value), fault->rule, fault->remedy,
               diagnostics);
  return std::nullopt;
}

/// Reads the fabric; its errors are added to `diagnostics`.
FabricReading fabric_of(const std::string& file, bool for_shear, Diagnostics& diagnostics) {
  FabricReading reading = read_fabric_file(file, true);
  diagnostics.errors.insert(diagnostics.errors.end(), reading.errors.begin(), reading.errors.end());
  if (reading.value && for_shear &&
      std::abs(reading.value->fibre_angle - 0.5 * std::numbers::pi) > 1e-6)
    diagnostics.error({file, 1, 1}, "fibre_angle",
                      fmt::format("{:g}", reading.value->fibre_angle / deg),
                      "must be 90 degrees: the theory of the shear tests is for such fabrics",
                      "take the law from a test of your own evaluation and write it in by hand");
  return reading;
}

void check_range(const IdentifyArguments& arguments, bool shear, Diagnostics& diagnostics) {
  const double most = shear ? 90.0 : std::numeric_limits<double>::infinity();
  if (!(arguments.from >= 0.0 && arguments.from < most))
    option_error("--from", fmt::format("{:g}", arguments.from),
                 shear ? "must be at least 0 and below 90" : "must be at least 0",
                 shear ? "give a shear angle in degrees" : "give a strain", diagnostics);
  else if (!(arguments.to > arguments.from))
    option_error("--to", fmt::format("{:g}", arguments.to),
                 fmt::format("must be greater than --from, {:g}", arguments.from),
                 shear ? "give a shear angle in degrees" : "give a strain", diagnostics);
}

/// An identified law as text for the report and the fabric file.
struct Identified {
  LawText law;
  std::string fit;                  ///< CSV
  std::string law_line;             ///< for the report
  std::vector<std::string> figures; ///< range, residuals
};

std::string figure_of_residuals(const FitQuality& quality, const std::string& at) {
  return fmt::format("residuals {:.2g} % of the load rms, {:.2g} % at most, at {}",
                     100.0 * quality.rms, 100.0 * quality.largest, at);
}

Identified shear_text(const ShearFit& fit) {
  Identified result;
  std::string numbers, names;
  for (std::size_t i = 0; i < fit.law.k.size(); ++i) {
    numbers += fmt::format("{}{:.7g}", i ? ", " : "", fit.law.k[i]);
    names += fmt::format("{}k{} = {:.5g}", i ? ", " : "", 2 * i + 1, fit.law.k[i]);
  }
  result.law = {"shear", "polynomial", "[" + numbers + "]", {}};
  result.law_line = names + " N mm: torque of one unit cell = k1 g + k3 g^3 + ..., g in rad";
  const FitQuality& q = fit.quality;
  result.figures = {fmt::format("{} rows, shear angle {:.3g} to {:.3g} degrees", q.rows,
                                q.from / deg, q.to / deg),
                    figure_of_residuals(q, fmt::format("{:.3g} degrees", q.largest_at / deg))};
  if (fit.in_plane.most > 0.0)
    result.figures.push_back(fmt::format(
        "in-plane bending adds {:.2g} to {:.2g} % to the load of shear: {:.2g} % taken off",
        100.0 * fit.in_plane.least, 100.0 * fit.in_plane.most, 100.0 * fit.in_plane.mean()));
  result.fit = "displacement_mm,shear_deg,measured_N,fitted_N\n";
  for (std::size_t i = 0; i < fit.angle.size(); ++i)
    result.fit += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g}\n", fit.extension[i], fit.angle[i] / deg,
                              fit.measured[i], fit.fitted[i]);
  return result;
}

Identified tension_text(const TensionFit& fit, const std::string& yarns) {
  Identified result;
  if (fit.law.strain.empty()) {
    result.law = {yarns, "stiffness", fmt::format("{:.7g}", fit.law.stiffness), {}};
    result.law_line = fmt::format("stiffness = {:.5g} N per yarn", fit.law.stiffness);
  } else {
    std::string rows = "[";
    for (std::size_t i = 0; i < fit.law.strain.size(); ++i)
      rows += fmt::format("\n    [{:.9g}, {:.7g}],", fit.law.strain[i], fit.law.tension[i]);
    result.law = {yarns, "table", rows + "\n]", {}};
    result.law_line =
        fmt::format("table of {} rows, up to {:.4g} N per yarn at a strain of {:.4g}; no line fits",
                    fit.law.strain.size(), fit.law.tension.back(), fit.law.strain.back());
  }
  const FitQuality& q = fit.quality;
  result.figures = {fmt::format("{} rows, strain {:.3g} to {:.3g}", q.rows, q.from, q.to),
                    figure_of_residuals(q, fmt::format("a strain of {:.3g}", q.largest_at))};
  result.fit = "strain,measured_N,fitted_N\n";
  for (std::size_t i = 0; i < fit.strain.size(); ++i)
    result.fit +=
        fmt::format("{:.9g},{:.9g},{:.9g}\n", fit.strain[i], fit.measured[i], fit.fitted[i]);
  return result;
}

std::string test_words(const IdentifyArguments& a) {
  if (a.test == "bias")
    return fmt::format("bias-extension test, {:g} x {:g} mm, equation (40) read backwards",
                       a.specimen.length, a.specimen.width);
  if (a.test == "frame")
    return fmt::format("picture frame of {:g} mm, equation (41) read backwards", a.specimen.side);
  std::string words =
      fmt::format("tension test of {:g} yarn{}", a.yarns, a.yarns == 1.0 ? "" : "s");
  if (a.gauge_length != 1.0) words += fmt::format(", gauge length {:g} mm", a.gauge_length);
  return words;
}

/// Checks the arguments before the curve is read.
void check_arguments(const IdentifyArguments& a, const fs::path& fit, bool shear,
                     Diagnostics& diagnostics) {
  check_output("--output", a.output, {a.curve, a.fabric}, diagnostics);
  check_output("--fit", fit, {a.curve, a.fabric, a.output}, diagnostics);
  check_range(a, shear, diagnostics);
  if (a.coefficients < 1 || a.coefficients > 6)
    option_error("--coefficients", fmt::format("{}", a.coefficients), "must be 1 to 6",
                 "give the number of coefficients k1, k3, k5 ..., usually 3", diagnostics);
  if (!(a.yarns > 0.0 && std::isfinite(a.yarns)))
    option_error("--yarns", fmt::format("{:g}", a.yarns), "must be greater than 0",
                 "give the number of yarns that share the force", diagnostics);
  if (!(a.gauge_length > 0.0 && std::isfinite(a.gauge_length)))
    option_error("--gauge-length", fmt::format("{:g}", a.gauge_length), "must be greater than 0",
                 "give the free length of the yarns, in mm", diagnostics);
}

std::optional<Identified> identify(const IdentifyArguments& a, const Fabric& fabric,
                                   const std::optional<ShearTest>& test, const Curve& curve,
                                   Diagnostics& diagnostics) {
  const double unit = test ? deg : 1.0;
  const FitOptions options{a.coefficients, a.from * unit, a.to * unit};
  if (test) {
    const auto fit = identify_shear(curve, *test, fabric, options, diagnostics);
    return fit ? std::optional(shear_text(*fit)) : std::nullopt;
  }
  const auto fit = identify_tension(curve, {a.yarns, a.gauge_length}, options, diagnostics);
  return fit ? std::optional(tension_text(*fit, a.test)) : std::nullopt;
}

void write_and_report(const IdentifyArguments& a, const fs::path& fit_file,
                      const FabricReading& base, Identified result) {
  result.law.comment = {fmt::format("Identified by plyform {} from {}:", version(),
                                    fs::path(a.curve).filename().string()),
                        test_words(a) +
                            (a.test == "bias" || a.test == "frame"
                                 ? fmt::format(", {:g} x {:g} yarns/mm", base.value->warp_density,
                                               base.value->weft_density)
                                 : "") +
                            ";"};
  for (const std::string& figure : result.figures)
    result.law.comment.push_back(figure + (&figure == &result.figures.back() ? "." : ";"));
  if (result.law.key == "polynomial")
    result.law.comment.push_back("torque of one unit cell = k1 g + k3 g^3 ..., N mm, g in rad");
  const std::string text = with_law(base.text, result.law);
  write_whole(fit_file, result.fit);
  write_whole(a.output, text);
  const bool shear = result.law.table == "shear";
  fmt::print("{} law of {} from {}\n", shear ? "shear" : result.law.table + " tension",
             base.value->name, a.curve);
  fmt::print("  {}\n  {}\n", test_words(a), result.law_line);
  for (const std::string& figure : result.figures)
    fmt::print("  {}\n", figure);
  for (const std::string& missing : base.missing)
    if (missing != result.law.table)
      fmt::print("  still without a law: {}; no case can use the fabric before\n", missing);
  fs::path picture = fit_file;
  fmt::print("written: {}, {}\nplot: tools/plot.py fit {} -o {}\n", a.output, fit_file.string(),
             fit_file.string(), picture.replace_extension(".png").string());
}

} // namespace

int identify_command(const IdentifyArguments& arguments) {
  const bool shear = arguments.test == "bias" || arguments.test == "frame";
  const fs::path output = arguments.output;
  const fs::path fit = arguments.fit.empty()
                           ? output.parent_path() / (output.stem().string() + "_fit.csv")
                           : fs::path(arguments.fit);
  Diagnostics diagnostics;
  check_arguments(arguments, fit, shear, diagnostics);
  const auto test = shear ? test_of(arguments.test, arguments.specimen, diagnostics) : std::nullopt;
  const FabricReading base = fabric_of(arguments.fabric, shear, diagnostics);
  const auto curve =
      read_curve(arguments.curve, arguments.x_column, arguments.y_column, diagnostics);
  std::optional<Identified> result;
  if (diagnostics.errors.empty())
    result = identify(arguments, *base.value, test, *curve, diagnostics);
  if (print(diagnostics)) return exit_case_wrong;
  write_and_report(arguments, fit, base, *result);
  return exit_done;
}

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
  if (print(diagnostics)) return exit_case_wrong;
  std::string rows = "displacement_mm,shear_deg,force_N\n";
  const double end = extension_at(*test, arguments.to * deg);
  const double bending = in_plane_bending_share(*test, *fabric.value).mean();
  for (int i = 0; i <= arguments.points; ++i) {
    const double d = end * i / arguments.points;
    rows += fmt::format("{:.9g},{:.9g},{:.9g}\n", d, shear_angle(*test, d) / deg,
                        (1.0 + bending) * test_load(*test, *fabric.value, d));
  }
  if (bending > 0.0)
    fmt::print("in-plane bending adds {:.2g} % to the load by (40)\n", 100.0 * bending);
  write_whole(arguments.output, rows);
  fmt::print("written: {}, {} rows\n", arguments.output, arguments.points + 1);
  return exit_done;
}

} // namespace plyform
