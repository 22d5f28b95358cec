// SPDX-License-Identifier: GPL-3.0-or-later
// How far an amount of mass lowers the highest of many omega^2 = stiffness / mass, if each gets
// just so much that none of them passes a common limit.
#pragma once

#include <vector>

namespace plyform {

/// stiffness N/mm, mass t.
struct StiffMass {
  double stiffness, mass;
  double omega2() const { return stiffness / mass; }
};

/// 1/s^2: the highest omega^2 before, and the limit kappa that is left after
/// sum max(0, stiffness / kappa - mass) of added mass.
struct OmegaCap {
  double before = 0.0, omega2 = 0.0;
};

/// The lowest limit, not below `least` (1/s^2, positive), that takes no more than `budget` (t) of
/// added mass. All of `stiff` must be above `least`; if there are none the limit is infinite.
OmegaCap lowest_cap(std::vector<StiffMass> stiff, double least, double budget);

} // namespace plyform
