// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/shear_tests.hpp"

#include "base/format.hpp"
#include "core/model/fabric_estimates.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace plyform {
namespace {

using std::numbers::pi;
using std::numbers::sqrt2;

std::optional<SpecimenFault> fault_of_size(const char* size, double value) {
  if (value > 0.0 && std::isfinite(value)) return std::nullopt;
  return SpecimenFault{size, value, "must be greater than 0",
                       fmt::format("give the specimen's {}, in mm", size)};
}

void refuse(const std::optional<SpecimenFault>& fault) {
  if (fault)
    throw std::invalid_argument(
        fmt::format("{} {:g} mm {}; {}", fault->size, fault->value, fault->rule, fault->remedy));
}

} // namespace

bool is_biaxial(const Fabric& fabric) {
  return fabric.families.size() == 2 && fabric.crossings.size() == 1 && !fabric.sheet;
}

std::optional<SpecimenFault> fault_of(const BiasSpecimen& specimen) {
  if (auto fault = fault_of_size("length", specimen.length)) return fault;
  if (auto fault = fault_of_size("width", specimen.width)) return fault;
  if (specimen.length >= 2.0 * specimen.width) return std::nullopt;
  return SpecimenFault{"length", specimen.length,
                       fmt::format("must be at least twice the width, {:g} mm, or no zone of the "
                                   "specimen is free of both clamps",
                                   2.0 * specimen.width),
                       "give the free length between the clamps and the width, or test a longer "
                       "specimen"};
}

std::optional<SpecimenFault> fault_of(const FrameSpecimen& specimen) {
  return fault_of_size("side", specimen.side);
}

ShearTest shear_test(const BiasSpecimen& specimen) {
  refuse(fault_of(specimen));
  const double L = specimen.length, w = specimen.width;
  return {L - w, 0.5 * w * (2.0 * L - 3.0 * w), w * w};
}

ShearTest shear_test(const FrameSpecimen& specimen) {
  refuse(fault_of(specimen));
  return {sqrt2 * specimen.side, specimen.side * specimen.side, 0.0};
}

double side_of(const ShearTest& frame) {
  return frame.diagonal / sqrt2;
}

double locking_extension(const ShearTest& test) {
  return (sqrt2 - 1.0) * test.diagonal;
}

double shear_angle(const ShearTest& test, double extension) {
  const double e = extension / test.diagonal;
  return std::asin(e * (2.0 + e)); // (a), without the cancellation of the arc cosine at e = 0
}

double extension_at(const ShearTest& test, double angle) {
  const double sine = std::sin(angle);
  return test.diagonal * sine / (std::sqrt(1.0 + sine) + 1.0); // (a)
}

TorqueWeights torque_weights(const ShearTest& test, const Fabric& fabric, double extension) {
  const double e = extension / test.diagonal, angle = shear_angle(test, extension);
  const double rate = 2.0 * (1.0 + e) / (test.diagonal * std::cos(angle)); // (b)
  const double cells = fabric.families[0].density * fabric.families[1].density;
  return {angle, cells * test.whole_area * rate, 0.5 * cells * test.half_area * rate};
}

double test_load(const ShearTest& test, const Fabric& fabric, double extension, bool negative) {
  const TorqueWeights weights = torque_weights(test, fabric, extension);
  const double side = negative ? -1.0 : 1.0;
  const auto torque = [&](double angle) {
    return side * fabric.crossings[0].shear.at(side * angle).value;
  };
  return weights.whole * torque(weights.angle) + weights.half * torque(0.5 * weights.angle);
} // (40, 41)

BendingShare in_plane_bending_share(const ShearTest& test, const Fabric& fabric) {
  const double rigidity = shear_rigidity(fabric);
  if (test.half_area == 0.0 || !(rigidity > 0.0)) return {};
  double length = 0.0; // l, mm
  for (const YarnFamily& family : fabric.families)
    length += 0.5 * std::sqrt(family.in_plane_bending / rigidity);
  const double most = 2.0 * sqrt2 * length / test.diagonal;
  return {0.5 * most, most};
}

} // namespace plyform
