// SPDX-License-Identifier: GPL-3.0-or-later
// In-plane bending of yarns in the load of a bias-extension test, and its way out of the law.
#include "core/identify/fit_shear.hpp"
#include "support/membrane_checks.hpp"

#include <gtest/gtest.h>
#include <numbers>

namespace plyform::in_plane_share_test {
namespace {

const ShearTest bias = shear_test(BiasSpecimen{300.0, 100.0});

Fabric with_bending(double stiffness) {
  Fabric fabric = glass_weave();
  for (YarnFamily& family : fabric.families)
    family.in_plane_bending = stiffness;
  return fabric;
}

/// Loads of shear up to 50 degrees, `factor` times.
Curve curve_of(const ShearTest& test, const Fabric& fabric, double factor) {
  Curve curve;
  curve.file = "curve.csv";
  const double end = extension_at(test, 50.0 * std::numbers::pi / 180.0);
  for (int i = 0; i <= 60; ++i) {
    curve.x.push_back(end * i / 60.0);
    curve.y.push_back(factor * test_load(test, fabric, curve.x.back()));
    curve.line.push_back(i + 1);
  }
  return curve;
}

TEST(InPlaneShare, IsTwoLayersOfEachYarnBetweenTheClamps) {
  const Fabric fabric = with_bending(2.0);
  const double cells = fabric.families[0].density * fabric.families[1].density;
  const double layer = std::sqrt(2.0 / (cells * fabric.crossings[0].shear.k[0])); // mm
  EXPECT_NEAR(layer, 9.3, 0.05);
  const BendingShare share = in_plane_bending_share(bias, fabric);
  EXPECT_NEAR(share.most, 2.0 * layer / (200.0 / std::numbers::sqrt2), 1e-12);
  EXPECT_NEAR(share.least, 0.5 * share.most, 1e-15);
  const ShearTest twice = shear_test(BiasSpecimen{500.0, 100.0}); // yarns twice as long
  EXPECT_NEAR(in_plane_bending_share(twice, fabric).most, 0.5 * share.most, 1e-12);
}

TEST(InPlaneShare, IsNothingInAFrameOrWithoutBending) {
  EXPECT_EQ(in_plane_bending_share(shear_test(FrameSpecimen{200.0}), with_bending(8.0)).most, 0.0);
  EXPECT_EQ(in_plane_bending_share(bias, glass_weave()).most, 0.0);
}

TEST(InPlaneShare, IsTakenOffTheLoadThatALawIsFoundFrom) {
  for (const double stiffness : {0.5, 2.0, 8.0}) {
    const Fabric truth = with_bending(stiffness);
    const double share = in_plane_bending_share(bias, truth).mean();
    Fabric base = truth;
    base.crossings[0].shear.k = {5.0}; // whatever stands there before
    Diagnostics diagnostics;
    FitOptions options;
    options.corrections.compliance = 0.0;
    const auto fit =
        identify_shear(curve_of(bias, truth, 1.0 + share), bias, base, options, diagnostics);
    ASSERT_TRUE(fit) << stiffness;
    EXPECT_NEAR(fit->in_plane.mean(), share, 1e-7);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(fit->law.k[i], truth.crossings[0].shear.k[i],
                  1e-6 * truth.crossings[0].shear.k[i])
          << stiffness;
    EXPECT_LT(fit->quality.largest, 1e-6);
    EXPECT_EQ(diagnostics.warnings.size(), 0u);
  }
}

TEST(InPlaneShare, WarnsWhereItIsMostOfTheLoad) {
  const Fabric truth = with_bending(40.0);
  Diagnostics diagnostics;
  FitOptions options;
  options.corrections.compliance = 0.0;
  const auto fit = identify_shear(curve_of(bias, truth, 1.4), bias, truth, options, diagnostics);
  ASSERT_TRUE(fit);
  ASSERT_EQ(diagnostics.warnings.size(), 1u);
  EXPECT_NE(diagnostics.warnings[0].find("test a longer specimen"), std::string::npos)
      << diagnostics.warnings[0];
}

} // namespace
} // namespace plyform::in_plane_share_test
