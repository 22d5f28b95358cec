// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/forces/compaction_curve.hpp"
#include "contact/forces/contact_law.hpp"
#include "contact/forces/tool_ply.hpp"
#include "support/contact_checks.hpp"

#include <gtest/gtest.h>

namespace plyform::compaction_curve_test {
namespace {

/// p = scale d^power, down to 0.1 mm.
HalfCompaction power_law(double scale, double power) {
  HalfCompaction half;
  for (int i = 0; i <= 400; ++i) {
    const double depth = 0.1 * i / 400.0;
    half.depth.push_back(depth);
    half.pressure.push_back(scale * std::pow(depth, power));
  }
  return half;
}

TEST(CompactionCurve, FollowsItsPointsAndTheirIntegral) {
  const HalfCompaction half = power_law(100.0, 3.0);
  const CompactionCurve curve(&half, nullptr);
  EXPECT_NEAR(curve.packed(), 0.1, 1e-15);
  EXPECT_NEAR(curve.last_pressure(), 0.1, 1e-12);
  for (const double depth : {0.013, 0.05, 0.0872, 0.1}) {
    EXPECT_NEAR(curve.pressure(depth), 100.0 * depth * depth * depth, 2e-5);
    EXPECT_NEAR(curve.energy(depth), 25.0 * std::pow(depth, 4.0), 1e-6);
    EXPECT_NEAR(curve.depth_at(curve.pressure(depth)), depth, 1e-12);
    EXPECT_NEAR(curve.steepest(depth) / (300.0 * depth * depth), 1.0, 0.05);
  }
  EXPECT_EQ(curve.pressure(0.0), 0.0);
}

/// Two in series bear the same pressure; the curve ends where the first is packed.
TEST(CompactionCurve, DepthsOfTwoInSeriesAddUp) {
  const HalfCompaction soft = power_law(20.0, 2.0), hard = power_law(300.0, 2.0);
  const CompactionCurve curve(&soft, &hard);
  EXPECT_NEAR(curve.last_pressure(), 0.2, 1e-12);
  for (const double p : {0.01, 0.08, 0.19})
    EXPECT_NEAR(curve.depth_at(p), std::sqrt(p / 20.0) + std::sqrt(p / 300.0), 2e-4);
}

TEST(CompactionCurve, WhatDoesNotAscendIsRefused) {
  HalfCompaction half{{0.0, 0.1, 0.1}, {0.0, 0.1, 0.2}};
  EXPECT_THROW(CompactionCurve(&half, nullptr), std::invalid_argument);
  half = {{0.01, 0.1}, {0.0, 0.1}};
  EXPECT_THROW(CompactionCurve(&half, nullptr), std::invalid_argument);
  EXPECT_THROW(CompactionCurve(nullptr, nullptr), std::invalid_argument);
}

/// A node pressed on a floor, back, and further than before and beyond the packing: as the law
/// says, whose force is the slope of what is stored, and the rest is lost.
TEST(CompactionCurve, AContactGoesItsWayBackAndCountsWhatIsLost) {
  const HalfCompaction way = power_law(100.0, 3.0), back = power_law(1e4, 5.0);
  ToolBody floor;
  floor.shape = Plane{};
  std::vector<ToolPlyContact> contact(1);
  contact[0].law = {3.0, 0.0, 0.0, 0.05};
  contact[0].law.loading = std::make_shared<CompactionCurve>(&way, nullptr);
  contact[0].law.unloading = std::make_shared<CompactionCurve>(&back, nullptr, 0.1);
  contact[0].half_thickness = 0.3;
  const ContactLaw& law = contact[0].law;
  OwnedSheet node = points_only({{0.0, 0.0, 0.3}}, 2.0);
  find_tool_ply_points(contact[0], floor, node.state(), 1.0, 0.0);
  double work = 0.0, most = 0.0, last = 0.0, path = 1.0;
  std::vector<double> depths;
  for (const auto& [from, to] :
       {std::pair(0.0, 0.06), {0.06, 0.03}, {0.03, 0.08}, {0.08, 0.04}, {0.04, 0.12}})
    for (int i = 1; i <= 400; ++i)
      depths.push_back(from + (to - from) * i / 400.0);
  double depth = 0.0;
  for (const double next : depths) {
    node.motion[0] = {0.0, 0.0, depth - next};
    node.x[0].z() = 0.3 - next;
    most = std::max(most, std::min(next, law.packed()));
    const std::vector<SurfaceKinematics> states{node.state()};
    tool_ply_forces(floor, contact, states, std::vector<double>{path += 1.0}, 0.0);
    const double force = contact[0].force[0].z();
    ASSERT_NEAR(force, 2.0 * law.pressure(next, most), 1e-12) << next;
    work += 0.5 * (force + last) * (next - depth);
    last = force, depth = next;
  }
  const ContactTotals& sums = contact[0].sums;
  EXPECT_NEAR(sums.elastic + sums.compaction, work, 1e-4 * work);
  EXPECT_GT(sums.compaction, 0.1 * work);
}

/// A curve that flattens: beyond its end the kernel, and what pushed tools are balanced by, go on
/// with the slope that it has there, not with the steepest.
TEST(CompactionCurve, BeyondItsEndAContactGoesOnWithTheLastSlope) {
  const HalfCompaction half{{0.0, 0.08, 0.1}, {0.0, 0.02, 0.1}};
  std::vector<ToolPlyContact> contact(1);
  contact[0].law = {0.5, 0.0, 0.0, 0.05};
  contact[0].law.loading = std::make_shared<CompactionCurve>(&half, nullptr);
  contact[0].half_thickness = 0.3;
  const double slope = contact[0].law.loading->last_slope();
  EXPECT_NEAR(slope, 0.25, 1e-9); // N/mm^3; 4 at the begin
  ToolBody floor;
  floor.shape = Plane{};
  OwnedSheet node = points_only({{0.0, 0.0, 0.3}}, 2.0);
  find_tool_ply_points(contact[0], floor, node.state(), 1.0, 0.0);
  node.x[0].z() = 0.3 - 0.11;
  const std::vector<SurfaceKinematics> states{node.state()};
  tool_ply_forces(floor, contact, states, std::vector<double>{1.0}, 0.0);
  const double u = 0.01 / 0.05, q = 1.0 - u * u, wanted = 0.1 + 0.01 * (slope + 0.5 / (q * q));
  EXPECT_NEAR(contact[0].force[0].z(), 2.0 * wanted, 1e-9);
  EXPECT_NEAR(contact[0].law.pressure(0.11), wanted, 1e-9);
}

} // namespace
} // namespace plyform::compaction_curve_test
