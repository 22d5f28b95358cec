// SPDX-License-Identifier: GPL-3.0-or-later
// Which plies may press each other, and which nothing moves, told before a run.
#include "core/accuracy/error_model.hpp"
#include "core/model/fabric_estimates.hpp"
#include "core/model/reach_ahead.hpp"
#include "support/scene_checks.hpp"

#include <gtest/gtest.h>

namespace plyform::reach_ahead_test {
namespace {

/// A coarse hemisphere with one more ply of its fabric at this place.
Case with_another(double z, const Vec2& seed = Vec2::Zero()) {
  Case data = coarse_hemisphere({0.0});
  data.plies.push_back({"other", 0, 0, 0.0, z});
  data.plies.back().seed = seed;
  for (YarnFamily& family : data.fabrics[0].families)
    family.sources = {ValueSource::missing, ValueSource::missing, ValueSource::missing};
  set_friction(data, 0.2);
  return data;
}

TEST(ReachAhead, PliesOnEachOtherAreAStack) {
  for (const double z : {0.9, 3.0, 20.0}) {
    const ReachAhead ahead = reach_ahead(with_another(z));
    EXPECT_EQ(ahead.plies_in_stack(0), 2) << z;
    EXPECT_EQ(ahead.largest_stack(), 2);
  }
}

TEST(ReachAhead, AFarPlyIsNoPartOfTheStackNorOfTheMotion) {
  for (const Case& data :
       {with_another(500.0), with_another(220.0), with_another(0.3, {900.0, 0.0})}) {
    const ReachAhead ahead = reach_ahead(data);
    EXPECT_EQ(ahead.plies_in_stack(0), 1);
    EXPECT_TRUE(ahead.ply_moves[0]);
    EXPECT_FALSE(ahead.ply_moves[1]);
    EXPECT_EQ(taking_part(data).plies.size(), 1u);
    EXPECT_EQ(ahead.tool_reaches, std::vector<char>({1, 1, 1}));
  }
}

TEST(ReachAhead, WhatMovesAPlyCarriesItIntoReach) {
  Case data = with_another(220.0);
  data.tools[0].position.z() = 300.0, data.tools[0].stroke = 300.0; // through both of them
  EXPECT_EQ(reach_ahead(data).plies_in_stack(0), 2);
  data = with_another(70.0);
  data.tools.clear(), set_friction(data, 0.2);
  EXPECT_EQ(reach_ahead(data).plies_in_stack(0), 1);
  data.gravity = {0.0, 0.0, -9810.0}; // both fall by 49 mm in 0.1 s, one perhaps on the other
  EXPECT_EQ(reach_ahead(data).plies_in_stack(0), 2);
}

TEST(ReachAhead, AToolThatTouchesNothingIsNone) {
  Case data = with_another(500.0);
  data.tools[0].direction = Vec3::UnitZ();
  data.tools[0].position.z() = 120.0;
  EXPECT_FALSE(reach_ahead(data).tool_reaches[0]);
}

TEST(ReachAhead, EstimatesAreForPliesThatPress) {
  Case far = with_another(500.0);
  estimate_missing(far);
  EXPECT_EQ(far.fabrics.size(), 1u);
  EXPECT_EQ(far.fabrics[0].families[0].tension.compression, 0.0);
  EXPECT_TRUE(describe_estimates(far).empty());
  Case three = with_another(0.9);
  three.plies.push_back({"far", 0, 0, 0.0, 500.0});
  estimate_missing(three);
  ASSERT_EQ(three.fabrics.size(), 2u); // the far ply's yarns are as it would have them alone
  EXPECT_EQ(three.fabrics[0].families[0].tension.compression, 460.0);
  EXPECT_EQ(three.fabrics[at(three.plies[2].fabric)].families[0].tension.compression, 0.0);
  EXPECT_EQ(describe_estimates(three).size(), 1u);
}

TEST(ReachAhead, CostParametersAreThoseOfWhatTakesPart) {
  Case alone = coarse_hemisphere({0.0}), beside = with_another(500.0);
  Tool fast = alone.tools[0];
  fast.name = "far", fast.position.z() = 2000.0, fast.stroke = 1000.0,
  fast.direction = Vec3::UnitZ();
  beside.tools.push_back(fast);
  set_friction(beside, 0.2);
  EXPECT_EQ(predicted_error(beside).total(), predicted_error(alone).total());
}

TEST(ReachAhead, BoundariesKeepTheirPliesWhenOthersAreTakenOut) {
  Case data = with_another(500.0);
  std::swap(data.plies[0], data.plies[1]); // the far one first: nothing moves it
  Boundary held;
  held.ply = 1;
  data.boundaries = {held};
  const Case part = taking_part(data);
  ASSERT_EQ(part.plies.size(), 1u);
  EXPECT_EQ(part.plies[0].name, data.plies[1].name);
  EXPECT_EQ(part.boundaries[0].ply, 0);
  EXPECT_TRUE(reach_ahead(part).ply_moves[0]);
}

} // namespace
} // namespace plyform::reach_ahead_test
