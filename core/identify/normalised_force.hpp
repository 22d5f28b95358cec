// SPDX-License-Identifier: GPL-3.0-or-later
// Curves of picture frames as benchmarks publish them: a normalised shear force, N/mm, over the
// shear angle, for frames and fabrics of any size.
//
//   F_norm = F_shear L_frame / L_fabric^2,  F_shear = F / (2 cos phi),  phi = 45 deg - gamma/2
//
// with the load F at a corner of the frame. A frame of side a that the fabric fills to its hinges
// then has F = 2 a cos(phi) F_norm, and by (41) of shear_tests.hpp the torque of the cells of an
// area is d1 d2 Cs(gamma) = F_norm cos(gamma), whatever a is.
//
// Source: J. Cao et al. 2008, Characterization of mechanical behavior of woven fabrics, Composites
// A 39, 1037-1053. Its normalised force of a bias-extension test is another one: its formula has
// both Cs(gamma) and Cs(gamma/2), and the published normalised curves do not follow from the
// published loads by it (cases/measured/README.md), so that no load can be made of them.
#pragma once

#include "core/identify/curve_file.hpp"
#include "core/identify/shear_tests.hpp"

#include <string>

namespace plyform {

/// mm: side of the frame that loads are given for where only angles were measured.
inline constexpr double any_side = 200.0;

/// The reason why a bias-extension test takes no force per length, for ColumnRequest.
std::string no_normalised_bias();

/// F (N) from F_norm (N/mm) in a frame of that side (mm); angle: rad.
double load_of_normalised(double normalised, double angle, double side);

/// Makes loads in N of a curve whose y is a force per length, for a frame of `side`; leaves others
/// alone. measured_angle: by the curve's angles, else by those that belong to its extensions.
void take_normalised(Curve& curve, double side, bool measured_angle);

} // namespace plyform
