// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/measured_angle.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {

AngleDifference angle_difference(const Curve& curve, const ShearTest& test) {
  constexpr std::size_t parts = 10; // means over a tenth of the rows: single ones are noise
  AngleDifference result;
  for (std::size_t part = 0; part < parts; ++part) {
    const std::size_t from = part * curve.size() / parts, to = (part + 1) * curve.size() / parts;
    double difference = 0.0, angle = 0.0;
    for (std::size_t i = from; i < to; ++i) {
      const double crosshead = shear_angle(test, curve.x[i]);
      difference += (crosshead - curve.angle[i]) / static_cast<double>(to - from);
      angle += curve.angle[i] / static_cast<double>(to - from);
    }
    if (std::isnan(difference) || std::abs(difference) <= std::abs(result.largest)) continue;
    result = {difference, angle};
  }
  return result;
}

bool angles_count(const std::vector<Curve>& curves, const std::optional<ShearTest>& test) {
  if (curves.empty() || std::any_of(curves.begin(), curves.end(),
                                    [](const Curve& curve) { return curve.angle.empty(); }))
    return false;
  return std::any_of(curves.begin(), curves.end(), [&](const Curve& curve) {
    return curve.x_name.empty() ||
           (test && std::abs(angle_difference(curve, *test).largest) > same_angle);
  });
}

} // namespace plyform
