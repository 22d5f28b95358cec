// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/stitch_load.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {

StitchElongation elongation_of(const Fabric& fabric, const Stitch& stitch, double gamma) {
  const Vec2 s = material_axes(fabric).components(stitch.angle);
  const double product = s.x() * s.y();
  const double length = std::sqrt(s.squaredNorm() + 2.0 * product * std::sin(gamma));
  return {length - 1.0, product * std::cos(gamma) / length};
}

double stitch_load(const ShearTest& test, const Fabric& fabric,
                   const std::vector<std::size_t>& stitches, double extension, bool negative,
                   const StitchForce& force) {
  const TorqueWeights weights = torque_weights(test, fabric, extension); // of torques of a cell
  const double cells = fabric.families[0].density * fabric.families[1].density;
  const double side = negative ? -1.0 : 1.0;
  const auto torque = [&](double angle) { // of a cell
    double sum = 0.0;
    for (const std::size_t i : stitches) {
      const Stitch& stitch = fabric.stitches[i];
      const StitchElongation at = elongation_of(fabric, stitch, side * angle);
      sum += side * stitch.density * force(at.strain) * at.rate / cells;
    }
    return sum;
  };
  return weights.whole * torque(weights.angle) + weights.half * torque(0.5 * weights.angle);
}

double stitch_load(const ShearTest& test, const Fabric& fabric,
                   const std::vector<std::size_t>& stitches, double extension, bool negative) {
  double load = 0.0;
  for (const std::size_t i : stitches) {
    const StitchLaw& law = fabric.stitches[i].law;
    load += stitch_load(test, fabric, {i}, extension, negative, [&](double strain) {
      const double pull = law.at(strain).value;
      return pull > law.breaking_force ? 0.0 : pull;
    });
  }
  return load;
}

std::vector<std::size_t> stitches_of(const Fabric& fabric, const std::vector<std::size_t>& but) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < fabric.stitches.size(); ++i)
    if (std::find(but.begin(), but.end(), i) == but.end()) found.push_back(i);
  return found;
}

} // namespace plyform
