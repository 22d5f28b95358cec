// SPDX-License-Identifier: GPL-3.0-or-later
// plyform identify with the curves of several laboratories: a law of each, their mean and scatter,
// and three fabric files.
#include "base/format.hpp"
#include "base/version.hpp"
#include "base/write_whole.hpp"
#include "core/identify/laboratories.hpp"
#include "tools/identify/identify_parts.hpp"
#include "tools/identify/identify_ranges.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

namespace fs = std::filesystem;

/// A curve, its name and the law found from it.
struct Found {
  std::string laboratory, name;
  ShearFit fit;
};

/// Standard deviation between laboratories, over the mean, up to which they agree.
constexpr double agreement = 0.05;

/// rad: the largest angle that two laboratories reach.
double reached_by_two(const LaboratoryMean& mean) {
  std::vector<double> ends;
  for (const LaboratoryLaw& laboratory : mean.laboratories)
    ends.push_back(laboratory.to);
  std::sort(ends.rbegin(), ends.rend());
  return ends.at(1);
}

/// Angles (degrees) that the report speaks of: what only one laboratory reaches shows no scatter.
std::vector<double> told_angles(const LaboratoryMean& mean) {
  const double end = reached_by_two(mean);
  std::vector<double> angles;
  for (const double angle : {10.0, 20.0, 30.0, 40.0})
    if (angle * degree <= end + 1e-9) angles.push_back(angle);
  if (angles.empty()) angles.push_back(end / degree);
  return angles;
}

/// The laws of all curves; those that are refused are errors, or left out with a warning.
std::vector<Found> laws_of(const IdentifyArguments& a, const Fabric& fabric, const ShearTest& test,
                           const std::vector<Curve>& curves, const FitOptions& options,
                           Diagnostics& diagnostics) {
  std::vector<Found> found;
  for (std::size_t n = 0; n < curves.size(); ++n) {
    const CurveArgument argument = curve_argument(a.curves[n]);
    const std::string laboratory = laboratory_of(argument);
    Diagnostics own;
    auto fit = identify_shear(curves[n], test, fabric, options, own);
    diagnostics.warnings.insert(diagnostics.warnings.end(), own.warnings.begin(),
                                own.warnings.end());
    if (fit) {
      found.push_back({laboratory, argument.name(), std::move(*fit)});
      continue;
    }
    for (CaseError error : own.errors)
      if (a.skip_refused) {
        diagnostics.warning({error.file, error.line, error.column},
                            fmt::format("{} is left out: {}", laboratory, error.rule));
      } else {
        error.rule = fmt::format("{}: {}", laboratory, error.rule);
        error.remedy += "; --skip-refused goes on without the curve";
        diagnostics.errors.push_back(error);
      }
  }
  return found;
}

LaboratoryMean mean_of(const std::vector<Found>& found) {
  std::vector<LaboratoryCurve> curves;
  for (const Found& f : found)
    curves.push_back({f.laboratory, f.fit.law, f.fit.quality.to});
  return laboratory_mean(curves);
}

/// "laboratories differ by 31 % of the torque at 10, 26 % at 20 degrees ...", or agree.
std::string scatter_line(const LaboratoryMean& mean) {
  std::string text;
  double most = 0.0;
  for (const double angle : told_angles(mean)) {
    const double share =
        mean.value_at(mean.between, angle * degree) / mean.value_at(mean.mean, angle * degree);
    most = std::max(most, share);
    text += fmt::format("{}{:.2g} %{} at {:.3g}", text.empty() ? "" : ", ", 100.0 * share,
                        text.empty() ? " of the torque" : "", angle);
  }
  text = fmt::format("{} degrees (standard deviation of {})", text, mean.laboratories.size());
  if (most <= agreement)
    return fmt::format("laboratories agree within {:g} %: they differ by {}", 100.0 * agreement,
                       text);
  return fmt::format("laboratories differ by {}: the law of one, or their mean alone, misleads",
                     text);
}

/// "10 degrees: 0.41 N mm, +- 0.13 between 6 laboratories, +- 0.1 within one".
std::string line_at(const LaboratoryMean& mean, double angle) {
  const double g = angle * degree, within = mean.value_at(mean.within, g);
  std::size_t reach = 0;
  for (const LaboratoryLaw& laboratory : mean.laboratories)
    reach += laboratory.to >= g - 1e-9 ? 1 : 0;
  return fmt::format("{:.3g} degrees: {:.3g} N mm, +- {:.2g} between laboratories, {}{}", angle,
                     mean.value_at(mean.mean, g), mean.value_at(mean.between, g),
                     std::isnan(within) ? "within one not known: no two curves of one"
                                        : fmt::format("+- {:.2g} within one", within),
                     reach < mean.laboratories.size()
                         ? fmt::format("; reached by {} of {}", reach, mean.laboratories.size())
                         : "");
}

