// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/results/frame_bytes.hpp"
#include "support/results_helpers.hpp"

namespace plyform::frame_bytes_test {
namespace {

TEST(FrameBytes, GiveTheFrameBack) {
  const Frame some = results_test::frame(0.5);
  const std::string bytes = frame_to_bytes(some);
  const Frame back = frame_from_bytes(bytes);
  EXPECT_EQ(frame_to_bytes(back), bytes);
  ASSERT_EQ(back.plies.size(), some.plies.size());
  EXPECT_EQ(back.plies[1].name, some.plies[1].name);
  EXPECT_EQ(back.plies[1].thickness, some.plies[1].thickness);
  EXPECT_EQ(back.plies[1].x, some.plies[1].x);
  EXPECT_EQ(back.plies[1].reaction, some.plies[1].reaction);
  ASSERT_EQ(back.tools.size(), some.tools.size());
  EXPECT_EQ(back.tools[0].force, some.tools[0].force);
  ASSERT_EQ(back.boundaries.size(), some.boundaries.size());
  EXPECT_EQ(back.boundaries[1].stroke_mm, some.boundaries[1].stroke_mm);
  EXPECT_EQ(back.step, some.step);
}

TEST(FrameBytes, CutShortOrTooLongAreRefused) {
  const std::string bytes = frame_to_bytes(results_test::frame(0.5));
  for (std::size_t size = 0; size < bytes.size(); size += 7)
    EXPECT_THROW(frame_from_bytes(std::string_view(bytes).substr(0, size)), std::runtime_error);
  EXPECT_THROW(frame_from_bytes(bytes + "x"), std::runtime_error);
}

} // namespace
} // namespace plyform::frame_bytes_test
