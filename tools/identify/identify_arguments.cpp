// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of the arguments of plyform identify and theory, and what they ask for.
#include "base/format.hpp"
#include "base/outputs.hpp"
#include "base/text.hpp"
#include "tools/identify/identify_rates.hpp"
#include "tools/identify/identify_rubber.hpp"
#include "tools/identify/identify_tests.hpp"

#include <cmath>

namespace plyform {
namespace {

namespace fs = std::filesystem;

void check_range(const IdentifyArguments& arguments, Diagnostics& diagnostics) {
  const bool shear = is_shear_test(arguments.test);
  const double most = shear ? 90.0 : std::numeric_limits<double>::infinity();
  const char* remedy = shear                             ? "give a shear angle in degrees"
                       : arguments.test == "three-point" ? "give a deflection over the span"
                                                         : "give a strain";
  if (!(arguments.from >= 0.0 && arguments.from < most))
    option_error("--from", fmt::format("{:g}", arguments.from),
                 shear ? "must be at least 0 and below 90" : "must be at least 0", remedy,
                 diagnostics);
  else if (!(arguments.to > arguments.from))
    option_error("--to", fmt::format("{:g}", arguments.to),
                 fmt::format("must be greater than --from, {:g}", arguments.from), remedy,
                 diagnostics);
}

void check_positive(const std::string& option, double value, const std::string& remedy,
                    Diagnostics& diagnostics) {
  if (!(value > 0.0 && std::isfinite(value)))
    option_error(option, fmt::format("{:g}", value), "must be greater than 0", remedy, diagnostics);
}

/// The form of a law of shear.
void check_form(const IdentifyArguments& a, Diagnostics& diagnostics) {
  if (a.coefficients && (*a.coefficients < 1 || *a.coefficients > 6))
    option_error("--coefficients", fmt::format("{}", *a.coefficients), "must be 1 to 6",
                 "give the number of coefficients k1, k3, k5 ..., usually 3", diagnostics);
  if (a.points && (*a.points < 1 || *a.points > most_table_points))
    option_error(
        "--points", fmt::format("{}", *a.points), fmt::format("must be 1 to {}", most_table_points),
        "give the number of points of the table but for [0, 0], usually 4 to 8", diagnostics);
  if (a.coefficients && (a.points || a.law == "table"))
    option_error("--coefficients", fmt::format("{}", *a.coefficients),
                 "is of a polynomial, but a table is asked for",
                 "leave it out, or take --points, the size of a table", diagnostics);
  else if (a.points && !a.law.empty() && a.law != "table")
    option_error("--points", fmt::format("{}", *a.points),
                 fmt::format("is of a table, but --law {} is asked for", a.law),
                 "leave it out, or take --coefficients", diagnostics);
}

/// A number, or `fit` where that may stand.
struct Correction {
  std::optional<double> value;
  bool fit = false;
};

Correction correction_of(const std::string& option, const std::string& text, bool number, bool fit,
                         const std::string& remedy, Diagnostics& diagnostics) {
  Correction result;
  if (text.empty()) return result;
  if (text == "fit" && fit) return {std::nullopt, true};
  if (number) result.value = number_in(text);
  if (!result.value || !std::isfinite(*result.value))
    option_error(option, text,
                 number ? (fit ? "must be a number or fit" : "must be a number") : "must be fit",
                 remedy, diagnostics);
  return result;
}

} // namespace

void option_error(const std::string& option, const std::string& value, const std::string& rule,
                  const std::string& remedy, Diagnostics& diagnostics) {
  diagnostics.error({option, 1, 1}, option.substr(2), value, rule, remedy);
}

void check_output(const std::string& option, const fs::path& output,
                  const std::vector<fs::path>& others, Diagnostics& diagnostics) {
  if (const std::optional<fs::path> lost = file_overwritten(output, others))
    option_error(option, output.string(), "would overwrite " + lost->string(), "give another file",
                 diagnostics);
}

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

FabricReading fabric_of(const std::string& file, bool for_shear, Diagnostics& diagnostics) {
  FabricReading reading = read_fabric_file(file, true);
  diagnostics.errors.insert(diagnostics.errors.end(), reading.errors.begin(), reading.errors.end());
  if (!reading.value) return reading;
  const double between = material_axes(*reading.value).between();
  if (!is_biaxial(*reading.value))
    diagnostics.error({file, 1, 1}, "law", "",
                      "must be of two families and their crossing: the tests are of warp and weft",
                      "write the laws of other fabrics in by hand");
  else if (for_shear && std::abs(between - 0.5 * std::numbers::pi) > 1e-6)
    diagnostics.error({file, 1, 1}, "fibre_angle", fmt::format("{:g}", between / degree),
                      "must be 90 degrees: the theory of the shear tests is for such fabrics",
                      "take the law from a test of your own evaluation and write it in by hand");
  return reading;
}

bool is_shear_test(const std::string& test) {
  return test == "bias" || test == "frame";
}

bool is_tension_test(const std::string& test) {
  return test == "warp" || test == "weft" || test == "compression";
}

void check_arguments(const IdentifyArguments& a, const fs::path& fit, Diagnostics& diagnostics) {
  std::vector<fs::path> read{a.fabric};
  for (const std::vector<std::string>& curves : {a.others, a.curves})
    for (const std::string& curve : curves)
      read.insert(read.begin(), curve_argument(curve).file);
  check_output("--output", a.output, read, diagnostics);
  if (!a.angle_file.empty()) read.insert(read.begin(), curve_argument(a.angle_file).file);
  read.push_back(a.output);
  check_output("--fit", fit, read, diagnostics);
  read.push_back(fit);
  if (!a.report.empty()) check_output("--report", a.report, read, diagnostics);
  if (!a.report.empty() && are_laboratories(a))
    option_error("--report", a.report, "is not written of several laboratories",
                 "identify each by itself, or leave it out", diagnostics);
  check_range(a, diagnostics);
  check_form(a, diagnostics);
  check_rated(a, diagnostics);
  check_positive("--yarns", a.yarns, "give the number of yarns that share the force", diagnostics);
  check_positive("--warp-yarns", a.warp_yarns, "give the number of warp yarns", diagnostics);
  check_positive("--weft-yarns", a.weft_yarns.value_or(1.0), "give the number of weft yarns",
                 diagnostics);
  check_positive("--gauge-length", a.gauge_length, "give the free length of the yarns, in mm",
                 diagnostics);
  for (const std::string& curve : a.curves)
    if (!is_shear_test(a.test) && !curve_argument(curve).laboratory.empty())
      option_error("--curves", curve, "names a laboratory, as only bias and frame take them",
                   "identify each laboratory by itself", diagnostics);
  if (!a.angle_file.empty() && a.curves.size() + a.others.size() > 1)
    option_error("--angle-file", a.angle_file,
                 fmt::format("has the angles of one specimen, but {} curves are given",
                             a.curves.size() + a.others.size()),
                 "identify each curve with its own angles, or put them in a column beside its "
                 "loads",
                 diagnostics);
  if (a.test == "compression" && a.curves.size() > 1)
    option_error("--curves", a.curves[1], "is one more than a compression test takes",
                 "identify each specimen by itself", diagnostics);
  check_positive("--layers", a.layers, "give the number of plies between the plates", diagnostics);
  if (is_rubber_test(a.test) && !std::isnan(a.specimen.width))
    check_positive("--width", a.specimen.width, "give the width of the section, in mm",
                   diagnostics);
  if (a.test == "three-point") {
    check_positive("--span", a.specimen.span, "give the distance of the supports, in mm",
                   diagnostics);
    check_positive("--width", a.specimen.width, "give the width of the strip, in mm", diagnostics);
  }
}

bool extension_counts(const IdentifyArguments& a) {
  return a.angle.name == "none";
}

CantileverReading reading_of(const IdentifyArguments& a) {
  return a.reading == "angle" ? CantileverReading::chord_angle : CantileverReading::sag;
}

FitOptions fit_options(const IdentifyArguments& a, Diagnostics& diagnostics) {
  const double unit = is_shear_test(a.test) ? degree : 1.0;
  FitOptions options{a.coefficients.value_or(0), a.from * unit, a.to * unit};
  options.points = a.points.value_or(0);
  if (a.law == "polynomial") options.law = ShearFormKind::polynomial;
  if (a.law == "static") options.law = ShearFormKind::with_static;
  if (a.law == "table") options.law = ShearFormKind::table;
  options.doubtful = a.doubtful;
  options.measured_angle = (!a.angle.name.empty() || !a.angle_file.empty()) && !extension_counts(a);
  Corrections& c = options.corrections;
  const Correction zero = correction_of("--zero", a.zero, true, true,
                                        "give the load without a specimen in N", diagnostics);
  const Correction toe = correction_of(
      "--toe", a.toe, true, true,
      "give the extension at which the specimen is taut, in mm or as strain", diagnostics);
  const Correction slip =
      correction_of("--slip", a.slip, false, true, "give --slip fit, or leave it out", diagnostics);
  const Correction compliance = correction_of("--compliance", a.compliance, true, false,
                                              "give the compliance in mm/N", diagnostics);
  c.load_zero = zero.value;
  c.fit_load_zero = zero.fit;
  c.toe = toe.value;
  c.fit_toe = toe.fit;
  c.fit_slip = slip.fit;
  c.compliance = compliance.value;
  if (c.compliance && *c.compliance < 0.0)
    option_error("--compliance", a.compliance, "must be at least 0", "give the compliance in mm/N",
                 diagnostics);
  const bool strain = (is_tension_test(a.test) || is_rubber_test(a.test)) && a.gauge_length == 1.0;
  if (c.compliance && *c.compliance > 0.0 && (strain || options.measured_angle))
    option_error("--compliance", a.compliance,
                 strain ? "has nothing to correct: the column is a strain"
                        : "has nothing to correct: the angle is measured",
                 "leave it out", diagnostics);
  return options;
}

CurveColumns columns_of(const IdentifyArguments& a) {
  CurveColumns columns = identify_test(a.test).columns(a);
  columns.x = {a.x.name, a.x.unit};
  columns.y = {a.y.name, a.y.unit};
  if (!extension_counts(a) && a.angle_file.empty()) columns.angle = {a.angle.name, a.angle.unit};
  return columns;
}

std::string test_words(const IdentifyArguments& a) {
  return identify_test(a.test).words(a);
}

} // namespace plyform
