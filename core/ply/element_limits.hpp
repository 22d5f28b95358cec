// SPDX-License-Identifier: GPL-3.0-or-later
// Where an element has no meaning any more, and where the collapse penalty keeps it from getting
// there: the same numbers for the kernels and for the element one triangle at a time. Stretches are
// lengths over unformed lengths.
#pragma once

namespace plyform {

constexpr double collapse_stretch = 0.5;    ///< below, the collapse penalty acts on a yarn
constexpr double collapse_reach = 0.55;     ///< below, the stable step counts with it
constexpr double least_stretch = 0.1;       ///< collapsed below it
constexpr double least_sine_between = 0.02; ///< of the angle between yarns; collapsed below it
constexpr double least_sine = 1e-9;         ///< below, the shear angle has no meaning

} // namespace plyform