/// "KUL: 0.21, 0.33 N mm at 10, 20 degrees, to 40 degrees; KUL_1st residuals 1.2 %, ...".
std::string laboratory_line(const LaboratoryLaw& laboratory, const LaboratoryMean& mean,
                            const std::vector<Found>& found) {
  std::string torques, angles, curves;
  for (const double angle : told_angles(mean)) {
    if (angle * degree > laboratory.to + 1e-9) break;
    torques += fmt::format("{}{:.3g}", torques.empty() ? "" : ", ",
                           mean.value_at(laboratory.torque, angle * degree));
    angles += fmt::format("{}{:g}", angles.empty() ? "" : ", ", angle);
  }
  for (const Found& f : found)
    if (f.laboratory == laboratory.name)
      curves += fmt::format("; {}: {}, residuals {:.2g} % rms", f.name, f.fit.form.name(),
                            100.0 * f.fit.quality.rms);
  return fmt::format("{}: {} N mm at {} degrees, ends at {:.3g}{}", laboratory.name, torques,
                     angles, laboratory.to / degree, curves);
}

/// Where only some laboratories reach; empty if all reach all.
std::string reach_line(const LaboratoryMean& mean) {
  std::string others;
  for (const LaboratoryLaw& laboratory : mean.laboratories)
    if (laboratory.to > mean.common + 1e-9)
      others += fmt::format("{}{} to {:.3g}", others.empty() ? "" : ", ", laboratory.name,
                            laboratory.to / degree);
  if (others.empty()) return "";
  return fmt::format("all reach {:.3g} degrees; beyond, the mean grows by the factor that "
                     "that of those who go on does, the deviation keeps its share of it unless "
                     "theirs is more: {}",
                     mean.common / degree, others);
}

/// One of the three files.
struct Deviated {
  double deviations;
  fs::path file;
  std::string words; ///< "the mean less one standard deviation"
};

std::vector<Deviated> deviated_files(const fs::path& output) {
  const fs::path stem = output.parent_path() / output.stem();
  const auto named = [&](const char* ending) {
    return fs::path(fmt::format("{}{}{}", stem.string(), ending, output.extension().string()));
  };
  return {{0.0, output, "the mean"},
          {-1.0, named("_minus"), "the mean less one standard deviation between them"},
          {1.0, named("_plus"), "the mean and one standard deviation between them"}};
}

std::string cut_line(const DeviatedLaw& law) {
  if (!law.cut_from) return "";
  return fmt::format("cut between {:.3g} and {:.3g} degrees, where this torque would fall or be "
                     "negative: it stays what it was before",
                     *law.cut_from / degree, *law.cut_to / degree);
}

std::string table_of(const ShearLaw& law) {
  std::string rows = "[";
  for (std::size_t i = 0; i < law.angle.size(); ++i)
    rows += fmt::format("\n    [{:.7g}, {:.7g}],", law.angle[i] / degree, law.torque[i]);
  return rows + "\n]";
}

LawText law_text(const FabricReading& base, const DeviatedLaw& law) {
  return {table_of_law(base, "shear"), "table", table_of(law.law), {}};
}

/// Over the shear angle; cells are empty beyond a laboratory's range.
std::string csv_of(const LaboratoryMean& mean) {
  std::string text = "shear_deg,mean_Nmm,between_Nmm,within_Nmm,laboratories";
  for (const LaboratoryLaw& laboratory : mean.laboratories)
    text += fmt::format(",{}", laboratory.name);
  text += "\n";
  const auto cell = [](double value) {
    return std::isnan(value) ? std::string() : fmt::format("{:.7g}", value);
  };
  for (std::size_t i = 0; i < mean.angle.size(); ++i) {
    text += fmt::format("{:.6g},{},{},{},{}", mean.angle[i] / degree, cell(mean.mean[i]),
                        cell(mean.between[i]), cell(mean.within[i]), mean.reach[i]);
    for (const LaboratoryLaw& laboratory : mean.laboratories)
      text += fmt::format(",{}", cell(laboratory.torque[i]));
    text += "\n";
  }
  return text;
}

