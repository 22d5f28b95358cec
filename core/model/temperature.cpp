// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/model/temperature.hpp"

#include "base/format.hpp"
#include "core/model/monotone_curve.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace plyform {
namespace {

constexpr double stiffest = 6.0; // log10 of the largest factor of (1) and (2)
constexpr double hottest = 1e4;  // degC, beyond any process

/// log10 f of (2).
double wlf_exponent(const WlfFactor& law, double celsius) {
  const double above = celsius - law.reference;
  return -law.c1 * above / (law.c2 + above);
}

} // namespace

std::string TemperatureRange::text() const {
  return fmt::format("{:g} to {:g} degC", least, most);
}

TemperatureFactor::TemperatureFactor(TableFactor table) {
  const std::vector<double>& t = table.temperature;
  if (t.size() < 2 || t.size() != table.values.size() ||
      std::adjacent_find(t.begin(), t.end(), std::greater_equal<>()) != t.end() ||
      !std::all_of(table.values.begin(), table.values.end(), [](double v) { return v > 0.0; }) ||
      !(table.reference >= t.front() && table.reference <= t.back()))
    throw std::invalid_argument("a table over temperature that is none");
  LogTable log{t, {}, 0.0};
  for (const double value : table.values)
    log.log_value.push_back(std::log(value));
  log.log_reference = log_value_at(log, table.reference); // the factor there is exactly 1
  law_ = std::move(log);
}

double TemperatureFactor::log_value_at(const LogTable& table, double celsius) {
  const MonotoneCurve curve{table.temperature, table.log_value};
  const auto above = std::upper_bound(table.temperature.begin(), table.temperature.end(), celsius);
  const auto point = static_cast<std::size_t>(above - table.temperature.begin());
  const CubicPiece piece = curve.piece(std::min(point, curve.pieces()) - 1);
  return piece.value(celsius - piece.begin);
}

double TemperatureFactor::at(double celsius) const {
  const TemperatureRange known = range();
  const double t = std::clamp(celsius, known.least, known.most);
  if (const auto* law = std::get_if<ArrheniusFactor>(&law_))
    return std::exp(law->energy / gas_constant *
                    (1.0 / (t - absolute_zero) - 1.0 / (law->reference - absolute_zero)));
  if (const auto* law = std::get_if<WlfFactor>(&law_)) return std::pow(10.0, wlf_exponent(*law, t));
  if (const auto* law = std::get_if<LogTable>(&law_))
    return std::exp(log_value_at(*law, t) - law->log_reference);
  return 1.0;
}

std::pair<double, double> TemperatureFactor::extremes(const TemperatureRange& between) const {
  auto [least, most] = std::minmax({at(between.least), at(between.most)});
  if (const auto* law = std::get_if<LogTable>(&law_)) // which turns nowhere but at its points
    for (const double celsius : law->temperature)
      if (between.holds(celsius))
        least = std::min(least, at(celsius)), most = std::max(most, at(celsius));
  return {least, most};
}

TemperatureRange TemperatureFactor::range() const {
  if (const auto* law = std::get_if<WlfFactor>(&law_))
    return {law->reference - stiffest * law->c2 / (law->c1 + stiffest), hottest};
  if (const auto* law = std::get_if<LogTable>(&law_))
    return {law->temperature.front(), law->temperature.back()};
  if (const auto* law = std::get_if<ArrheniusFactor>(&law_)) {
    const double per_kelvin = 1.0 / (law->reference - absolute_zero) +
                              stiffest * std::log(10.0) * gas_constant / law->energy;
    return {1.0 / per_kelvin + absolute_zero, hottest};
  }
  return {absolute_zero, hottest};
}

double temperature_at(const std::vector<TemperatureStage>& stages, double time) {
  if (time <= stages.front().time) return stages.front().celsius;
  for (std::size_t i = 1; i < stages.size(); ++i) {
    const TemperatureStage &from = stages[i - 1], &to = stages[i];
    if (time < to.time)
      return from.celsius +
             (to.celsius - from.celsius) * (time - from.time) / (to.time - from.time);
  }
  return stages.back().celsius;
}

} // namespace plyform
