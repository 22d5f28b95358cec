// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ply/membrane_crimp.hpp"

namespace plyform {

std::array<LawPoint, most_families> cell_points(const Membrane& m, const OfFamilies& strain) {
  std::array<LawPoint, most_families> points{};
  for (const MembraneCrossing& c : m.crossings) {
    if (!c.crimp) continue;
    const CellAnswer cell = answer_of(*c.crimp, {strain[c.first], strain[c.second]},
                                      m.families[c.first].yarn, m.families[c.second].yarn);
    points[c.first] = {cell.pull[0], cell.slope[0], cell.stored[0]};
    points[c.second] = {cell.pull[1], cell.slope[1], cell.stored[1]};
  }
  return points;
}

OfFamilies elastic_tensions(const Membrane& m, const OfFamilies& strain) {
  OfFamilies tension{};
  std::array<LawPoint, most_families> cells{};
  if (m.crimped) cells = cell_points(m, strain);
  for (std::size_t a = 0; a < m.families.size(); ++a) {
    const MembraneFamily& f = m.families[a];
    tension[a] = f.crimped ? cells[a].value + (strain[a] < 0.0 ? f.yarn.at(strain[a]).value : 0.0)
                           : f.elastic(strain[a]).value;
  }
  return tension;
}

} // namespace plyform