/// Returns what it says of a law that is cut, or nothing.
std::string write_fabric(const Deviated& deviated, const IdentifyArguments& a,
                         const FabricReading& base, const std::vector<std::string>& lines,
                         const LaboratoryMean& mean) {
  const DeviatedLaw law = deviated_law(mean, deviated.deviations);
  std::vector<std::string> comment{
      fmt::format("Identified by plyform {} from {}:", version(), files_of(a)),
      fmt::format("{}, {:g} x {:g} yarns/mm;", test_words(a), base.value->families[0].density,
                  base.value->families[1].density),
      fmt::format("{} of {} laboratories, {} points;", deviated.words, mean.laboratories.size(),
                  law.law.angle.size())};
  for (const std::string& line : lines)
    comment.push_back(fmt::format("{}{}", line, &line == &lines.back() ? "." : ";"));
  const std::string cut = cut_line(law);
  std::string said;
  if (!cut.empty()) {
    comment.insert(comment.begin() + 3, fmt::format("{};", cut));
    said = fmt::format("  {}: {}\n", deviated.file.filename().string(), cut);
  }
  LawText text = law_text(base, law);
  text.comment = comment;
  write_whole(deviated.file, with_law(base.text, text));
  return said;
}

bool check_laboratories(const IdentifyArguments& a, const fs::path& table,
                        Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.errors.size();
  std::vector<std::string> names;
  std::vector<fs::path> others{a.fabric};
  for (const std::string& text : a.curves) {
    const CurveArgument argument = curve_argument(text);
    names.push_back(laboratory_of(argument));
    others.emplace_back(argument.file);
    if (names.back().find_first_of(",\"\n") != std::string::npos)
      option_error("--laboratories", names.back(), "must be without commas and quotes",
                   "name the laboratory: NAME=FILE:COLUMN", diagnostics);
    if (!a.laboratories && argument.laboratory.empty())
      option_error("--laboratories", text, "has no laboratory, but others have",
                   "give NAME=FILE for every curve, or --laboratories if each file or column is "
                   "one",
                   diagnostics);
  }
  for (const Deviated& deviated : deviated_files(a.output)) {
    check_output("--output", deviated.file, others, diagnostics);
    others.push_back(deviated.file);
  }
  check_output("--fit", table, others, diagnostics);
  if (std::all_of(names.begin(), names.end(),
                  [&names](const std::string& name) { return name == names.front(); }))
    option_error("--laboratories", names.front(), "is the only one, there must be two or more",
                 "give each its name: NAME=FILE:COLUMN; curves of one are specimens", diagnostics);
  return diagnostics.errors.size() == before;
}

} // namespace

std::string laboratory_of(const CurveArgument& argument) {
  if (!argument.laboratory.empty()) return argument.laboratory;
  return argument.column.empty() ? fs::path(argument.file).stem().string() : argument.column;
}

bool are_laboratories(const IdentifyArguments& a) {
  return a.laboratories ||
         std::any_of(a.curves.begin(), a.curves.end(), [](const std::string& text) {
           return !curve_argument(text).laboratory.empty();
         });
}

std::optional<std::string>
identify_laboratories(const IdentifyArguments& a, const fs::path& table, const FabricReading& base,
                      const PreparedShear& test, const std::vector<Curve>& curves,
                      const FitOptions& options, Diagnostics& diagnostics) {
  if (!check_laboratories(a, table, diagnostics)) return std::nullopt;
  const std::vector<Found> found = laws_of(a, *base.value, test.test, curves, options, diagnostics);
  if (diagnostics.errors.empty() &&
      std::none_of(found.begin(), found.end(),
                   [&found](const Found& f) { return f.laboratory != found.front().laboratory; }))
    option_error("--skip-refused", "", "leaves less than two laboratories",
                 "look at what is said of each curve", diagnostics);
  LaboratoryMean mean;
  if (diagnostics.errors.empty()) {
    mean = mean_of(found);
    for (const Deviated& deviated : deviated_files(a.output))
      fabric_text(a, base, {law_text(base, deviated_law(mean, deviated.deviations))}, diagnostics);
  }
  if (!diagnostics.errors.empty()) return std::nullopt;
  std::vector<std::string> lines{scatter_line(mean)};
  lines.insert(lines.end(), test.assumed.begin(), test.assumed.end());
  for (const double angle : told_angles(mean))
    lines.push_back(line_at(mean, angle));
  if (const std::string reach = reach_line(mean); !reach.empty()) lines.push_back(reach);
  std::string said =
      fmt::format("{}\nshear law of {} from {} laboratories, {} curves\n  {}\n", lines.front(),
                  base.value->name, mean.laboratories.size(), found.size(), test_words(a));
  for (std::size_t i = 1; i < lines.size(); ++i)
    said += fmt::format("  {}\n", lines[i]);
  for (const LaboratoryLaw& laboratory : mean.laboratories)
    said += fmt::format("  {}\n", laboratory_line(laboratory, mean, found));
  std::string written;
  for (const Deviated& deviated : deviated_files(a.output)) {
    said += write_fabric(deviated, a, base, lines, mean);
    written += fmt::format("{}, ", deviated.file.string());
  }
  write_whole(table, csv_of(mean));
  return said + fmt::format("written: {}{}\n", written, table.string());
}

} // namespace plyform
