// SPDX-License-Identifier: GPL-3.0-or-later
// Fabrics that resist by rates in their plane: a weave, three families, a tape in its melt.
#pragma once

#include "support/membrane_checks.hpp"

namespace plyform {

inline Fabric viscous_weave() {
  Fabric f = glass_weave();
  ViscousShear law;
  law.c = {2.0, 1.0};
  law.branches = {{1.0, 0.3}, {0.5, 40.0}};
  f.crossings[0].viscous = law;
  return f;
}

/// Crossings whose torque over the rate is a table.
inline Fabric viscous_triaxial() {
  Fabric f = triaxial();
  ViscousShear law;
  law.curves = {{0.1, {0.0}, {0.2}}, {1.0, {0.0, 1.0}, {0.5, 1.0}}};
  for (Crossing& crossing : f.crossings)
    crossing.viscous = law;
  return f;
}

inline Fabric molten_tape() {
  Fabric f = unidirectional();
  f.matrix = ViscousMatrix{0.02, 0.01};
  return f;
}

/// These, and laws of one part alone: branches, a table of many rates, a crossing of two, and a
/// melt askew to its ply.
inline std::vector<Fabric> viscous_fabrics() {
  Fabric branches = viscous_weave(), table = viscous_weave(), crossing = viscous_triaxial(),
         askew = molten_tape();
  branches.crossings[0].viscous->c.clear();
  ViscousShear& law = *table.crossings[0].viscous;
  law.c.clear();
  for (const double rate : {0.01, 0.1, 1.0, 10.0, 100.0})
    law.curves.push_back(
        {rate,
         {0.0, 0.1, 0.5, 0.7 + 0.01 * rate / 100.0},
         {0.3 * std::sqrt(rate), 0.4 * std::sqrt(rate), 0.4 * std::sqrt(rate), std::sqrt(rate)}});
  crossing.crossings[0].viscous.reset();
  askew.families[0].angle = 0.7;
  return {viscous_weave(), viscous_triaxial(), molten_tape(), branches, table, crossing, askew};
}

} // namespace plyform
