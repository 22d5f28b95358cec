// SPDX-License-Identifier: GPL-3.0-or-later
// Friction over the Hersey number from pull-out tests: in words, as TOML of a case, and as CSV.
#include "base/format.hpp"
#include "base/version.hpp"
#include "base/write_whole.hpp"
#include "core/identify/fit_pull_out.hpp"
#include "tools/identify/identify_ranges.hpp"
#include "tools/identify/identify_rates.hpp"

#include <cmath>

namespace plyform {
namespace {

namespace fs = std::filesystem;

constexpr double pascal_second = 1e-6; // N s/mm^2

std::vector<PullOutTest> pull_out_tests(const IdentifyArguments& a,
                                        const std::vector<Curve>& curves) {
  std::vector<PullOutTest> tests;
  for (std::size_t i = 0; i < curves.size(); ++i)
    tests.push_back({curves[i], a.speeds[i], a.pressures[i],
                     pascal_second * a.viscosities[a.viscosities.size() > 1 ? i : 0]});
  return tests;
}

/// Options that are there for this test alone.
void check_pull_out(const IdentifyArguments& a, Diagnostics& diagnostics) {
  const auto positive = [&](const std::string& option, double value, const std::string& remedy) {
    if (!(value > 0.0 && std::isfinite(value)))
      option_error(option, fmt::format("{:g}", value), "must be greater than 0", remedy,
                   diagnostics);
  };
  positive("--area", a.area, "give the area of one face that is pulled, mm2");
  for (const double viscosity : a.viscosities)
    positive("--viscosity", viscosity, "give the viscosity of the matrix, Pa s");
  if (a.viscosities.size() > 1 && a.viscosities.size() != a.curves.size())
    option_error("--viscosity", fmt::format("{} numbers", a.viscosities.size()),
                 "must be one number, or one for each curve",
                 "give them in the order of the curves", diagnostics);
  if (a.points && (*a.points < 2 || *a.points > 8))
    option_error("--points", fmt::format("{}", *a.points), "must be 2 to 8",
                 "give the number of points of the curve", diagnostics);
  if (a.name.empty() ||
      a.name.find_first_not_of(
          "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") != std::string::npos)
    option_error("--name", a.name, "may have only letters a to z, digits, _ and -",
                 "give the law another name", diagnostics);
  if (!(a.to > a.from))
    option_error("--to", fmt::format("{:g}", a.to), "must be greater than --from",
                 "give displacements in mm", diagnostics);
}

std::string friction_toml(const IdentifyArguments& a, const PullOutFit& fit) {
  std::string text = fmt::format(
      "# Identified by plyform {} from {}:\n# pull-out tests, mu = F / (2 A p), A = {:g} mm2; "
      "{} tests, residuals {:.2g} % rms, 95 % limits +- {:.2g} %.\n[friction.{}]\n"
      "law = \"hersey\"\n",
      version(), files_of(a), a.area, fit.tests.size(), 100.0 * fit.quality.rms, 100.0 * fit.limits,
      a.name);
  text += fmt::format("viscosity = {:g}\ncurve = [\n", a.viscosities.front());
  for (std::size_t i = 0; i < fit.hersey.size(); ++i)
    text += fmt::format("    [{:.6g}, {:.6g}],\n", fit.hersey[i], fit.friction[i]);
  return text + "]\n";
}

std::string pull_out_csv(const PullOutFit& fit) {
  std::string text = "hersey_mm,measured,fitted,specimen\n";
  for (std::size_t i = 0; i < fit.tests.size(); ++i)
    text += fmt::format("{:.9g},{:.9g},{:.9g},{}\n", fit.tests[i].hersey, fit.tests[i].friction,
                        fit.tests[i].fitted, i + 1);
  return text;
}

Identified pull_out_text(const IdentifyArguments& a, const PullOutFit& fit) {
  Identified result;
  result.title = "friction over the Hersey number";
  result.law_line = "Hersey number in mm, friction coefficient:";
  for (std::size_t i = 0; i < fit.hersey.size(); ++i) {
    result.law_line +=
        fmt::format("{} {:.3g}: {:.3g}", i ? "," : "", fit.hersey[i], fit.friction[i]);
    result.numbers.push_back({fmt::format("friction at {:.3g} mm", fit.hersey[i]), "",
                              fit.friction[i], fit.limits * fit.friction[i]});
  }
  put_quality(fit.quality, result);
  result.figures = {
      fmt::format("{} tests, Hersey numbers {:.3g} to {:.3g} mm", fit.tests.size(),
                  fit.quality.from, fit.quality.to),
      fmt::format("residuals {:.2g} % of the friction rms, {:.2g} % at most; 95 % limits +- {:.2g} "
                  "% from them",
                  100.0 * fit.quality.rms, 100.0 * fit.quality.largest, 100.0 * fit.limits)};
  for (std::size_t i = 0; i < fit.tests.size(); ++i) {
    const PullOutPoint& one = fit.tests[i];
    result.notes.push_back(fmt::format(
        "{}: {:g} mm/s, {:g} N/mm2: H = {:.3g} mm, mu = {:.3g}, {:.3g} by the curve; steady {:.4g} "
        "N +- {:.2g} %, {:.3g} times that at most before",
        fs::path(one.file).filename().string(), a.speeds[i], a.pressures[i], one.hersey,
        one.friction, one.fitted, one.steady, 100.0 * one.scatter, one.peak));
  }
  result.fit = pull_out_csv(fit);
  return result;
}

} // namespace

Identification identify_pull_out_curves(const IdentifyArguments& a) {
  const fs::path output = a.output;
  const fs::path fit_file = a.fit.empty()
                                ? output.parent_path() / (output.stem().string() + "_fit.csv")
                                : fs::path(a.fit);
  Identification outcome;
  Diagnostics& diagnostics = outcome.diagnostics;
  std::vector<fs::path> read;
  for (const std::string& curve : a.curves)
    read.emplace_back(curve_argument(curve).file);
  check_output("--output", output, read, diagnostics);
  read.push_back(output);
  check_output("--fit", fit_file, read, diagnostics);
  read.push_back(fit_file);
  if (!a.report.empty()) check_output("--report", a.report, read, diagnostics);
  const bool report = !a.report.empty() && diagnostics.errors.empty();
  check_rated(a, diagnostics);
  check_pull_out(a, diagnostics);
  const std::vector<Curve> curves = curves_of(a, diagnostics);
  std::optional<Identified> result;
  std::string toml;
  if (diagnostics.errors.empty())
    if (const auto fit = identify_pull_out(pull_out_tests(a, curves), a.area, a.from, a.to,
                                           a.points.value_or(0), diagnostics)) {
      result = pull_out_text(a, *fit);
      toml = friction_toml(a, *fit);
      const Diagnostics held = check_friction_text(toml, a.output);
      hold_to_keys(held.errors, held.warnings, {"friction." + a.name},
                   {curve_argument(a.curves.front()).file, 1, 1}, diagnostics);
    }
  const bool refused = !diagnostics.errors.empty();
  if (report) write_report(a, fit_file.string(), {}, refused ? std::nullopt : result, diagnostics);
  if (refused) return outcome;
  write_whole(fit_file, result->fit);
  write_whole(output, toml);
  outcome.said = fmt::format("{} from {}\n  {}\n", result->title, files_of(a), result->law_line);
  for (const std::vector<std::string>* lines : {&result->figures, &result->notes})
    for (const std::string& line : *lines)
      outcome.said += fmt::format("  {}\n", line);
  outcome.said += fmt::format("written: {}, {}\n", a.output, fit_file.string());
  return outcome;
}

} // namespace plyform
