// SPDX-License-Identifier: GPL-3.0-or-later
// Strain limits beyond which an element counts as collapsed, and those at which the collapse
// penalty acts: shared by the SIMD kernels and the reference implementation. Stretches are lengths
// over undeformed lengths.
#pragma once

namespace plyform {

constexpr double collapse_stretch = 0.5;    ///< below, the collapse penalty acts on a yarn
constexpr double collapse_reach = 0.55;     ///< below, the stable time step includes the penalty
constexpr double least_stretch = 0.1;       ///< collapsed below it
constexpr double least_sine_between = 0.02; ///< of the angle between yarns; collapsed below it
constexpr double least_sine = 1e-9;         ///< lower limit of that sine in computing shear angles

} // namespace plyform
