// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/model/energies.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {

double Energies::residual() const {
  double sum = 0.0;
  for (const EnergyTerm& term : energy_terms)
    sum += term.sign * this->*term.value;
  return sum;
}

double Energies::largest() const {
  double most = 0.0;
  for (const EnergyTerm& term : energy_terms) {
    if (std::isnan(this->*term.value)) return this->*term.value; // std::max would drop NaN
    most = std::max(most, std::abs(this->*term.value));
  }
  return most;
}

double Energies::balance_error() const {
  const double most = std::max(largest(), floor); // NaN stays
  return most == 0.0 ? 0.0 : residual() / most;
}

double Energies::deformation() const {
  return fibre + shear + stitch + bending + contact + compaction + viscous + stitch_breaking;
}

double Energies::kinetic_over(double work) const {
  const double most = std::max(work, floor);
  return most == 0.0 ? 0.0 : kinetic / most;
}

double Energies::kinetic_over_deformation() const {
  return kinetic_over(deformation());
}

double Energies::kinetic_over_shear() const {
  return kinetic_over(shear);
}

Energies& Energies::operator+=(const Energies& more) {
  for (const EnergyTerm& term : energy_terms)
    this->*term.value += more.*term.value;
  return *this;
}

} // namespace plyform
