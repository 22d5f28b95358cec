// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/format.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace plyform {
namespace format_test {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN(),
                 endless = std::numeric_limits<double>::infinity();

TEST(Format, PrintsNumbersOrWords) {
  EXPECT_EQ(fmt::format("{:.3g} to {:g}", 1.23456, 2.5), "1.23 to 2.5");
  EXPECT_EQ(fmt::format("{:.4g} to {:.4g} degC", none, -none), "unknown to unknown degC");
  EXPECT_EQ(fmt::format("{}, {:+.1e}", endless, -endless), "endless, minus endless");
  EXPECT_EQ(fmt::format("{:6.2f}", endless), "endless");
}

TEST(Format, LeavesAllElseAsItIs) {
  const std::vector<int> list{1, 2};
  EXPECT_EQ(fmt::format("{:>3} {} {:x} {} {} {}", 7, true, 255u, 'c', "nan", std::string("inf")),
            "  7 true ff c nan inf");
  EXPECT_EQ(fmt::format("{:.{}f} [{}]", 2.0, 2, fmt::join(list, ", ")), "2.00 [1, 2]");
  std::string file; // which is read again
  fmt::format_to(std::back_inserter(file), "{}", none);
  EXPECT_EQ(file, "nan");
}

} // namespace
} // namespace format_test
} // namespace plyform
