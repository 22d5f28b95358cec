// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/results/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace plyform {

namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

/// Whether a value is NaN, which comparisons of extremes and sorting would ignore.
bool has_nan(const std::vector<double>& values) {
  return std::any_of(values.begin(), values.end(), [](double value) { return std::isnan(value); });
}

} // namespace

double largest(const std::vector<double>& values) {
  return values.empty() || has_nan(values) ? nan_value
                                           : *std::max_element(values.begin(), values.end());
}

double smallest(const std::vector<double>& values) {
  return values.empty() || has_nan(values) ? nan_value
                                           : *std::min_element(values.begin(), values.end());
}

double largest_magnitude(const std::vector<double>& values) {
  if (values.empty()) return 0.0;
  return std::max(std::abs(largest(values)), std::abs(smallest(values)));
}

double percentile(const std::vector<double>& values, const std::vector<double>& areas,
                  double share) {
  if (has_nan(values)) return nan_value;
  if (values.empty()) return 0.0;
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::abs(values[a]) < std::abs(values[b]);
  });
  const double total = std::accumulate(areas.begin(), areas.end(), 0.0);
  double below = 0.0;
  for (const std::size_t i : order) {
    below += areas[i];
    // Tolerance, so that rounding of the sum does not move an exactly reached share to the next
    // value.
    if (below >= share * total * (1.0 - 1e-12)) return std::abs(values[i]);
  }
  return std::abs(values[order.back()]);
}

double root_mean_square(const std::vector<double>& values, const std::vector<double>& areas) {
  double sum = 0.0, total = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum += areas[i] * values[i] * values[i];
    total += areas[i];
  }
  return values.empty() ? 0.0 : std::sqrt(sum / total);
}

double area_share_above(const std::vector<double>& values, double limit,
                        const std::vector<double>& areas) {
  if (has_nan(values)) return nan_value;
  double above = 0.0, all = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    all += areas[i];
    if (values[i] > limit) above += areas[i];
  }
  return all > 0.0 ? above / all : 0.0;
}

} // namespace plyform
