// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/model/mooney_rivlin.hpp"

#include <cmath>

namespace plyform {

/// N/mm per width before forming, of a sheet of rubber whose width is held: 2 (l - 1/l^3) (C10 +
/// C01), as (N) of core/model/mooney_rivlin.hpp.
inline double pure_shear_load(const MooneyRivlinLaw& law, double stretch) {
  return 2.0 * (stretch - std::pow(stretch, -3.0)) * (law.c10 + law.c01);
}

} // namespace plyform
