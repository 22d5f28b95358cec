// SPDX-License-Identifier: GPL-3.0-or-later
// Boxes in floats hold those that they are made of, and are hardly larger.
#include "contact/search/float_box.hpp"
#include "support/contact_checks.hpp"

#include <gtest/gtest.h>

namespace plyform::float_box_test {
namespace {

TEST(FloatBox, HoldsTheBoxAndIsHardlyLarger) {
  Random random(1);
  for (const double size : {1e-6, 1.0, 1e5})
    for (int i = 0; i < 1000; ++i) {
      const Vec3 a = size * random_vector(random), b = size * random_vector(random);
      const Vec3 low = a.cwiseMin(b), high = a.cwiseMax(b);
      const FloatBox box(low, high);
      for (int k = 0; k < 3; ++k) {
        const auto axis = static_cast<std::size_t>(k);
        EXPECT_LE(double{box.low[axis]}, low[k]);
        EXPECT_GE(double{box.high[axis]}, high[k]);
        EXPECT_NEAR(double{box.low[axis]}, low[k], 3e-7 * size);
        EXPECT_NEAR(double{box.high[axis]}, high[k], 3e-7 * size);
      }
    }
}

TEST(FloatBox, OverlapsWhatItTouchesOnAnyAxis) {
  const FloatBox box(Vec3(0.1, 0.2, 0.3), Vec3(1.1, 1.2, 1.3));
  EXPECT_TRUE(overlap(box, box));
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const auto moved = [&](double by) {
        Vec3 way = Vec3::Zero();
        way[axis] = side * by;
        return FloatBox(Vec3(0.1, 0.2, 0.3) + way, Vec3(1.1, 1.2, 1.3) + way);
      };
      EXPECT_TRUE(overlap(box, moved(1.0))) << axis; // they touch
      EXPECT_TRUE(overlap(moved(1.0), box)) << axis;
      EXPECT_FALSE(overlap(box, moved(1.00001))) << axis;
      EXPECT_FALSE(overlap(moved(1.00001), box)) << axis;
    }
}

} // namespace
} // namespace plyform::float_box_test
