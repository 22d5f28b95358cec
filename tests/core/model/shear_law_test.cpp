// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of shear of both signs, and what deviations do beside them: (C) and (D).
#include "core/model/shear_law.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace plyform::shear_law_test {
namespace {

constexpr double h = 1e-6; // rad: cut-off 1e-12 relative, rounding 1e-9

ShearLaw polynomials() {
  return {{0.4, 0.8, 1.0}, {}, {}, {0.04, 0.1}};
}

/// Stiff where the angle closes, or not at all there.
ShearLaw table(bool nothing_below = false) {
  ShearLaw law;
  law.angle = {-0.9, -0.4, -0.2, 0.0, 0.1, 0.3, 0.6, 1.0};
  law.torque = {-0.2, -0.06, -0.04, 0.0, 0.1, 0.5, 0.8, 3.0};
  if (nothing_below)
    for (std::size_t i = 0; i < 3; ++i)
      law.torque[i] = 0.0;
  return law;
}

ShearLaw odd_table() {
  return {{}, {0.0, 0.3, 0.8}, {0.0, 0.1, 0.9}};
}

const std::vector<double> angles{-1.2, -0.5, -0.21, -0.01, 0.0, 0.01, 0.25, 0.61, 0.95, 1.3};

TEST(ShearLaw, OfBothSignsHasAnEnergy) {
  for (const ShearLaw& law : {polynomials(), table(), table(true), odd_table()})
    for (const double g : angles) {
      const LawPoint p = law.at(g), below = law.at(g - h), above = law.at(g + h);
      if (g != 0.0 || law.tabulated()) {
        EXPECT_NEAR(p.slope, (above.value - below.value) / (2.0 * h), 1e-5) << g;
      }
      EXPECT_NEAR(p.value, (above.energy - below.energy) / (2.0 * h), 1e-6) << g;
      EXPECT_GE(p.value * g, 0.0);
      EXPECT_GE(p.energy, 0.0);
    }
  EXPECT_EQ(polynomials().at(-0.5).value, -(0.04 * 0.5 + 0.1 * 0.125));
  EXPECT_EQ(polynomials().at(-0.0).slope, 0.04); // each side has its own at rest
  EXPECT_EQ(polynomials().at(0.0).slope, 0.4);
  EXPECT_EQ(table().at(-0.4).value, -0.06);
  EXPECT_EQ(table(true).at(-0.5).value, 0.0);
  EXPECT_FALSE(table().odd());
  EXPECT_TRUE(odd_table().odd());
}

/// Torque and secant are the derivatives of (C), at any angle and size of the deviations.
TEST(ShearLaw, AnswersWithTheGradientOfTheEnergyBesideDeviations) {
  for (const ShearLaw& law : {polynomials(), table(), table(true), odd_table()})
    for (const double gamma : angles)
      for (const double s : {1e-3, 0.1, 0.7}) {
        const ShearResponse r = law.respond(gamma, s * s);
        const auto energy = [&](double g, double d) { return law.respond(g, d * d).energy; };
        const double by_gamma = (energy(gamma + h, s) - energy(gamma - h, s)) / (2.0 * h),
                     by_s = (energy(gamma, s + h) - energy(gamma, s - h)) / (2.0 * h);
        EXPECT_NEAR(r.torque, by_gamma, 1e-8) << gamma << ' ' << s;
        EXPECT_NEAR(r.secant * s, by_s, 1e-8) << gamma << ' ' << s;
        EXPECT_GE(r.energy, 0.0);
      }
}

TEST(ShearLaw, IsItselfWithoutDeviationsAndTheMeasureIfItIsOdd) {
  for (const ShearLaw& law : {polynomials(), table(), table(true), odd_table()})
    for (const double gamma : angles) {
      const LawPoint p = law.at(gamma);
      const ShearResponse r = law.respond(gamma, 0.0);
      EXPECT_NEAR(r.torque, p.value, 1e-15);
      EXPECT_NEAR(r.energy, p.energy, 1e-15);
    }
  for (const double gamma : angles) {
    const double g = std::hypot(gamma, 0.3);
    const ShearResponse r = odd_table().respond(gamma, 0.09);
    EXPECT_NEAR(r.energy, odd_table().at(g).energy, 1e-15);
    EXPECT_NEAR(r.secant, odd_table().secant(g), 1e-14);
  }
}

/// Second derivatives of (C) by gamma and s, by differences.
Eigen::Matrix2d tangent(const ShearLaw& law, double gamma, double s) {
  constexpr double d = 1e-5;
  const auto gradient = [&](double g, double t) {
    const ShearResponse r = law.respond(g, t * t);
    return Eigen::Vector2d(r.torque, r.secant * t);
  };
  Eigen::Matrix2d k;
  k.col(0) = (gradient(gamma + d, s) - gradient(gamma - d, s)) / (2.0 * d);
  k.col(1) = (gradient(gamma, s + d) - gradient(gamma, s - d)) / (2.0 * d);
  return k;
}

/// Straight on either side, as far apart as you like: convex, nowhere softer than the softer side,
/// hardly stiffer than the stiffer one, and deviations never free.
TEST(ShearLaw, OfTwoSlopesIsNowhereSofterThanTheSofterSide) {
  for (const double soft : {0.0, 0.03, 0.1, 0.3, 1.0, 10.0, 100.0}) {
    const ShearLaw law{{1.0}, {}, {}, {soft}};
    const double least = std::min(1.0, soft), most = std::max(1.0, soft);
    for (double turn = 0.01; turn < 3.14; turn += 0.01) { // of (gamma, s)
      const double gamma = 0.4 * std::cos(turn), s = 0.4 * std::sin(turn);
      const Eigen::Vector2d own =
          Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(tangent(law, gamma, s)).eigenvalues();
      EXPECT_GE(own[0], least - 1e-6 * most) << soft << ' ' << turn;
      EXPECT_LE(own[1], 1.25 * most) << soft << ' ' << turn;
      EXPECT_GE(law.respond(gamma, s * s).secant, 0.0099 * most) << soft << ' ' << turn;
    }
    // small beside shear they cost what shear of that side does
    for (const double gamma : {-0.4, 0.4}) {
      const double own = gamma > 0.0 ? 1.0 : soft, other = gamma > 0.0 ? soft : 1.0;
      EXPECT_NEAR(law.respond(gamma, 1e-8).secant, 0.99 * own + 0.01 * other, 1e-6 * most);
    }
  }
}

/// Whatever monotone table: resists at rest and in any state, and deviations always cost.
TEST(ShearLaw, ResistsAtRestAndBesideDeviations) {
  for (const ShearLaw& law : {polynomials(), table(), table(true)})
    for (const double s : {0.0, 1e-3, 0.1, 0.5}) {
      EXPECT_GT(law.respond(0.0, s * s).secant, 0.0) << s;
      for (const double gamma : angles) {
        if (s > 0.0) {
          EXPECT_GT(law.respond(gamma, s * s).secant, 0.0) << gamma << ' ' << s;
        }
      }
      EXPECT_GE(tangent(law, 0.0, s)(0, 0), 0.0) << s;
    }
}

TEST(ShearLaw, MeanOfBothSidesIsTheOddPart) {
  const ShearLaw law = polynomials();
  const LawPoint p = law.at(0.5), n = law.at(-0.5), mean = law.odd_part(0.5);
  EXPECT_EQ(mean.value, 0.5 * (p.value - n.value));
  EXPECT_EQ(mean.energy, 0.5 * (p.energy + n.energy));
  EXPECT_EQ(law.odd_part(0.0).slope, 0.22);
}

} // namespace
} // namespace plyform::shear_law_test
