// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/omega_cap.hpp"

#include <algorithm>
#include <limits>

namespace plyform {

OmegaCap lowest_cap(std::vector<StiffMass> stiff, double least, double budget) {
  std::sort(stiff.begin(), stiff.end(),
            [](const StiffMass& a, const StiffMass& b) { return a.omega2() > b.omega2(); });
  // with kappa between the omega^2 of nodes k and k + 1 the first k get c / kappa - m each
  double stiffness = 0.0, own = 0.0;
  for (std::size_t k = 0; k < stiff.size(); ++k) {
    stiffness += stiff[k].stiffness, own += stiff[k].mass;
    const double found = std::max(stiffness / (own + budget), least);
    const double next = k + 1 < stiff.size() ? stiff[k + 1].omega2() : least;
    if (found >= next) return {stiff[0].omega2(), found};
  }
  return {0.0, std::numeric_limits<double>::infinity()};
}

} // namespace plyform
