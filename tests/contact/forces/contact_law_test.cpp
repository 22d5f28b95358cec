// SPDX-License-Identifier: GPL-3.0-or-later
// The force law of one contact: penalty, damping, Coulomb friction with stick.
#include "contact/forces/contact_law.hpp"
#include "support/contact_checks.hpp"
#include "support/contact_oracles.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace plyform::contact_law_test {
namespace {

constexpr double area = 3.0, k = 2.0; // mm^2, N/mm^3

TEST(ContactLaw, NormalForceIsSpringAndDamperWithoutAdhesion) {
  const ContactLaw law{k, 1e-6, 0.0};
  const NormalForce still = normal_force(law, area, 0.01, 0.0, 1e-6);
  EXPECT_DOUBLE_EQ(still.total, area * k * 0.01);
  EXPECT_EQ(still.damping, 0.0);
  const NormalForce closing = normal_force(law, area, 0.01, 0.002, 1e-6);
  EXPECT_DOUBLE_EQ(closing.total, area * (k * 0.01 + 1e-6 * 0.002 / 1e-6));
  const NormalForce opening = normal_force(law, area, 0.01, -1.0, 1e-6);
  EXPECT_EQ(opening.total, 0.0);
  EXPECT_DOUBLE_EQ(opening.damping, -area * k * 0.01);
  EXPECT_EQ(normal_force(law, area, 0.01, 0.5, 0.0).damping, 0.0); // no step yet
}

TEST(ContactLaw, PressureIsTheSlopeOfTheEnergyAndHasNoEndBeforeItsLimit) {
  constexpr double limit = 0.15;
  const ContactLaw law{k, 0.0, 0.0, limit};
  for (double u = 0.05; u < 0.99; u += 0.01) {
    const double p = u * limit, h = 1e-5 * (1.0 - u) * limit;
    const double slope = (law.energy(p + h) - law.energy(p - h)) / (2.0 * h);
    const double tangent = (law.pressure(p + h) - law.pressure(p - h)) / (2.0 * h);
    // differences over 1e-5 of the room: 1e-10 of curvature, 1e-16 / 1e-5 of rounding
    EXPECT_NEAR(slope / law.pressure(p), 1.0, 1e-8) << u;
    EXPECT_NEAR(tangent / law.tangent(p), 1.0, 1e-8) << u;
    EXPECT_GT(law.pressure(p), k * p);
  }
  EXPECT_NEAR(law.pressure(0.01 * limit), k * 0.01 * limit, 3e-4 * k * 0.01 * limit); // 2 u^2
  EXPECT_GT(law.energy(0.999 * limit), 400.0 * k * limit * limit / 2.0);
  EXPECT_TRUE(std::isfinite(law.pressure(2.0 * limit))); // a fault, but a number
  EXPECT_EQ(law.tangent(-0.1), k);
}

TEST(ContactLaw, NextStepUsesItsShareOfTheRoom) {
  constexpr double limit = 0.1;
  const ContactLaw law{k, 0.0, 0.0, limit};
  EXPECT_DOUBLE_EQ(step_ratio(law, 0.06, 0.01), room_in_a_step(law, 0.06) / 0.01);
  EXPECT_DOUBLE_EQ(step_ratio(law, -0.02, 0.01), (0.02 + room_in_a_step(law, 0.0)) / 0.01);
  EXPECT_TRUE(std::isinf(step_ratio(law, 0.06, -0.01))); // it opens
  EXPECT_EQ(step_ratio(law, 2.0 * limit, 0.01), 0.0);
}

TEST(ContactLaw, StiffnessGrowsAlikeFromAnyDepthInAStep) {
  constexpr double limit = 0.1;
  const ContactLaw law{k, 0.0, 0.0, limit};
  for (double p = 0.0; p < 0.95 * limit; p += 0.01 * limit) {
    const double growth = law.tangent(p + room_in_a_step(law, p)) / law.tangent(p);
    EXPECT_LT(growth, 2.4) << p;
    EXPECT_GT(growth, 2.3) << p;
  }
}

TEST(ContactLaw, FrictionHeatIsNeverNegativeAndNeverMoreThanTheWork) {
  Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const ContactLaw law{k, 0.0, 0.3};
    ContactHistory memory;
    ContactTotals sums;
    const double normal = 1.0 + 0.5 * signed_unit(random);
    Vec3 direction = random_vector(random);
    direction.z() = 0.0;
    double heat = 0.0;
    for (int i = 0; i < 100; ++i) {
      const Vec3 motion = 0.01 * direction; // monotone
      const Vec3 f = friction_force(law, area, normal, Vec3::UnitZ(), motion, memory, sums);
      EXPECT_LE(f.norm(), 0.3 * normal * (1.0 + 1e-14));
      EXPECT_LE(f.dot(motion), 0.0); // against the motion
      EXPECT_GE(sums.friction, heat);
      EXPECT_LE(sums.friction - heat, 0.3 * normal * motion.norm() * (1.0 + 1e-12));
      heat = sums.friction;
    }
  }
}

