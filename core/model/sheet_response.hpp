// SPDX-License-Identifier: GPL-3.0-or-later
// Stress response of a sheet without yarns, and the geometry that its laws need: shared by all
// laws.
#pragma once

#include "base/geometry.hpp"

namespace plyform {

/// Second Piola-Kirchhoff stresses per length (N/mm) and energy (N mm per mm^2 before forming).
struct SheetResponse {
  double s11, s22, s12, energy;
};

/// G_ab = c_a . c_b of one triangle's fibre gradients (core/ply/membrane.hpp), 1/mm^2.
struct Gram {
  double g11, g22, g12;
};

} // namespace plyform
