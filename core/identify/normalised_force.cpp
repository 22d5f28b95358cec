// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/normalised_force.hpp"

#include "base/format.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace plyform {

std::string no_normalised_bias() {
  return "normalised curves of this test have shear by both gamma and gamma/2 in them, and "
         "published ones do not follow from the published loads";
}

double load_of_normalised(double normalised, double angle, double side) {
  return 2.0 * side * std::cos(0.25 * std::numbers::pi - 0.5 * angle) * normalised;
}

void take_normalised(Curve& curve, double side, bool measured_angle) {
  if (curve.y_is != Quantity::force_per_length) return;
  const ShearTest test = shear_test(FrameSpecimen{side});
  if (curve.y_written.number.empty()) curve.y_written = {curve.y, "N/mm", 1.0};
  curve.y_written.factor = std::numeric_limits<double>::quiet_NaN();
  const double end = 0.999999 * locking_extension(test); // rows beyond are refused later
  for (std::size_t i = 0; i < curve.size(); ++i)
    curve.y[i] = load_of_normalised(
        curve.y[i], measured_angle ? curve.angle[i] : shear_angle(test, std::min(curve.x[i], end)),
        side);
  curve.y_name += fmt::format(", as load of a frame of {:g} mm", side);
  curve.y_is = Quantity::force;
}

} // namespace plyform
