// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/machine_kernel_body.hpp"

namespace plyform {

void triad_generic(double* a, const double* b, const double* c, double s, std::size_t count) {
  triad(a, b, c, s, count);
}

double chains_generic(double* at, std::size_t rounds) {
  return chains(at, rounds);
}

} // namespace plyform
