// SPDX-License-Identifier: GPL-3.0-or-later
// Yarns and crimps from biaxial tension curves: in words, as TOML and as CSV.
#include "base/format.hpp"
#include "core/identify/fit_biaxial.hpp"
#include "tools/identify/identify_parts.hpp"

namespace plyform {
namespace {

constexpr std::array<const char*, 2> directions{"warp", "weft"};

LawText yarn_law(const TensionLaw& law, const std::string& yarns) {
  if (law.linear()) return {yarns, "stiffness", fmt::format("{:.7g}", law.stiffness), {}};
  std::string rows;
  for (std::size_t i = 0; i < law.strain.size(); ++i)
    rows += fmt::format("\n    [{:.7g}, {:.7g}],", law.strain[i], law.tension[i]);
  return {yarns, "table", "[" + rows + "\n]", {}};
}

Identified biaxial_text(const BiaxialFit& fit) {
  Identified result;
  result.title = "tension laws and crimps";
  result.provides = {"warp", "weft"};
  std::string limits;
  for (std::size_t a = 0; a < 2; ++a) {
    result.laws.push_back(yarn_law(fit.yarn[a], directions[a]));
    if (fit.line) {
      result.law_line += fmt::format("{}: stiffness = {:.5g} N per straight yarn, ", directions[a],
                                     fit.yarn[a].stiffness);
      limits += fmt::format("{} +- {:.3g} N, ", directions[a], fit.stiffness_limits[a]);
      result.numbers.push_back({fmt::format("stiffness of {}", directions[a]),
                                "N per straight yarn", fit.yarn[a].stiffness,
                                fit.stiffness_limits[a]});
    } else {
      result.law_line += fmt::format("{}: table of {} rows, no line fits, ", directions[a],
                                     fit.yarn[a].strain.size());
    }
    result.law_line += fmt::format("crimp {:.4g}{}", fit.crimp[a], a == 0 ? "\n  " : "");
    limits += fmt::format("its crimp +- {:.2g}{}", fit.crimp_limits[a], a == 0 ? "; " : "");
    result.numbers.push_back(
        {fmt::format("crimp of {}", directions[a]), "", fit.crimp[a], fit.crimp_limits[a]});
  }
  put_quality(fit.quality, result);
  result.laws.push_back(
      {"crimp", "ratio", fmt::format("[{:.6g}, {:.6g}]", fit.crimp[0], fit.crimp[1]), {}});
  result.laws.push_back(
      {"crimp",
       "height",
       fit.plain ? std::string() : fmt::format("[{:.6g}, {:.6g}]", fit.height[0], fit.height[1]),
       {}});
  result.figures = {
      fmt::format("{} loads, waves of {:.3g} and {:.3g} mm", fit.quality.rows, fit.height[0],
                  fit.height[1]),
      figure_of_residuals(fit.quality, fmt::format("a strain of {:.3g}", fit.quality.largest_at)),
      "95 % limits " + limits + "; from the residuals, not from specimens"};
  for (const StrainZero& zero : fit.zeros)
    result.figures.push_back(fmt::format(
        "taken off: {} strain of {} too large by {:.3g} +- {:.1g}", directions[zero.direction],
        zero.file ? fmt::format("file {}", *zero.file + 1) : std::string("all files"), zero.amount,
        zero.limits));
  result.notes = {fmt::format("how far a crimp would move: {:.2g} % by a strain zero of 0.001",
                              100.0 * fit.sensitivity)};
  result.fit = "warp_strain,weft_strain,warp_N,warp_fitted_N,weft_N,weft_fitted_N,specimen\n";
  for (std::size_t i = 0; i < fit.strain.size(); ++i)
    result.fit += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{}\n", fit.strain[i][0],
                              fit.strain[i][1], fit.measured[i][0], fit.fitted[i][0],
                              fit.measured[i][1], fit.fitted[i][1], fit.specimen[i] + 1);
  return result;
}

} // namespace

std::optional<Identified> identify_biaxial_files(const IdentifyArguments& a, const Fabric& fabric,
                                                 Diagnostics& diagnostics) {
  std::vector<BiaxialCurve> curves;
  for (const std::string& file : a.curves)
    if (auto curve = read_biaxial(file, {a.warp_yarns, a.weft_yarns.value_or(1.0)}, diagnostics))
      curves.push_back(std::move(*curve));
  if (!diagnostics.errors.empty()) return std::nullopt;
  const auto fit = identify_biaxial(curves, fabric, {a.toe == "fit", a.doubtful}, diagnostics);
  return fit ? std::optional(biaxial_text(*fit)) : std::nullopt;
}

} // namespace plyform
