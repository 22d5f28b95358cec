// SPDX-License-Identifier: GPL-3.0-or-later
// What a case will take, by the mesh that was made.
#include "core/setup/size_ahead.hpp"
#include "support/case_files.hpp"

#include <gtest/gtest.h>

namespace plyform::size_ahead_test {
namespace {

PreparedCase with_hole(const std::string& radius, CaseSize size) {
  return prepare_case(data_folder / "good/base.toml",
                      {{"blanks.square.holes", "[{centre = [3.0, 2.0], radius = " + radius + "}]"}},
                      size);
}

// Chords of a hole of 5e-6 mm take steps of nanoseconds, whatever element_size is.
TEST(SizeAhead, OfAMeshThatIsTinySomewhereIsRefused) {
  const PreparedCase tiny = with_hole("5e-6", CaseSize::sensible);
  EXPECT_FALSE(tiny.value);
  ASSERT_EQ(tiny.errors.size(), 1u) << all_texts(tiny);
  EXPECT_EQ(tiny.errors[0].item, "blanks.square");
  EXPECT_NE(tiny.errors[0].rule.find("has triangles in its mesh with a height of"),
            std::string::npos);
  EXPECT_NE(tiny.errors[0].remedy.find("hole"), std::string::npos);
  EXPECT_TRUE(with_hole("5e-6", CaseSize::any).value);
  EXPECT_TRUE(with_hole("2.0", CaseSize::sensible).value);
}

TEST(SizeAhead, OfAMeshHasItsSmallestTriangle) {
  const PreparedCase tiny = with_hole("5e-6", CaseSize::any);
  const SizeAhead size = size_of_meshes(*tiny.value, tiny.meshes, 1);
  EXPECT_LT(size.smallest, 5e-6);
  EXPECT_NEAR((size.where - Vec2(3.0, 2.0)).norm(), 0.0, 1e-4);
  EXPECT_GT(size.seconds, 86400.0);
  EXPECT_EQ(size.triangles, static_cast<double>(tiny.meshes[0].triangles.size()));
}

} // namespace
} // namespace plyform::size_ahead_test
