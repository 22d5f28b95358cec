// SPDX-License-Identifier: GPL-3.0-or-later
// Measured curves -> law -> fabric file.
#include "base/format.hpp"
#include "base/version.hpp"
#include "base/write_whole.hpp"
#include "tools/identify/identify_ranges.hpp"
#include "tools/identify/identify_rates.hpp"
#include "tools/identify/identify_rubber.hpp"
#include "tools/identify/identify_tests.hpp"

#include <algorithm>
#include <stdexcept>

namespace plyform {
namespace {

namespace fs = std::filesystem;

/// The curves of both kinds; errors are reported.
struct BothKinds {
  std::vector<Curve> curves, others;
  std::vector<Curve> all() const {
    std::vector<Curve> both = curves;
    both.insert(both.end(), others.begin(), others.end());
    return both;
  }
};

/// Angles of the others are magnitudes, as their sign is known.
BothKinds both_kinds(const IdentifyArguments& a, Diagnostics& diagnostics) {
  if (!identify_test(a.test).columns) return {};
  IdentifyArguments other = a;
  other.curves = a.others;
  BothKinds both{curves_of(a, diagnostics), curves_of(other, diagnostics)};
  for (Curve& curve : both.others)
    if (!curve.angle.empty() && curve.angle.back() < 0.0) {
      curve.angle_written.factor *= -1.0;
      for (double& angle : curve.angle)
        angle = -angle;
    }
  return both;
}

/// Warns of curves that are the same number for number: scatter between them says nothing.
void warn_of_same(const std::vector<Curve>& curves, Diagnostics& diagnostics) {
  for (std::size_t b = 1; b < curves.size(); ++b) {
    const auto same = std::find_if(
        curves.begin(), curves.begin() + static_cast<std::ptrdiff_t>(b), [&](const Curve& a) {
          return a.x == curves[b].x && a.y == curves[b].y && a.angle == curves[b].angle;
        });
    if (same != curves.begin() + static_cast<std::ptrdiff_t>(b))
      diagnostics.warning(
          {curves[b].file, 1, 1},
          fmt::format("curve {} has the same numbers in every row as curve {}, {}: they are no two "
                      "specimens, and scatter and limits come out too small; leave one out",
                      b + 1, same - curves.begin() + 1, same->file));
  }
}

/// The comment above the law in the fabric file.
std::vector<std::string> comment_of(const IdentifyArguments& a, const Fabric& fabric,
                                    const Identified& result) {
  std::vector<std::string> comment{
      fmt::format("Identified by plyform {} from {}:", version(), files_of(a)),
      test_words(a) +
          (is_shear_test(a.test) ? fmt::format(", {:g} x {:g} yarns/mm", fabric.families[0].density,
                                               fabric.families[1].density)
                                 : "") +
          ";"};
  for (const std::string& figure : result.figures)
    comment.push_back(figure + (&figure == &result.figures.back() ? "." : ";"));
  if (is_rated(a)) // has a line of its own below
    comment.push_back(result.law_line);
  else if (result.laws.front().key == "polynomial")
    comment.push_back("torque of one unit cell = k1 g + k3 g^3 ..., N mm, g in rad");
  else if (is_shear_test(a.test))
    comment.push_back(result.law_line);
  return comment;
}

/// Whether a key stands beside another of the same law, which has the comment.
bool stands_beside(const std::string& key) {
  return key == "law" || key == "buckling_force" || key == "slack" || key == "pretension" ||
         key == "breaking_force" || key == "height" || key == "viscosity" ||
         key == "measured_rates" || key == "reference" || key == "activation_energy" ||
         key == "c1" || key == "c2" || key == "exponent" || key == "densest" ||
         key == "unloading" || key == "nesting" || key == "thickness";
}

/// The fabric file with what was identified.
std::string text_of(const IdentifyArguments& a, const FabricReading& base, const Identified& result,
                    Diagnostics& diagnostics) {
  std::vector<LawText> laws = result.laws;
  for (LawText& law : laws) {
    law.table = table_of_law(base, law.table);
    if (!stands_beside(law.key)) law.comment = comment_of(a, *base.value, result);
  }
  return fabric_text(a, base, laws, diagnostics);
}

/// Returns what is said of it.
std::string write_and_tell(const IdentifyArguments& a, const fs::path& fit_file,
                           const FabricReading& base, const Identified& result,
                           const std::string& text) {
  write_whole(fit_file, result.fit);
  write_whole(a.output, text);
  std::string said;
  said += fmt::format("{} of {} from {}\n", result.title, base.value->name, files_of(a));
  said += fmt::format("  {}\n  {}\n", test_words(a), result.law_line);
  for (const std::string& figure : result.figures)
    said += fmt::format("  {}\n", figure);
  for (const std::string& note : result.notes)
    said += fmt::format("  {}\n", note);
  for (const std::string& missing : base.missing)
    if (std::find(result.provides.begin(), result.provides.end(), missing) == result.provides.end())
      said +=
          fmt::format("  still without a law: {}; no case can use the fabric before\n", missing);
  said += fmt::format("written: {}, {}\n", a.output, fit_file.string());
  fs::path picture = fit_file;
  if (is_shear_test(a.test) || is_tension_test(a.test) || is_rubber_test(a.test) ||
      (a.test == "three-point" && result.laws.front().key == "bending_stiffness"))
    said += fmt::format("plot: tools/plot.py fit {} -o {}\n", fit_file.string(),
                        picture.replace_extension(".png").string());
  return said;
}

/// Whether a report is asked for, in a place that was not refused: there lies another file.
bool may_be_reported(const IdentifyArguments& a, const Diagnostics& diagnostics) {
  return !a.report.empty() &&
         std::none_of(diagnostics.errors.begin(), diagnostics.errors.end(),
                      [](const CaseError& error) { return error.file == "--report"; });
}

} // namespace

std::optional<Identified> find_shear(const TestInput& in, Diagnostics& diagnostics) {
  const IdentifyArguments& a = in.arguments;
  const Fabric& fabric = *in.base.value;
  if (is_rated(a))
    return identify_rated_curves(a, in.base, in.shear->test, in.curves, in.options, diagnostics);
  const auto fit = identify_shear(in.curves, in.shear->test, fabric, in.options, diagnostics);
  if (!fit) return std::nullopt;
  Identified text = shear_text(*fit);
  text.figures.insert(text.figures.begin(), in.shear->assumed.begin(), in.shear->assumed.end());
  const auto slip = slip_lines(a, in.curves, *in.shear, fabric, in.options, *fit);
  auto& lines = in.options.measured_angle ? text.figures : text.notes;
  lines.insert(lines.end(), slip.begin(), slip.end());
  return text;
}

std::optional<Identified> find_tension(const TestInput& in, Diagnostics& diagnostics) {
  const IdentifyArguments& a = in.arguments;
  const auto fit = identify_tension(in.curves, {a.yarns, a.gauge_length}, in.options, diagnostics);
  return fit ? std::optional(tension_text(*fit, a)) : std::nullopt;
}

std::optional<Identified> find_biaxial(const TestInput& in, Diagnostics& diagnostics) {
  return identify_biaxial_files(in.arguments, *in.base.value, diagnostics);
}

std::optional<Identified> find_rubber(const TestInput& in, Diagnostics& diagnostics) {
  return identify_rubber_curves(in.arguments, *in.base.value, in.curves, in.others, in.options,
                                diagnostics);
}

std::optional<Identified> find_compression(const TestInput& in, Diagnostics& diagnostics) {
  const IdentifyArguments& a = in.arguments;
  const auto fit =
      identify_compression(in.curves.front(), {a.yarns, a.gauge_length}, in.options, diagnostics);
  if (!fit) return std::nullopt;
  for (const std::string& yarns : families_of(a.direction))
    check_compression(fit->stiffness, yarns, *in.base.value, {a.curves.front(), 1, 1}, diagnostics);
  return compression_text(*fit, a);
}

std::optional<Identified> find_cantilever(const TestInput& in, Diagnostics& diagnostics) {
  const auto fit = identify_cantilever(in.curves, reading_of(in.arguments), *in.base.value,
                                       in.options, diagnostics);
  return fit ? std::optional(bending_text(*fit, in.arguments)) : std::nullopt;
}

std::optional<Identified> find_three_point(const TestInput& in, Diagnostics& diagnostics) {
  const SpecimenArguments& specimen = in.arguments.specimen;
  const auto fit = identify_three_point(in.curves, {specimen.span, specimen.width}, *in.base.value,
                                        in.options, diagnostics);
  return fit ? std::optional(bending_text(*fit, in.arguments)) : std::nullopt;
}

std::optional<Identified> find_relaxation(const TestInput& in, Diagnostics& diagnostics) {
  return identify_relaxation_curve(in.arguments, in.base, in.curves.front(), diagnostics);
}

std::optional<Identified> find_zone(const TestInput& in, Diagnostics& diagnostics) {
  const auto fit = identify_zone(in.curves, *in.base.value, in.options, diagnostics);
  return fit ? std::optional(zone_text(*fit, in.arguments)) : std::nullopt;
}

Identification identify(const IdentifyArguments& arguments,
                        const std::function<void(double fraction)>& progress) {
  if (arguments.test == "pull-out") return identify_pull_out_curves(arguments);
  const bool shear = is_shear_test(arguments.test);
  const bool laboratories = are_laboratories(arguments);
  const fs::path output = arguments.output;
  const fs::path fit =
      arguments.fit.empty()
          ? output.parent_path() /
                (output.stem().string() + (laboratories ? "_laboratories.csv" : "_fit.csv"))
          : fs::path(arguments.fit);
  Identification outcome;
  Diagnostics& diagnostics = outcome.diagnostics;
  check_arguments(arguments, fit, diagnostics);
  FitOptions options = fit_options(arguments, diagnostics);
  options.progress = progress;
  const FabricReading base = is_rubber_test(arguments.test)
                                 ? rubber_of(arguments.fabric, diagnostics)
                                 : fabric_of(arguments.fabric, shear, diagnostics);
  if (arguments.test == "in-plane-bending")
    check_zone_fabric(base.missing, {arguments.fabric, 1, 1}, diagnostics);
  check_groups(arguments, base, diagnostics);
  BothKinds kinds = both_kinds(arguments, diagnostics);
  std::vector<Curve> all = kinds.all();
  warn_of_same(all, diagnostics);
  const auto test = shear ? prepare_shear(arguments, all, options, diagnostics) : std::nullopt;
  const auto split = all.begin() + static_cast<std::ptrdiff_t>(kinds.curves.size());
  kinds = {{all.begin(), split}, {split, all.end()}};
  if (shear && arguments.others.empty() && base.value && !base.value->crossings.empty() &&
      !base.value->crossings[0].shear.odd())
    diagnostics.warning({arguments.fabric, 1, 1},
                        "its law of shear is one of both signs; what is identified takes its "
                        "place, and is the same for both: copy the rows or the "
                        "negative_polynomial that you want to keep");
  if (laboratories && test && diagnostics.errors.empty()) {
    outcome.said =
        identify_laboratories(arguments, fit, base, *test, kinds.curves, options, diagnostics)
            .value_or("");
    return outcome;
  }
  std::optional<Identified> result;
  if (diagnostics.errors.empty())
    result =
        has_groups(arguments, *base.value)
            ? identify_groups(arguments, base, test, kinds.curves, kinds.others, options,
                              diagnostics)
            : identify_test(arguments.test)
                  .find({arguments, base, test, kinds.curves, kinds.others, options}, diagnostics);
  const std::string text = result ? text_of(arguments, base, *result, diagnostics) : "";
  const bool refused = !diagnostics.errors.empty();
  if (may_be_reported(arguments, diagnostics))
    write_report(arguments, fit.string(), base, refused ? std::nullopt : result, diagnostics);
  if (refused) return outcome;
  if (!result) throw std::logic_error("no law and no reason for it");
  outcome.said = write_and_tell(arguments, fit, base, *result, text);
  return outcome;
}

} // namespace plyform
