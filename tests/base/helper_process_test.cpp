// SPDX-License-Identifier: GPL-3.0-or-later
// Whatever happens in the helper process, this one gets to know it and goes on.
#include "base/helper_process.hpp"

#include <atomic>
#include <csignal>
#include <gtest/gtest.h>
#include <stdexcept>
#include <vector>

namespace plyform::helper_process_test {
namespace {

using End = HelperResult::End;

TEST(HelperProcess, BringsBackWhatTheWorkReturns) {
  const std::string large(3'000'000, 'x'); // more than a pipe holds
  const HelperResult result = in_helper_process([&] { return large; }, {});
  EXPECT_EQ(result.end, End::done);
  EXPECT_EQ(result.text, large);
}

TEST(HelperProcess, BringsBackAnExceptionsText) {
  const HelperResult result =
      in_helper_process([]() -> std::string { throw std::runtime_error("no; do"); }, {});
  EXPECT_EQ(result.end, End::refused);
  EXPECT_EQ(result.text, "no; do");
}

TEST(HelperProcess, SurvivesACrash) {
  for (const int fault : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS}) {
    const HelperResult result = in_helper_process(
        [fault] {
          std::raise(fault);
          return std::string();
        },
        {});
    EXPECT_EQ(result.end, End::crashed);
    EXPECT_EQ(result.text, "ended by signal " + std::to_string(fault));
  }
}

TEST(HelperProcess, EndsWorkThatNeverEnds) {
  const HelperResult result = in_helper_process(
      []() -> std::string {
        for (std::atomic<unsigned long> count{0};;)
          ++count;
      },
      {1, 1 << 30});
  EXPECT_EQ(result.end, End::timeout);
}

TEST(HelperProcess, KeepsItsChangesToItself) {
  int value = 1;
  in_helper_process([&] { return value = 2, std::string(); }, {});
  EXPECT_EQ(value, 1);
}

} // namespace
} // namespace plyform::helper_process_test
