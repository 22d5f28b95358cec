// SPDX-License-Identifier: GPL-3.0-or-later
// The law of a sheet of rubber from tension curves: in words, as TOML and as CSV.
#include "tools/identify/identify_rubber.hpp"

#include "base/format.hpp"
#include "core/identify/fit_rubber.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

std::string stretch_text(double stretch) {
  return fmt::format("a stretch of {:.3g}", stretch);
}

/// Law, numbers and limits of them.
std::string put_rubber_law(const RubberFit& fit, Identified& result) {
  const std::string table = fit.neo_hookean ? "neo_hookean" : "mooney_rivlin";
  result.laws = {{"", "law", "\"" + table + "\"", {}}};
  result.laws.back().without = {fit.neo_hookean ? "mooney_rivlin" : "neo_hookean"};
  const std::pair<std::string, std::string> limit{
      "stretch_limit", fmt::format("{:.4g}", std::floor(1000.0 * fit.largest_stretch) / 1000.0)};
  const std::vector<double>& limits = fit.confidence.coefficient;
  if (fit.neo_hookean) {
    const double mu = fit.law.shear_modulus();
    result.laws.push_back({table, "shear_modulus", fmt::format("{:.6g}", mu), {}, {limit}});
    result.law_line = fmt::format("neo-Hookean, shear modulus {:.4g} N/mm2", mu);
    result.numbers = {{"shear modulus", "N/mm2", mu, limits[0]}};
    return fmt::format("mu +- {:.2g} N/mm2, ", limits[0]);
  }
  result.laws.push_back({table,
                         "c10",
                         fmt::format("{:.6g}", fit.law.c10),
                         {},
                         {{"c01", fmt::format("{:.6g}", fit.law.c01)}, limit}});
  result.law_line =
      fmt::format("Mooney-Rivlin, C10 = {:.4g}, C01 = {:.4g} N/mm2: shear modulus {:.4g} N/mm2",
                  fit.law.c10, fit.law.c01, fit.law.shear_modulus());
  result.numbers = {{"C10", "N/mm2", fit.law.c10, limits[0]},
                    {"C01", "N/mm2", fit.law.c01, limits[1]}};
  return fmt::format("C10 +- {:.2g}, C01 +- {:.2g} N/mm2, ", limits[0], limits[1]);
}

void put_rubber_specimens(const RubberFit& fit, const std::string& unit, Identified& result) {
  for (const SpecimenLaw& specimen : fit.specimens) {
    const std::string name = std::filesystem::path(specimen.file).filename().string();
    if (const std::string taken = corrections_text(specimen.corrected, unit); !taken.empty())
      result.figures.push_back(fmt::format("taken off {}: {}", name, taken));
    if (fit.specimens.size() > 1)
      result.notes.push_back(fmt::format(
          "{}: {}, residuals {:.2g} % rms", name,
          fit.neo_hookean ? fmt::format("mu = {:.4g} N/mm2", specimen.coefficients[0])
                          : fmt::format("C10 = {:.4g}, C01 = {:.4g} N/mm2",
                                        specimen.coefficients[0], specimen.coefficients[1]),
          100.0 * specimen.quality.rms));
  }
  if (!fit.scatter.coefficient.empty())
    result.figures.push_back(fmt::format(
        "{} specimens, standard deviation of the stress between them {:.2g} % at most, at {}",
        fit.specimens.size(), 100.0 * fit.scatter.law, stretch_text(fit.scatter.law_at)));
}

Identified rubber_text(const RubberFit& fit, bool displacement) {
  Identified result;
  result.title = "law of rubber";
  const std::string limits = put_rubber_law(fit, result);
  const FitQuality& q = fit.quality;
  put_quality(q, result);
  result.figures = {
      fmt::format("{} rows, measured to {}", q.rows, stretch_text(fit.largest_stretch)),
      figure_of_residuals(q, stretch_text(q.largest_at)), fit.why,
      confidence_text(limits, "stress", fit.confidence, stretch_text(fit.confidence.law_at),
                      fit.scatter.coefficient.empty() ? 1 : fit.specimens.size())};
  put_rubber_specimens(fit, displacement ? " mm" : "", result);
  result.notes.push_back(sensitivity_text(
      fit.specimens, displacement ? "0.1 mm" : "a strain of 0.001", displacement, false));
  result.fit = "stretch,measured_MPa,fitted_MPa,specimen\n";
  for (std::size_t i = 0; i < fit.stretch.size(); ++i)
    result.fit += fmt::format("{:.9g},{:.9g},{:.9g},{}\n", fit.stretch[i], fit.measured[i],
                              fit.fitted[i], fit.specimen[i] + 1);
  return result;
}

} // namespace

bool is_rubber_test(const std::string& test) {
  return test == "uniaxial" || test == "equibiaxial";
}

FabricReading rubber_of(const std::string& file, Diagnostics& diagnostics) {
  FabricReading reading = read_rubber_file(file);
  diagnostics.errors.insert(diagnostics.errors.end(), reading.errors.begin(), reading.errors.end());
  if (reading.value &&
      !(reading.value->sheet && std::holds_alternative<MooneyRivlinLaw>(*reading.value->sheet)))
    diagnostics.error({file, 1, 1}, "law", "",
                      "must be neo_hookean, mooney_rivlin, or missing: these tests are of sheets "
                      "of rubber",
                      "give a file with surface_density and thickness of the sheet");
  return reading;
}

std::optional<Identified> identify_rubber_curves(const IdentifyArguments& a, const Fabric& fabric,
                                                 const std::vector<Curve>& curves,
                                                 const std::vector<Curve>& others,
                                                 const FitOptions& options,
                                                 Diagnostics& diagnostics) {
  RubberSpecimen specimen{1.0, a.gauge_length};
  const bool width = !std::isnan(a.specimen.width);
  if (width) specimen.area = a.specimen.width * fabric.thickness;
  const RubberTest test = a.test == "uniaxial" ? RubberTest::uniaxial : RubberTest::equibiaxial;
  std::vector<RubberCurve> all;
  for (const Curve& curve : curves)
    all.push_back({curve, test});
  for (const Curve& curve : others)
    all.push_back({curve, RubberTest::equibiaxial});
  for (const RubberCurve& one : all)
    if (one.curve.y_is == Quantity::force && !width) {
      option_error("--width", "", fmt::format("is missing: {} is a force", one.curve.y_name),
                   "give the width of the section in mm, or --y-unit MPa if it is a stress",
                   diagnostics);
      return std::nullopt;
    }
  const RubberLaw law = a.law == "neo_hookean"     ? RubberLaw::neo_hookean
                        : a.law == "mooney_rivlin" ? RubberLaw::mooney_rivlin
                                                   : RubberLaw::chosen;
  const auto fit = identify_rubber(std::move(all), specimen, law, options, diagnostics);
  return fit ? std::optional(rubber_text(*fit, specimen.displacement())) : std::nullopt;
}

} // namespace plyform
