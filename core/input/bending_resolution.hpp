// SPDX-License-Identifier: GPL-3.0-or-later
// Whether elements are small enough for what the bending of yarns decides.
//
//   h      mm    element size: side of a square of two triangles
//   D_g    N mm  in-plane bending stiffness of a family; B  N mm  that out of the plane
//   R      N/mm  n_c Cs'(0), shear_rigidity of core/model/fabric_estimates.hpp
//
//   layer    l = sqrt(D_g / R)                      width over which shear passes from one value to
//                                                   another, at small shear
//   sideways lambda = 2 pi sqrt(2 D_g / (N - R))    fastest growing wave of yarns that are pressed
//                                                   with N > R and give way in the plane
//   upwards  lambda = 2 pi (B sqrt(eps) / 2p)^(1/3) wave of yarns that are too long by eps and lift
//                                                   a rigid plate, by their whole height, against a
//                                                   pressure p
// N = 0.2 N/mm is what friction of neighbouring plies passes on to a family; less where it buckles.
// Needed: l of 2.5 elements and waves of six. Five plies over a hemisphere twice, one ply turned by
// 1e-6 degrees: with l of 1.4 elements the shear angle differs by 0.8 to 4.8 degrees rms, of 2.7 by
// 0.1 to 0.4.
#pragma once

#include "core/model/fabric.hpp"

#include <optional>

namespace plyform {

constexpr double elements_in_layer = 2.5;
constexpr double elements_in_wave = 6.0;

/// mm, the narrower of both families; nothing where the question does not arise.
struct BendingLengths {
  std::optional<double> layer;    ///< where some family has D_g and cells resist shear
  std::optional<double> sideways; ///< where yarns bear compression with N > R; 0 without D_g
  std::optional<double> upwards;  ///< where yarns bear compression, bend, and p > 0
};

/// `pressure`: N/mm^2, p; 0 for a ply that nothing presses.
BendingLengths bending_lengths(const Fabric& fabric, double pressure);

/// h, mm, that carries layer and sideways wave; infinite where neither asks for one, 0 where none
/// does.
double element_size_needed(const BendingLengths& lengths);

} // namespace plyform
