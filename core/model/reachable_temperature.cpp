// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/model/reachable_temperature.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

void widen(TemperatureRange& range, double celsius) {
  range.least = std::min(range.least, celsius), range.most = std::max(range.most, celsius);
}

/// degC of all that is around plies, and of the plies at the start.
TemperatureRange all_around(const Case& data, double start) {
  TemperatureRange around{start, start};
  for (const TemperatureStage& stage : data.process.cooling->surroundings)
    widen(around, stage.celsius);
  for (const Tool& tool : data.tools)
    for (const TemperatureStage& stage : tool.temperature)
      widen(around, stage.celsius);
  for (const Ply& ply : data.plies)
    if (const auto other = start_temperature(data, ply)) widen(around, *other);
  return around;
}

} // namespace

std::optional<TemperatureRange> reachable_temperatures(const Case& data, const Ply& ply) {
  const std::optional<double> start = start_temperature(data, ply);
  if (!start) return std::nullopt;
  const Fabric& fabric = data.fabrics[static_cast<std::size_t>(ply.fabric)];
  if (!data.process.cooling || !fabric.heat_capacity) return TemperatureRange{*start, *start};
  const Cooling& cooling = *data.process.cooling;
  const TemperatureRange around = all_around(data, *start);
  const double seconds = data.process.duration.value_or(0.0) * (1.0 + data.solver.dwell);
  const double h = 2.0 * std::max({cooling.to_tools, cooling.to_plies, cooling.to_air});
  const double left = std::exp(-h * seconds / (fabric.surface_density * *fabric.heat_capacity));
  return TemperatureRange{around.least + (*start - around.least) * left,
                          around.most + (*start - around.most) * left};
}

std::optional<TemperatureRange> reachable_temperatures(const Case& data, int body) {
  const auto i = static_cast<std::size_t>(body);
  if (i < data.plies.size()) return reachable_temperatures(data, data.plies[i]);
  const Tool& tool = data.tools[i - data.plies.size()];
  const std::optional<double> start = tool_temperature(data, tool, 0.0);
  if (!start) return std::nullopt;
  TemperatureRange range{*start, *start};
  for (const TemperatureStage& stage : tool.temperature)
    widen(range, stage.celsius);
  return range;
}

std::vector<std::pair<int, int>> pairs_of_law(const Case& data, int law) {
  std::vector<std::pair<int, int>> pairs;
  const int plies = static_cast<int>(data.plies.size());
  for (int a = 0; a < plies; ++a)
    for (int b = a; b < data.friction.bodies; ++b)
      if (data.friction.law_of(a, b) == law) pairs.emplace_back(a, b);
  return pairs;
}

std::optional<TemperatureRange> film_temperatures(const Case& data, std::pair<int, int> bodies) {
  const auto a = reachable_temperatures(data, bodies.first),
             b = reachable_temperatures(data, bodies.second);
  if (!a || !b) return std::nullopt;
  return TemperatureRange{0.5 * (a->least + b->least), 0.5 * (a->most + b->most)};
}

} // namespace plyform
