// SPDX-License-Identifier: GPL-3.0-or-later
// Element sizes that resolve the length scales set by the bending stiffness of yarns.
//
//   h      mm    element size: side of a square of two triangles
//   D_g    N mm  in-plane bending stiffness of a family; B  N mm  that out of the plane
//   R      N/mm  n_c Cs'(0), shear_rigidity of core/model/fabric_estimates.hpp
//
//   layer    l = sqrt(D_g / R)                      width of the transition between two values of
//                                                   shear, at small shear
//   sideways lambda = 2 pi sqrt(2 D_g / (N - R))    fastest growing in-plane buckling wave of yarns
//                                                   under compression N > R
//   upwards  lambda = 2 pi (B sqrt(eps) / 2p)^(1/3) out-of-plane wave of yarns of excess length eps
//                                                   (strain) that lift a rigid plate, by their
//                                                   whole height, against a pressure p
// N = 0.2 N/mm is the compression of a family by the friction of adjacent plies; less if it
// buckles. Required: 2.5 elements per l, and six per wave. Two runs of five plies over a
// hemisphere, with one ply rotated by 1e-6 degrees in the second: with l of 1.4 elements their
// shear angles differ by 0.8 to 4.8 degrees rms, with 2.7 by 0.1 to 0.4.
#pragma once

#include "core/model/fabric.hpp"

#include <optional>

namespace plyform {

constexpr double elements_in_layer = 2.5;
constexpr double elements_in_wave = 6.0;

/// The lengths above (mm), each the smaller one of both families; nothing where one does not apply.
struct BendingLengths {
  std::optional<double> layer;    ///< if a family has D_g and the cells have shear stiffness
  std::optional<double> sideways; ///< if yarns bear compression and N > R; 0 without D_g
  std::optional<double> upwards;  ///< if yarns bear compression and have B, and p > 0
};

/// pressure: p, N/mm^2; 0 for a ply without pressure.
BendingLengths bending_lengths(const Fabric& fabric, double pressure);

/// Element size h (mm) that resolves layer and sideways wave: infinite if neither applies, 0 if no
/// element size is small enough.
double element_size_needed(const BendingLengths& lengths);

} // namespace plyform
