// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/fit_compaction.hpp"

#include "base/format.hpp"
#include "core/identify/compaction_forms.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

/// Of thickness: a law of three numbers that is nearer than this to each row needs no table.
constexpr double near_enough = 0.01;
constexpr double within_scatter = 1.5; ///< likewise, over what rows scatter by
constexpr int table_points = 20;

/// Rows of one specimen by fibre volume; reports an error and returns nothing if they are none.
std::optional<CompactionRows> rows_of_curve(const Curve& curve, std::size_t specimen,
                                            const CompactionSpecimen& of, bool opening,
                                            Diagnostics& diagnostics) {
  CompactionRows rows;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const bool volume = curve.x_is == Quantity::strain;
    const double v = volume ? curve.x[i] : of.layers * of.fibres / curve.x[i];
    const auto refuse = [&](const std::string& rule, const std::string& remedy) {
      diagnostics.error(place_of(curve, i), curve.x_name, written_x(curve, i), rule, remedy);
      return std::nullopt;
    };
    if (!(v > 0.0 && v <= densest_packing))
      return refuse(fmt::format("is a fibre volume of {:.3g} %, and no packing goes above {:g} %",
                                100.0 * v, 100.0 * densest_packing),
                    volume ? "give a fraction, or % in the header"
                           : "check --layers, its unit, and the fabric's surface_density and "
                             "fibre_density");
    if (curve.y[i] < 0.0) {
      diagnostics.error(place_of(curve, i), curve.y_name, written_y(curve, i),
                        "is a pressure below 0", "give the pressure of the plates on the cloth");
      return std::nullopt;
    }
    rows.push_back({curve.y[i], v, specimen});
  }
  std::stable_sort(rows.begin(), rows.end(),
                   [](const auto& a, const auto& b) { return a.pressure < b.pressure; });
  if (rows.size() < 3 || !(rows.back().volume > rows.front().volume) ||
      !(rows.back().pressure > 0.0)) {
    diagnostics.error(
        place_of(curve), curve.x_name, fmt::format("{} rows", rows.size()),
        "is no compaction: it takes three rows, and more fibre volume at more pressure",
        opening ? "give the plates going apart" : "give the plates coming together");
    return std::nullopt;
  }
  return rows;
}

/// The rows as points of a table: fibre volumes that only rise with pressure, few of them.
std::vector<Vec2> points_of(const CompactionRows& rows, double at_rest) {
  const std::vector<double> rising = rising_volumes(rows);
  std::vector<Vec2> points{{0.0, at_rest}}; // pressure, volume
  const double step = (rising.back() - at_rest) / table_points;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool last = i + 1 == rows.size();
    if (!(rows[i].pressure > points.back().x() && rising[i] > points.back().y() + 1e-6)) continue;
    if (last || rows.size() <= table_points || rising[i] - points.back().y() >= step)
      points.emplace_back(rows[i].pressure, rising[i]);
  }
  return points;
}

ThicknessCurve curve_of(const std::vector<Vec2>& points, double fibres) {
  ThicknessCurve curve;
  for (const Vec2& point : points) {
    curve.pressure.push_back(point.x());
    curve.thickness.push_back(fibres / point.y());
  }
  return curve;
}

/// Thickness at a pressure, between points.
double thickness_at(const ThicknessCurve& curve, double pressure) {
  const auto above = std::upper_bound(curve.pressure.begin(), curve.pressure.end(), pressure);
  if (above == curve.pressure.end()) return curve.thickness.back();
  const auto i = static_cast<std::size_t>(above - curve.pressure.begin());
  const double share =
      (pressure - curve.pressure[i - 1]) / (curve.pressure[i] - curve.pressure[i - 1]);
  return curve.thickness[i - 1] + share * (curve.thickness[i] - curve.thickness[i - 1]);
}

/// The law as points, and its numbers.
void put_form(CompactionFit& fit, const FormFit& found, double fibres) {
  fit.scale = found.numbers.scale, fit.shape = found.numbers.shape;
  fit.free_volume = found.numbers.free_volume;
  fit.scale_limits = found.limits.scale, fit.shape_limits = found.limits.shape;
  fit.free_limits = found.limits.free_volume;
  std::vector<Vec2> points;
  for (int i = 0; i <= table_points; ++i) {
    const double share = static_cast<double>(i) / table_points;
    const double v = fit.free_volume + share * (fit.densest - fit.free_volume);
    points.emplace_back(i == 0 ? 0.0 : pressure_at(fit.form, found.numbers, v), v);
  }
  fit.loading = curve_of(points, fibres);
}

