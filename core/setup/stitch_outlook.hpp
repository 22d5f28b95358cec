// SPDX-License-Identifier: GPL-3.0-or-later
// What the stitches of a fabric will do as it shears, by geometry alone: yarns along the material
// axes that keep their length, omega0 apart, sheared by gamma (positive: the angle between them
// closes). Of stitches along s = a e_1 + b e_2:
//   lambda_s^2 = a^2 + b^2 + 2 a b cos(omega0 - gamma)                                        (L)
// which is a^2 + b^2 + 2 a b sin(gamma) for yarns at right angles.
#pragma once

#include "core/model/case.hpp"

#include <optional>
#include <string>
#include <vector>

namespace plyform {

/// rad, the shear angle at which (L) stretches stitches by this strain; none if shear does not.
std::optional<double> shear_at_strain(const Fabric& fabric, const Stitch& stitch, double strain);

/// rad, the shear angle at which the torques of crossings, sheet and stitches are in balance, that
/// nearest to 0: what pre-tension does to a ply that nothing holds. 0 without pre-tension, and
/// without two families.
double free_shear(const Fabric& fabric);

/// A line for each direction of stitches, and one for the shear of a free ply beyond a degree.
std::vector<std::string> describe_stitches(const Fabric& fabric);

/// The same of all fabrics that plies have.
std::vector<std::string> describe_stitches(const Case& data);

} // namespace plyform
