// SPDX-License-Identifier: GPL-3.0-or-later
// Friction of a case: a coefficient or a law for each pair of bodies.
#pragma once

#include "contact/forces/friction_law.hpp"

#include <vector>

namespace plyform {

/// Friction by body number: plies 0 .. n-1 from the bottom, then tools.
struct FrictionTable {
  int bodies = 0;
  std::vector<double> mu; ///< bodies x bodies, symmetric
  std::vector<int> law{}; ///< likewise: number of the law that holds instead, or -1; empty: none
  double operator()(int a, int b) const { return mu[place(a, b)]; }
  int law_of(int a, int b) const { return law.empty() ? -1 : law[place(a, b)]; }

private:
  std::size_t place(int a, int b) const { return static_cast<std::size_t>(a * bodies + b); }
};

} // namespace plyform
