// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of shear with rates: against the differential equation, and in numbers by hand.
#include "core/model/viscous_shear.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace plyform::viscous_shear_test {
namespace {

ViscousShear thinning() {
  ViscousShear law;
  law.curves = {{0.1, {0.0, 0.5}, {1.0, 2.0}}, {1.0, {0.0, 0.5, 1.0}, {4.0, 5.0, 9.0}}};
  return law;
}

TEST(ViscousShear, HasTheTorqueOfItsPolynomial) {
  ViscousShear law;
  law.c = {2.0, 3.0, 4.0};
  EXPECT_NEAR(law.torque(-0.5, 0.2), 0.2 * (2.0 + 3.0 * 0.25 + 4.0 * 0.0625), 1e-15);
  EXPECT_NEAR(law.torque(0.5, -0.2), -law.torque(0.5, 0.2), 1e-15);
}

TEST(ViscousShear, InterpolatesItsTable) {
  const ViscousShear law = thinning();
  EXPECT_NEAR(law.torque(0.25, 0.1), 1.5, 1e-15);
  EXPECT_NEAR(law.torque(0.25, 0.05), 0.75, 1e-15);               // from no torque at rest
  EXPECT_NEAR(law.torque(-0.25, 0.55), 0.5 * (1.5 + 4.5), 1e-15); // between rates
  EXPECT_NEAR(law.torque(2.0, 1.0), 9.0, 1e-15);                  // the last row beyond
  EXPECT_NEAR(law.torque(0.0, 1.9), 4.0 + 3.0, 1e-14);            // and the last slope
  EXPECT_EQ(law.known_rates(), (std::array{0.1, 1.0}));
}

/// (B): D(gamma, v) + K dt v is what drives it.
TEST(ViscousShear, FindsTheViscosityThatBalancesItsSpring) {
  const ViscousShear law = thinning();
  for (const double spring_dt : {1e-3, 0.5, 40.0})
    for (const double driven : {-30.0, -2.0, 1e-3, 0.7, 5.0, 100.0}) {
      const double c = law.viscosity(0.3, driven, spring_dt), v = driven / (c + spring_dt);
      EXPECT_NEAR(law.torque(0.3, v) + spring_dt * v, driven, 1e-12 * std::abs(driven));
      const double hot = law.viscosity(0.3, driven, spring_dt, 0.25),
                   w = driven / (hot + spring_dt);
      EXPECT_NEAR(0.25 * law.torque(0.3, w) + spring_dt * w, driven, 1e-12 * std::abs(driven));
    }
}

/// (X) is exact for a constant rate, in one step or in many, and is a spring or a dashpot in the
/// limits.
TEST(ViscousShear, BranchIsExactForAConstantRate) {
  const MaxwellBranch branch{3.0, 2.0};
  const double rate = 0.1, time = 1.7;
  const double exact = 3.0 * 2.0 * rate * (1.0 - std::exp(-time / 2.0));
  for (const int steps : {1, 7, 1000}) {
    const MaxwellStep step = maxwell_step(branch, time / steps);
    double q = 0.0;
    for (int i = 0; i < steps; ++i)
      q = step.keep * q + step.rise * rate * time / steps;
    EXPECT_NEAR(q, exact, 1e-12);
  }
  EXPECT_NEAR(maxwell_step(branch, 1e-12).rise, 3.0, 1e-9);
  EXPECT_NEAR(maxwell_step(branch, 1e9).rise * 1e9, 3.0 * 2.0, 1e-6);
}

/// A mass on a branch, by central differences: stable up to dt^2 G = 4 whatever the time.
TEST(ViscousShear, BranchLimitsTheStepNoFurtherThanItsSpring) {
  for (const double time : {1e-4, 0.03, 1.0, 1e3}) {
    const double dt = 0.999 * 2.0; // G = 1, mass 1
    const MaxwellStep step = maxwell_step({1.0, time}, dt);
    double x = 1.0, w = 0.0, q = 1.0, largest = 0.0;
    for (int i = 0; i < 20000; ++i) {
      w -= dt * dt * q;
      x += w;
      q = step.keep * q + step.rise * w;
      if (i > 10000) largest = std::max(largest, std::abs(w));
    }
    EXPECT_LT(largest, 1000.0) << time;
  }
}

} // namespace
} // namespace plyform::viscous_shear_test
