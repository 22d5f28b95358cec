// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/results/bridging.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace plyform {
namespace {

/// The share of a triangle where a linear field with these values at its corners is above `limit`.
double share_above(std::array<double, 3> values, double limit) {
  std::sort(values.begin(), values.end());
  const auto [low, middle, high] = values;
  if (low > limit) return 1.0;
  if (!(high > limit)) return 0.0;
  if (middle > limit) return 1.0 - (limit - low) * (limit - low) / ((high - low) * (middle - low));
  return (high - limit) * (high - limit) / ((high - low) * (high - middle));
}

} // namespace

Bridging bridging_of(const PlyFrame& ply) {
  Bridging found;
  if (ply.bridging_height.empty()) return found;
  const auto most = std::max_element(ply.bridging_height.begin(), ply.bridging_height.end());
  if (!(*most > 0.0)) return found;
  found.height = *most;
  found.at = ply.x[static_cast<std::size_t>(most - ply.bridging_height.begin())];
  std::vector<double> areas = areas_before(ply);
  for (std::size_t t = 0; t < areas.size(); ++t) {
    const auto [a, b, c] = ply.triangles[t];
    const std::array<double, 3> heights = {ply.bridging_height[at(a)], ply.bridging_height[at(b)],
                                           ply.bridging_height[at(c)]};
    areas[t] *= share_above(heights, 0.5 * ply.thickness[t]);
    found.area += areas[t];
  }
  double highest = -std::numeric_limits<double>::infinity();
  for (const FamilyFrame& family : ply.families) {
    double largest = -std::numeric_limits<double>::infinity(), sum = 0.0;
    for (std::size_t t = 0; t < family.tension.size(); ++t)
      if (areas[t] > 0.0)
        largest = std::max(largest, family.tension[t]), sum += areas[t] * family.tension[t];
    if (!(largest > highest)) continue;
    highest = found.largest_tension = largest;
    found.mean_tension = sum / found.area;
    found.family = family.name;
  }
  return found;
}

} // namespace plyform
