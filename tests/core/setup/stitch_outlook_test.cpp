// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/setup/stitch_outlook.hpp"
#include "support/membrane_checks.hpp"

#include <gtest/gtest.h>

namespace plyform::stitch_outlook_test {
namespace {

/// sin(gamma) = lambda^2 - 1 along the diagonal, minus that across it.
TEST(StitchOutlook, SaysAtWhichShearAStrainIsReached) {
  const Fabric f = biaxial();
  for (const double strain : {-0.2, 0.05, 0.2}) {
    const double length = 1.0 + strain, gamma = std::asin(length * length - 1.0);
    EXPECT_NEAR(shear_at_strain(f, stitch_at(0.0, 1.0), strain).value(), gamma, 1e-12);
    EXPECT_NEAR(shear_at_strain(f, stitch_at(0.5 * std::numbers::pi, 1.0), strain).value(), -gamma,
                1e-12);
  }
  EXPECT_FALSE(shear_at_strain(f, stitch_at(0.0, 1.0), 0.5)); // root of 2 is the end
  EXPECT_FALSE(shear_at_strain(f, stitch_at(0.25 * std::numbers::pi, 1.0), 0.01)); // along yarns
}

/// Linear laws and a small angle: n_c k g = -n P / 2.
TEST(StitchOutlook, FindsTheShearOfAFreePly) {
  Fabric f = biaxial();
  f.crossings[0].shear.k = {5.0};
  EXPECT_EQ(free_shear(f), 0.0);
  f.stitches = {stitch_at(0.0, 1e-3)};
  f.stitches[0].law.taut_at = -0.1 / 1e-3; // 0.1 N whatever the strain
  const double cells = f.families[0].density * f.families[1].density;
  const double wanted = -0.2 * 0.1 / 2.0 / (cells * 5.0);
  EXPECT_NEAR(free_shear(f), wanted, 0.03 * std::abs(wanted));
  ASSERT_EQ(describe_stitches(f).size(), 2u);
  EXPECT_NE(describe_stitches(f)[0].find("pulls by 0.1 N"), std::string::npos);
  f.stitches.push_back(f.stitches[0]);
  f.stitches[1].angle = 0.5 * std::numbers::pi; // across it, which balances it
  EXPECT_NEAR(free_shear(f), 0.0, 1e-4);
}

TEST(StitchOutlook, TellsWhatStitchesDo) {
  Fabric f = biaxial();
  f.name = "pillar";
  f.stitches = {stitch_at(0.0, 30.0, 0.05)};
  f.stitches[0].law.breaking_force = 3.0;
  ASSERT_EQ(describe_stitches(f).size(), 1u);
  EXPECT_EQ(describe_stitches(f)[0],
            "pillar: stitch at 0 degrees, 0.2 a mm: taut from 5.88 degrees "
            "of shear, breaks at 18.8 degrees of shear");
  EXPECT_TRUE(describe_stitches(biaxial()).empty());
}

} // namespace
} // namespace plyform::stitch_outlook_test