/// Of the plates going apart: from where loading ended.
ThicknessCurve opening_of(const CompactionRows& back, const CompactionFit& fit, double fibres) {
  const std::vector<double> rising = rising_volumes(back);
  const double rest = back.front().pressure == 0.0
                          ? rising.front()
                          : std::min(rest_of(back), 0.999 * rising.front());
  std::vector<Vec2> points = points_of(back, rest);
  while (points.size() > 1 &&
         (points.back().x() >= fit.loading.pressure.back() || points.back().y() >= fit.densest))
    points.pop_back();
  ThicknessCurve curve = curve_of(points, fibres);
  curve.pressure.push_back(fit.loading.pressure.back());
  curve.thickness.push_back(fit.loading.thickness.back());
  return curve;
}

/// Largest standard deviation between specimens of the fibre volume at one pressure, over it.
double scatter_between(const std::vector<CompactionRows>& each) {
  double most = 0.0;
  for (const CompactionRow& at : each.front()) {
    std::vector<double> volumes;
    for (const CompactionRows& rows : each)
      if (at.pressure >= rows.front().pressure && at.pressure <= rows.back().pressure)
        volumes.push_back(volume_between(rows, at.pressure));
    if (volumes.size() < 2) continue;
    const Spread spread = spread_of(volumes);
    most = std::max(most, spread.deviation / spread.mean);
  }
  return most;
}

} // namespace

std::optional<CompactionFit> identify_compaction(const std::vector<Curve>& curves,
                                                 const std::vector<Curve>& opening,
                                                 const CompactionSpecimen& specimen,
                                                 std::optional<CompactionForm> form,
                                                 Diagnostics& diagnostics) {
  std::vector<CompactionRows> each;
  CompactionRows rows, back;
  for (const Curve& curve : curves)
    if (const auto of = rows_of_curve(curve, each.size(), specimen, false, diagnostics)) {
      each.push_back(*of);
      rows.insert(rows.end(), of->begin(), of->end());
    }
  for (const Curve& curve : opening)
    if (const auto of = rows_of_curve(curve, 0, specimen, true, diagnostics))
      back.insert(back.end(), of->begin(), of->end());
  if (each.size() < curves.size() || back.empty() != opening.empty()) return std::nullopt;
  for (CompactionRows* all : {&rows, &back})
    std::stable_sort(all->begin(), all->end(),
                     [](const auto& a, const auto& b) { return a.pressure < b.pressure; });

  const FormFit toll_manson = fit_form(CompactionForm::toll_manson, rows);
  CompactionFit fit;
  fit.densest = rising_volumes(rows).back();
  const bool follows = toll_manson.largest <= near_enough ||
                       toll_manson.rms <= within_scatter * scatter_of_rows(rows);
  fit.form =
      form.value_or(follows && back.empty() ? CompactionForm::toll_manson : CompactionForm::table);
  if (fit.form == CompactionForm::table) {
    const bool rests = rows.front().pressure == 0.0;
    fit.free_volume =
        rests ? rising_volumes(rows).front()
              : std::min(toll_manson.numbers.free_volume, 0.999 * rising_volumes(rows).front());
    fit.loading = curve_of(points_of(rows, fit.free_volume), specimen.fibres);
  } else {
    put_form(fit, fit.form == CompactionForm::toll_manson ? toll_manson : fit_form(fit.form, rows),
             specimen.fibres);
  }
  if (!(fit.free_volume < fit.densest)) {
    diagnostics.error(place_of(curves.front()), curves.front().x_name, "",
                      "has a law that does not rise", "give --law table, or check the rows");
    return std::nullopt;
  }
  if (!back.empty()) fit.unloading = opening_of(back, fit, specimen.fibres);
  fit.scatter = each.size() > 1 ? scatter_between(each) : 0.0;
  for (const CompactionRow& row : rows) {
    fit.pressure.push_back(row.pressure);
    fit.measured.push_back(specimen.fibres / row.volume);
    fit.fitted.push_back(thickness_at(fit.loading, row.pressure));
    fit.specimen.push_back(row.specimen);
  }
  fit.quality = quality_of(fit.pressure, fit.measured, fit.fitted);
  if (!check_quality(curves.front(), fit.quality,
                     fmt::format("{:.3g} N/mm2", fit.quality.largest_at),
                     "give --law table, or leave out what is no compaction", diagnostics))
    return std::nullopt;
  return fit;
}

} // namespace plyform
