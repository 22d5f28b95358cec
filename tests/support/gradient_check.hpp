// SPDX-License-Identifier: GPL-3.0-or-later
// Forces against central differences of the energy that they should be the slope of.
#pragma once

#include "base/geometry.hpp"

#include <gtest/gtest.h>

namespace plyform {

/// Every `stride`-th node's force f (N) is minus the slope of energy(x) (N mm), to 1e-6 of `scale`
/// (N), by steps of 1e-4 mm; x is left as it was.
template <class Energy>
void expect_minus_gradient(std::vector<Vec3>& x, const std::vector<Vec3>& f, double scale,
                           std::size_t stride, const Energy& energy) {
  constexpr double h = 1e-4; // mm
  for (std::size_t n = 0; n < x.size(); n += stride)
    for (int k = 0; k < 3; ++k) {
      const double place = x[n][k];
      x[n][k] = place + h;
      const double up = energy(x);
      x[n][k] = place - h;
      const double down = energy(x);
      x[n][k] = place;
      EXPECT_NEAR(f[n][k], -(up - down) / (2.0 * h), 1e-6 * scale) << n << ' ' << k;
    }
}

} // namespace plyform
