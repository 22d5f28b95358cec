// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/results/pair_json.hpp"

#include "base/format.hpp"

#include <charconv>
#include <cmath>

namespace plyform {
namespace {

Json range_object(const CurveRange& range) {
  Json object = {{"least", rounded(range.least)}, {"most", rounded(range.most)}};
  if (range.last > range.first) {
    object["curve"] = {rounded(range.first), rounded(range.last)};
    object["below_share"] = rounded_share(range.below_share);
    object["above_share"] = rounded_share(range.above_share);
  }
  return object;
}

} // namespace

double rounded(double value) {
  if (!std::isfinite(value)) return value;
  const std::string digits = fmt::format("{:.9g}", value);
  std::from_chars(digits.data(), digits.data() + digits.size(), value);
  return value;
}

double rounded_share(double value) {
  return std::round(value * 1e4) / 1e4;
}

Json pair_object(const PairReport& pair) {
  Json object = {{"a", pair.a},
                 {"b", pair.b},
                 {"time_share", rounded_share(pair.time_share)},
                 {"deepest_mm", rounded(pair.deepest_mm)},
                 {"slip_mm", rounded(pair.slip_mm)},
                 {"friction_coefficient", rounded(pair.friction_coefficient)},
                 {"friction_mJ", rounded(pair.friction_mJ)}};
  if (!pair.friction_law.empty()) object["friction_law"] = pair.friction_law;
  if (pair.hersey) object["hersey_mm"] = range_object(*pair.hersey);
  if (pair.film_rate) object["film_rate_per_s"] = range_object(*pair.film_rate);
  if (pair.film_temperature) object["film_temperature_C"] = range_object(*pair.film_temperature);
  return object;
}

} // namespace plyform
