// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/shapes/self_meeting.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace plyform {
namespace self_meeting_test {
namespace {

using Points = std::vector<std::array<double, 3>>;

Profile chain(const Points& points, bool closed = false) {
  return round_corners(points, closed, {"point", "x", "z"});
}

TEST(SelfMeeting, IsFoundWhereLinesCross) {
  const auto place = self_meeting(chain({{0, 0, 0}, {4, 4, 0}, {4, 0, 0}, {0, 4, 0}}));
  ASSERT_TRUE(place);
  EXPECT_NEAR((*place - Vec2(2, 2)).norm(), 0.0, 1e-12);
}

TEST(SelfMeeting, IsFoundWhereAProfileGoesOneWayTwice) {
  EXPECT_TRUE(self_meeting(
      chain({{22, -40, 0}, {22, 0, 0}, {80, 0, 0}, {22, -40, 0}, {22, 0, 0}, {80, 0, 0}})));
}

TEST(SelfMeeting, IsFoundOfArcs) {
  using Kind = ProfileSegment::Kind;
  // a quarter of a circle that comes down through the first line
  const Profile down{{Kind::line, {0, 0}, {10, 0}},
                     {Kind::line, {10, 0}, {10, 4}},
                     {Kind::arc, {10, 4}, {3, -3}, {3, 4}, -1}};
  const auto place = self_meeting(down);
  ASSERT_TRUE(place);
  EXPECT_NEAR((*place - Vec2(3.0 + std::sqrt(33.0), 0.0)).norm(), 0.0, 1e-12);
  // an arc that follows a line and comes back to it, and one that ends before
  const double radius = std::sqrt(5.0);
  Profile back{{Kind::line, {0, 0}, {10, 0}}, {Kind::arc, {10, 0}, {8, 1 - radius}, {8, 1}, 1}};
  const auto there = self_meeting(back);
  ASSERT_TRUE(there);
  EXPECT_NEAR((*there - Vec2(6.0, 0.0)).norm(), 0.0, 1e-12);
  back[1].b = {8, 1 + radius};
  EXPECT_FALSE(self_meeting(back));
}

TEST(SelfMeeting, IsNoneOfSectionsThatToolsHave) {
  EXPECT_FALSE(self_meeting(chain({{80, -120, 0}, {80, 0, 10}, {400, 0, 0}})));
  EXPECT_FALSE(self_meeting(chain({{0, 0, 1}, {4, 0, 1}, {4, 4, 1}, {0, 4, 1}}, true)));
  // fillets that use up the side between them, and one that hardly turns
  EXPECT_FALSE(self_meeting(chain({{0, 0, 0}, {10, 0, 5}, {10, 10, 5}, {20, 10, 0}})));
  EXPECT_FALSE(self_meeting(chain({{0, 0, 0}, {10, 0, 3}, {20, 1e-6, 0}})));
  // a wall a hundredth of a millimetre thin, and a blade
  EXPECT_FALSE(self_meeting(chain({{0, 0, 0}, {50, 0, 0}, {50, 0.01, 0}, {0, 0.01, 0}})));
  EXPECT_FALSE(self_meeting(chain({{0, 0, 0}, {50, 0, 0}, {0, 0, 0}})));
  EXPECT_FALSE(self_meeting({{ProfileSegment::Kind::arc, {1, 0}, {1, 0}, {0, 0}, 1}}));
  // a spiral of arcs
  Profile spiral;
  Vec2 from(1, 0);
  for (int k = 1; k < 20; ++k) {
    const Vec2 to(from.x() > 0 ? -1.0 - 0.1 * k : 1.0 + 0.1 * k, 0);
    spiral.push_back({ProfileSegment::Kind::arc, from, to, 0.5 * (from + to), 1});
    from = to;
  }
  EXPECT_FALSE(self_meeting(spiral));
}

TEST(SelfMeeting, IsTheSameAtAnySize) {
  for (const double scale : {1e-3, 1.0, 1e5}) {
    Points crossed{{0, 0, 0}, {4, 4, 0}, {4, 0, 0}, {0, 4, 0}},
        sound{{8, -12, 0}, {8, 0, 1}, {40, 0, 0}};
    for (auto* points : {&crossed, &sound})
      for (auto& p : *points)
        for (double& v : p)
          v *= scale;
    EXPECT_TRUE(self_meeting(chain(crossed)));
    EXPECT_FALSE(self_meeting(chain(sound)));
  }
}

} // namespace
} // namespace self_meeting_test
} // namespace plyform
