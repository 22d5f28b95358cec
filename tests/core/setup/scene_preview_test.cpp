// SPDX-License-Identifier: GPL-3.0-or-later
// The picture of a case before it runs is of the case that runs.
#include "core/setup/prepare_case.hpp"
#include "core/setup/scene_preview.hpp"

#include <gtest/gtest.h>

namespace plyform::scene_preview_test {
namespace {

const std::filesystem::path hemisphere = PLYFORM_CASES "/hemisphere_five_ply/case.toml";

TEST(ScenePreview, HasTheMeshesOfTheRun) {
  const PreparedCase prepared = prepare_case(hemisphere, {});
  const ScenePreview seen = preview_scene(hemisphere, {}, 2);
  ASSERT_TRUE(prepared.value);
  EXPECT_TRUE(seen.mistakes.empty());
  ASSERT_EQ(seen.plies.size(), prepared.meshes.size());
  for (std::size_t i = 0; i < seen.plies.size(); ++i) {
    const PlyPreview& ply = seen.plies[i];
    EXPECT_EQ(ply.triangles, prepared.meshes[i].triangles);
    ASSERT_EQ(ply.x.size(), prepared.meshes[i].x.size());
    for (std::size_t n = 0; n < ply.x.size(); ++n)
      EXPECT_EQ(ply.x[n].head<2>(), prepared.meshes[i].x[n]);
    EXPECT_EQ(ply.x[0].z(), prepared.value->plies[i].z);
  }
  EXPECT_NEAR(seen.stack_thickness, 5 * 0.6, 1e-12);
}

TEST(ScenePreview, KeepsWhatHasNoMistakes) {
  const ScenePreview seen = preview_scene(
      hemisphere, {{"ply.1.fabric", "felt"}, {"tool.0.radius", "-1"}, {"tool.2.force", "\"much\""}},
      1);
  EXPECT_EQ(seen.mistakes.size(), 3u);
  ASSERT_EQ(seen.plies.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_EQ(seen.plies[i].x.empty(), i == 1) << i;
  EXPECT_EQ(seen.plies[1].fabric, "felt");
  EXPECT_EQ(seen.plies[1].trouble, "has mistakes: fabric");
  ASSERT_EQ(seen.tools.size(), 3u);
  EXPECT_TRUE(seen.tools[0].surface.x.empty());
  EXPECT_FALSE(seen.tools[0].gap);
  EXPECT_FALSE(seen.tools[1].surface.x.empty());
  EXPECT_FALSE(seen.tools[2].surface.x.empty()); // it stands where it stands
  EXPECT_TRUE(seen.tools[2].gap);
  EXPECT_EQ(seen.tools[2].motion, "");
}

TEST(ScenePreview, DrawsLargeMeshesCoarser) {
  const ScenePreview seen = preview_scene(hemisphere, {{"blanks.square.element_size", "0.25"}}, 1);
  ASSERT_FALSE(seen.plies.empty());
  EXPECT_GT(seen.plies[0].coarser, 5.0);
  EXPECT_GT(seen.plies[0].triangles.size(), 50'000u);
  EXPECT_LT(seen.plies[0].triangles.size(), 150'000u);
}

TEST(ScenePreview, IsTheSameForAnyNumberOfThreads) {
  const ScenePreview one = preview_scene(hemisphere, {}, 1), two = preview_scene(hemisphere, {}, 2);
  for (std::size_t i = 0; i < one.tools.size(); ++i) {
    EXPECT_EQ(one.tools[i].surface.x, two.tools[i].surface.x);
    EXPECT_EQ(one.tools[i].gap->gap, two.tools[i].gap->gap);
    EXPECT_EQ(one.tools[i].gap->where, two.tools[i].gap->where);
  }
}

} // namespace
} // namespace plyform::scene_preview_test
