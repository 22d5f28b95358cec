// SPDX-License-Identifier: GPL-3.0-or-later
// Files that are none, or cannot be read to their end.
#include "base/text.hpp"

#include <filesystem>
#include <gtest/gtest.h>

namespace plyform::text_test {
namespace {

TEST(ReadText, SaysWhatIsNoFile) {
  std::string reason;
  EXPECT_FALSE(read_text(".", reason));
  EXPECT_EQ(reason, "is a folder, not a file");
  EXPECT_FALSE(read_text("no such file", reason));
  EXPECT_EQ(reason, "cannot be opened: No such file or directory");
  EXPECT_FALSE(read_text("/dev/zero", reason)); // was read until the memory was full
  EXPECT_EQ(reason, "is a device, not a file");
}

TEST(ReadText, SaysThatAFileCannotBeRead) {
  if (!std::filesystem::exists("/proc/self/mem")) GTEST_SKIP() << "no file here that fails";
  std::string reason;
  EXPECT_FALSE(read_text("/proc/self/mem", reason)); // of an address that is not there
  EXPECT_EQ(reason, "cannot be read: Input/output error");
}

} // namespace
} // namespace plyform::text_test
