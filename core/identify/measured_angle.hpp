// SPDX-License-Identifier: GPL-3.0-or-later
// Shear angles measured beside the extension: whether they count, and those of a second file.
#pragma once

#include "core/identify/curve_file.hpp"
#include "core/identify/shear_tests.hpp"

#include <optional>

namespace plyform {

/// rad (0.5 degrees): measured angles that are nearer to those of (a), in means over tenths of the
/// rows, are taken for the formula's, written beside the extension, or for as good.
inline constexpr double same_angle = 0.008726646259971648;

/// Measured less formula's angle, where it differs most, in means over tenths of the rows.
struct AngleDifference {
  double largest = 0.0, at = 0.0; ///< rad: formula's less measured; measured
};
AngleDifference angle_difference(const Curve& curve, const ShearTest& test);

/// Whether the measured angles of curves count, not their extensions, unless the user says so: all
/// have them, and one has no extension or others than (a) says. `test`: may be missing where no
/// curve has an extension.
bool angles_count(const std::vector<Curve>& curves, const std::optional<ShearTest>& test);

} // namespace plyform
