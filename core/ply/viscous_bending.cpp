// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ply/viscous_bending.hpp"

#include <algorithm>

namespace plyform {
namespace {

bool is_viscous(const FamilyBending& family) {
  return family.viscosity > 0.0;
}

} // namespace

bool has_viscosity(const BendingLaw& law) {
  return std::any_of(law.families.begin(), law.families.end(), is_viscous);
}

std::optional<ViscousBending>
make_viscous_bending(Bending bending, std::span<const double> node_mass, double omega2) {
  if (!has_viscosity(bending.law)) return std::nullopt;
  ViscousBending v;
  BendingLaw springs;
  for (std::size_t f = 0; f < bending.law.families.size(); ++f)
    if (const FamilyBending& family = bending.law.families[f]; is_viscous(family)) {
      springs.families.push_back({family.along, {1.0, {}, {}}, 0.0});
      v.family.push_back(f), v.viscosity.push_back(family.viscosity);
    }
  bending.law = springs, bending.in_plane.clear();
  v.omega2 = bending_spring_share * omega2;
  v.spring = v.omega2 / bending_omega2(bending, node_mass);
  return v;
}

ViscousBendingEnergy viscous_bending_energy(const ViscousBending& v, std::span<const double> area,
                                            std::span<const double> states) {
  ViscousBendingEnergy sum;
  for (std::size_t n = 0; n < area.size(); ++n) {
    const double* state = states.data() + n * v.states();
    sum.lost += state[0];
    for (std::size_t f = 0; f < v.viscosity.size(); ++f)
      sum.stored += 0.5 * area[n] * state[2 + 2 * f] * state[2 + 2 * f] / v.spring;
  }
  return sum;
}

} // namespace plyform
