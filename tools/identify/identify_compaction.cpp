// SPDX-License-Identifier: GPL-3.0-or-later
// The law through the thickness: in words, as TOML and as CSV.
#include "base/format.hpp"
#include "core/identify/fit_compaction.hpp"
#include "tools/identify/identify_tests.hpp"

#include <limits>

namespace plyform {
namespace {

std::string table_text(const ThicknessCurve& curve) {
  std::string rows;
  for (std::size_t i = 0; i < curve.thickness.size(); ++i)
    rows += fmt::format("\n    [{:.7g}, {:.7g}],", curve.thickness[i], curve.pressure[i]);
  return "[" + rows + "\n]";
}

/// Of the fabric without pressure, as the law begins there.
LawText thickness_law(const CompactionFit& fit) {
  return {"", "thickness", fmt::format("{:.7g}", fit.loading.thickness.front()), {}};
}

/// Keys of the form, and none of the others.
void put_laws(const CompactionFit& fit, double layers, Identified& result) {
  const bool formula = fit.form == CompactionForm::toll_manson;
  const auto put = [&](const char* key, std::string value) {
    result.laws.push_back({"compaction", key, std::move(value), {}});
  };
  put(formula ? "stiffness" : "table",
      formula ? fmt::format("{:.7g}", fit.scale) : table_text(fit.loading));
  put("exponent", formula ? fmt::format("{:.7g}", fit.shape) : "");
  put("densest", formula ? fmt::format("{:.7g}", fit.densest) : "");
  put("unloading", fit.unloading.thickness.empty() ? "" : table_text(fit.unloading));
  if (layers != 1.0) put("nesting", ""); // a stack's plies nest in the test
  result.laws.push_back(thickness_law(fit));
}

void put_words(const CompactionFit& fit, Identified& result) {
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  const auto limits = [&](double half) { return half > 0.0 ? half : unknown; };
  const std::string ends =
      fmt::format("fibre volume {:.4g} without pressure, {:.4g} at {:.4g} N/mm2", fit.free_volume,
                  fit.densest, fit.loading.pressure.back());
  result.numbers = {{"fibre volume without pressure", "", fit.free_volume, limits(fit.free_limits)},
                    {"densest measured fibre volume", "", fit.densest, unknown}};
  if (fit.form == CompactionForm::table) {
    result.law_line = fmt::format("table of {} rows; {}", fit.loading.thickness.size(), ends);
    return;
  }
  const bool gutowski = fit.form == CompactionForm::gutowski;
  const char *scale = gutowski ? "A" : "s", *shape = gutowski ? "Va" : "n";
  result.law_line = fmt::format("p = {} = {:.5g} N/mm2, {} = {:.5g}; {}",
                                gutowski ? "A (V/V0 - 1) / (1/V - 1/Va)^4, A" : "s (V^n - V0^n), s",
                                fit.scale, shape, fit.shape, ends);
  result.numbers.push_back({scale, "N/mm2", fit.scale, limits(fit.scale_limits)});
  result.numbers.push_back({shape, "", fit.shape, limits(fit.shape_limits)});
  if (fit.scale_limits > 0.0)
    result.figures.push_back(
        fmt::format("95 % limits V0 +- {:.2g}, {} +- {:.2g}, {} +- {:.2g}; from "
                    "the residuals",
                    fit.free_limits, scale, fit.scale_limits, shape, fit.shape_limits));
}

} // namespace

std::optional<Identified> find_compaction(const TestInput& in, Diagnostics& diagnostics) {
  const IdentifyArguments& a = in.arguments;
  const Fabric& fabric = *in.base.value;
  if (!fabric.fibre_density) {
    diagnostics.error({a.fabric, 1, 1}, "fibre_density", "",
                      "is missing: fibre volumes follow from it",
                      "give fibre_density beside thickness, 2.55 g/cm3 of E glass, 1.8 of carbon");
    return std::nullopt;
  }
  std::optional<CompactionForm> form;
  if (a.law == "toll_manson") form = CompactionForm::toll_manson;
  if (a.law == "gutowski") form = CompactionForm::gutowski;
  if (a.law == "table") form = CompactionForm::table;
  const auto fit = identify_compaction(in.curves, in.others,
                                       {fabric.surface_density / *fabric.fibre_density, a.layers},
                                       form, diagnostics);
  if (!fit) return std::nullopt;
  Identified result;
  result.title = "compaction law";
  put_laws(*fit, a.layers, result);
  put_words(*fit, result);
  result.figures.insert(
      result.figures.begin(),
      fmt::format(
          "{} rows, residuals {:.2g} % of the thickness rms, {:.2g} % at most, at {:.3g} N/mm2",
          fit->quality.rows, 100.0 * fit->quality.rms, 100.0 * fit->quality.largest,
          fit->quality.largest_at));
  put_quality(fit->quality, result);
  if (in.curves.size() > 1)
    result.figures.push_back(
        fmt::format("standard deviation of thickness between specimens {:.2g} % at most",
                    100.0 * fit->scatter));
  if (std::abs(fabric.thickness / fit->loading.thickness.front() - 1.0) > 0.001)
    result.notes.push_back(
        fmt::format("thickness without pressure is {:.4g} mm now, and was {:.4g}",
                    fit->loading.thickness.front(), fabric.thickness));
  const bool several = in.curves.size() > 1;
  result.fit = std::string("pressure_N_mm2,thickness_mm,fitted_thickness_mm") +
               (several ? ",specimen\n" : "\n");
  for (std::size_t i = 0; i < fit->pressure.size(); ++i)
    result.fit +=
        fmt::format("{:.9g},{:.9g},{:.9g}{}\n", fit->pressure[i], fit->measured[i], fit->fitted[i],
                    several ? fmt::format(",{}", fit->specimen[i] + 1) : "");
  return result;
}

} // namespace plyform
