// SPDX-License-Identifier: GPL-3.0-or-later
// What a scene holds: constants of kernels once for all plies that are alike.
#include "core/solver/scene.hpp"
#include "support/case_files.hpp"

#include <gtest/gtest.h>

namespace plyform::scene_test {
namespace {

TEST(Scene, HoldsTheConstantsOfPliesThatAreAlikeOnce) {
  const Case c = good_case(fs::path(PLYFORM_CASES) / "hemisphere_five_ply/case.toml");
  const Scene s = make_scene(c); // angles 0, 45, 0, 45, 0
  const auto shared = [&s](int a, int b) {
    const bool membrane = s.plies[a].simd->triangles == s.plies[b].simd->triangles;
    EXPECT_EQ(s.plies[a].bending->constants == s.plies[b].bending->constants, membrane);
    return membrane;
  };
  EXPECT_TRUE(shared(0, 2));
  EXPECT_TRUE(shared(0, 4));
  EXPECT_TRUE(shared(1, 3));
  EXPECT_FALSE(shared(0, 1));
}

} // namespace
} // namespace plyform::scene_test
