// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/model/energies.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {

double Energies::residual() const {
  return kinetic + fibre + shear + bending + contact + friction + damping - external;
}

double Energies::balance_error() const {
  const double terms[] = {kinetic, fibre, shear, bending, contact, friction, damping, external};
  double largest = 0;
  for (const double term : terms) {
    if (std::isnan(term)) return term; // std::max would lose it
    largest = std::max(largest, std::abs(term));
  }
  if (largest == 0) return 0;
  return residual() / largest;
}

} // namespace plyform