TEST(ContactLaw, LedgerOfAnyPathIsExact) {
  // In a fixed plane the heat is defined so that the trapezoidal work of the force is the stored
  // energy and the heat, whether it sticks or slides and whatever the normal force.
  Random random(2);
  const ContactLaw law{k, 0.0, 0.3};
  ContactHistory memory;
  ContactTotals sums;
  double work = 0.0;
  Vec3 last = Vec3::Zero();
  for (int i = 0; i < 5000; ++i) {
    const Vec3 motion = Vec3(0.02, 0.02, 0.0).cwiseProduct(random_vector(random));
    const double normal = 1.0 + 0.5 * std::sin(0.01 * i);
    const Vec3 f = friction_force(law, area, normal, Vec3::UnitZ(), motion, memory, sums);
    work -= 0.5 * (f + last).dot(motion);
    last = f;
  }
  const double stored = 0.5 * area * law.tangential() * s_of(memory).squaredNorm();
  EXPECT_GT(sums.friction, 1.0);
  EXPECT_NEAR(work, stored + sums.friction, 1e-12 * work); // rounding
}

TEST(ContactLaw, HistoryTurnsWithTheNormal) {
  const ContactLaw law{k, 0.0, 10.0}; // never slides
  ContactHistory memory;
  ContactTotals sums;
  s_of(memory) = Vec3(0.01, 0.004, 0.0);
  const double length = s_of(memory).norm();
  for (int i = 1; i <= 90; ++i) {
    const double angle = i * std::numbers::pi / 180.0;
    const Vec3 n(std::sin(angle), 0.0, std::cos(angle));
    const Vec3 f = friction_force(law, area, 1.0, n, Vec3::Zero(), memory, sums);
    EXPECT_NEAR(f.dot(n), 0.0, 1e-15);
    EXPECT_NEAR(f.norm(), area * law.tangential() * length, 1e-14);
  }
  EXPECT_EQ(sums.friction, 0.0);
}

TEST(ContactLaw, NoFrictionNoHistory) {
  const ContactLaw law{k, 0.0, 0.0};
  ContactHistory memory;
  ContactTotals sums;
  EXPECT_TRUE(friction_force(law, area, 1.0, Vec3::UnitZ(), {1, 0, 0}, memory, sums).isZero(0.0));
  EXPECT_TRUE(s_of(memory).isZero(0.0));
}

TEST(ContactLaw, ReleaseTurnsTheSpringIntoHeat) {
  const ContactLaw law{k, 0.0, 0.3};
  ContactHistory memory{{0.02, 0.0, 0.0}, 0.1, 1.0};
  ContactTotals sums;
  release(law, area, memory, sums);
  EXPECT_DOUBLE_EQ(sums.friction, 0.5 * area * law.tangential() * 0.02 * 0.02);
  EXPECT_TRUE(s_of(memory).isZero(0.0));
  EXPECT_EQ(memory.damping_force, 0.0);
  EXPECT_EQ(memory.normal_force, 0.0);
}

} // namespace
} // namespace plyform::contact_law_test
