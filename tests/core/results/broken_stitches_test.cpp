// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/results/broken_stitches.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace plyform::broken_stitches_test {
namespace {

/// Five squares of 1 mm in a row along x, two triangles each, formed 10 mm higher.
PlyFrame row() {
  PlyFrame ply;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 2; ++j)
      ply.x0.emplace_back(i, j, 0.0), ply.x.emplace_back(i, j, 10.0);
  for (int i = 0; i < 5; ++i) {
    ply.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 3});
    ply.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 1});
  }
  return ply;
}

TEST(BrokenStitches, FindsTheLargestPatch) {
  PlyFrame ply = row();
  ply.stitches.resize(2);
  ply.stitches[0].name = "seam";
  ply.stitches[0].broken = {1, 1, 0, 0, 0, 1, 1, 1, 0, 0}; // apart by whole ones
  ply.stitches[1].broken.assign(10, 0.0);
  const std::vector<BrokenStitches> found = broken_stitches(ply);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].name, "seam");
  EXPECT_DOUBLE_EQ(found[0].area, 2.5);
  EXPECT_DOUBLE_EQ(found[0].share, 0.5);
  EXPECT_DOUBLE_EQ(found[0].patch_area, 1.0);
  EXPECT_NEAR((found[0].patch_at - Vec3(0.5, 0.5, 10.0)).norm(), 0.0, 1e-12);
  EXPECT_EQ(found[1].area, 0.0);
  EXPECT_EQ(found[1].patch_area, 0.0);
  EXPECT_DOUBLE_EQ(broken_share(ply), 0.5);
  EXPECT_TRUE(std::isnan(broken_share(row())));
}

} // namespace
} // namespace plyform::broken_stitches_test
