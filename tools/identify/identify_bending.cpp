// SPDX-License-Identifier: GPL-3.0-or-later
// Bending stiffnesses in words, as TOML and as CSV.
#include "base/format.hpp"
#include "tools/identify/identify_parts.hpp"

#include <limits>

namespace plyform {
namespace {

std::string specimen_column(const std::vector<std::size_t>& specimen, std::size_t row) {
  return specimen.back() > 0 ? fmt::format(",{}", specimen[row] + 1) : "";
}

const char* specimen_header(const std::vector<std::size_t>& specimen) {
  return specimen.back() > 0 ? ",specimen\n" : "\n";
}

/// Of a fabric that does not bend linearly.
Identified table_text(const BendingFit& fit, const IdentifyArguments& arguments) {
  Identified result;
  result.title = "bending law";
  std::string rows;
  for (std::size_t i = 0; i < fit.table.curvature.size(); ++i)
    rows += fmt::format("\n    [{:.7g}, {:.7g}],", fit.table.curvature[i], fit.table.moment[i]);
  for (const std::string& yarns : families_of(arguments.direction))
    result.laws.push_back({yarns, "bending_table", fmt::format("[{}\n]", rows), {}});
  result.law_line = fmt::format(
      "bending_table of {} rows, {:.4g} N mm at first, {:.4g} N mm on the whole; no line fits",
      fit.table.curvature.size(), fit.table.moment[1] / fit.table.curvature[1],
      fit.table.moment.back() / fit.table.curvature.back());
  result.figures = {
      fmt::format("{} rows", fit.quality.rows),
      fmt::format("residuals {:.2g} % of the deflection rms, {:.2g} % at most, at {:.3g} N",
                  100.0 * fit.quality.rms, 100.0 * fit.quality.largest, fit.quality.largest_at),
      fmt::format("95 % limits of the curvatures +- {:.2g} % at most; from the residuals",
                  100.0 * fit.limits)};
  put_quality(fit.quality, result);
  result.fit = std::string("force_N,measured_mm,fitted_mm") + specimen_header(fit.specimen);
  for (std::size_t i = 0; i < fit.x.size(); ++i)
    result.fit += fmt::format("{:.9g},{:.9g},{:.9g}{}\n", fit.x[i], fit.measured[i], fit.fitted[i],
                              specimen_column(fit.specimen, i));
  return result;
}

} // namespace

std::vector<std::string> families_of(const std::string& direction) {
  if (direction == "both") return {"warp", "weft"};
  return {direction};
}

Identified bending_text(const BendingFit& fit, const IdentifyArguments& arguments) {
  if (!fit.table.curvature.empty()) return table_text(fit, arguments);
  Identified result;
  result.title = "bending stiffness";
  for (const std::string& yarns : families_of(arguments.direction))
    result.laws.push_back({yarns, "bending_stiffness", fmt::format("{:.7g}", fit.stiffness), {}});
  result.law_line = fmt::format("bending_stiffness = {:.5g} N mm, bending length {:.4g} mm",
                                fit.stiffness, fit.bending_length);
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  result.numbers = {
      {"bending_stiffness", "N mm", fit.stiffness, fit.limits > 0.0 ? fit.limits : unknown},
      {"bending length", "mm", fit.bending_length, unknown}};
  put_quality(fit.quality, result);
  const std::size_t specimens = fit.of_specimen.size();
  const bool cantilever = arguments.test == "cantilever";
  result.figures = {fmt::format("{} {}", fit.quality.rows, cantilever ? "readings" : "rows")};
  if (!cantilever)
    result.figures.push_back(
        figure_of_residuals(fit.quality, fmt::format("{:.3g} mm", fit.quality.largest_at)));
  if (fit.limits > 0.0)
    result.figures.push_back(fmt::format("95 % limits +- {:.3g} N mm; from the {}", fit.limits,
                                         specimens > 1
                                             ? fmt::format("spread of {} specimens", specimens)
                                         : cantilever ? "spread of the readings of one specimen"
                                                      : "residuals of one specimen"));
  if (specimens > 1) {
    result.figures.push_back(
        fmt::format("standard deviation between specimens {:.3g} N mm", fit.scatter));
    for (std::size_t n = 0; n < specimens; ++n)
      result.notes.push_back(fmt::format(
          "{}: {:.5g} N mm", std::filesystem::path(arguments.curves[n]).filename().string(),
          fit.of_specimen[n]));
  }
  result.fit = std::string(cantilever ? "overhang_mm,measured_N_mm,fitted_N_mm"
                                      : "displacement_mm,measured_N,fitted_N") +
               specimen_header(fit.specimen);
  for (std::size_t i = 0; i < fit.x.size(); ++i)
    result.fit += fmt::format("{:.9g},{:.9g},{:.9g}{}\n", fit.x[i], fit.measured[i], fit.fitted[i],
                              specimen_column(fit.specimen, i));
  return result;
}

Identified zone_text(const ZoneFit& fit, const IdentifyArguments& arguments) {
  Identified result;
  result.title = "in-plane bending stiffness";
  for (const std::string& yarns : families_of(arguments.direction))
    result.laws.push_back(
        {yarns, "in_plane_bending_stiffness", fmt::format("{:.7g}", fit.stiffness), {}});
  result.law_line = fmt::format("in_plane_bending_stiffness = {:.4g} N mm, zone {:.4g} mm wide",
                                fit.stiffness, fit.length);
  result.numbers = {{"in_plane_bending_stiffness", "N mm", fit.stiffness, fit.stiffness_limits},
                    {"width of the zone", "mm", fit.length, fit.length_limits}};
  put_quality(fit.quality, result);
  result.figures = {
      fmt::format("{} rows, residuals {:.2g} % of the step rms, shear in the zone {:.3g} degrees",
                  fit.quality.rows, 100.0 * fit.quality.rms, fit.plateau / degree),
      fmt::format("95 % limits: width +- {:.2g} mm, stiffness +- {:.2g} N mm; from the {}",
                  fit.length_limits, fit.stiffness_limits,
                  fit.lengths.size() > 1 ? fmt::format("spread of {} profiles", fit.lengths.size())
                                         : "residuals of one profile")};
  if (fit.lengths.size() > 1)
    for (std::size_t n = 0; n < fit.lengths.size(); ++n)
      result.notes.push_back(fmt::format(
          "{}: {:.4g} mm wide", std::filesystem::path(arguments.curves[n]).filename().string(),
          fit.lengths[n]));
  result.fit = std::string("distance_mm,measured_deg,fitted_deg") + specimen_header(fit.specimen);
  for (std::size_t i = 0; i < fit.x.size(); ++i)
    result.fit += fmt::format("{:.9g},{:.9g},{:.9g}{}\n", fit.x[i], fit.measured[i] / degree,
                              fit.fitted[i] / degree, specimen_column(fit.specimen, i));
  return result;
}

} // namespace plyform
