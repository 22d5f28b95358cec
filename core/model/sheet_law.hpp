// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of sheets without yarns. Each law is a struct in a file of its own, with two member
// functions:
//   SheetResponse at(k1, k2)                      stresses and energy
//   double stiffness_bound(k1, k2, gram)          of the largest eigenvalue, for the stable step
//   double plane_stiffness(), shear_stiffness()   at rest, for estimates and what is told
#pragma once

#include "core/model/isotropic.hpp"
#include "core/model/mooney_rivlin.hpp"

#include <variant>

namespace plyform {

using SheetLaw = std::variant<IsotropicLaw, MooneyRivlinLaw>;

} // namespace plyform
