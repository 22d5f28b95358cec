// SPDX-License-Identifier: GPL-3.0-or-later
// How many threads are chosen beside other programs, on machines that are played: no time is
// measured.
#include "base/thread_choice.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>

namespace plyform::thread_choice_test {
namespace {

/// Seconds that so many threads compute in a second, at a time (s).
using Machine = std::function<double(int threads, double time)>;

/// Two cores, two other programs that get as much as all threads together: one thread has a core of
/// its own or half of one, for 0.5 s each; two are less than that, as they wait for each other.
double shared_by_program(int threads, double time) {
  if (threads > 1) return std::fmod(time, 0.1) < 0.05 ? 0.45 : 0.6;
  return std::fmod(time, 1.5) < 1.0 ? 0.5 : 1.0;
}

/// The same, but each thread gets as much as a program.
double shared_by_thread(int threads, double time) {
  return threads > 1 ? 0.93 : shared_by_program(1, time);
}

/// What is computed in so many seconds, in 0.05 s at a time, over what `threads` would have.
double over_that_of(int threads, ThreadChoice& choice, const Machine& machine, double until) {
  double computed = 0.0, of_those = 0.0;
  constexpr double step = 0.05;
  for (double time = 0.0; time < until; time += step) {
    const double now = step * machine(choice.threads(), time);
    computed += now;
    of_those += step * machine(threads, time);
    choice.count(step, now);
  }
  return computed / of_those;
}

TEST(ThreadChoice, NeverTriesFewerWhereTheyCouldNotComputeMore) {
  for (const int most : {1, 2, 3, 4, 16}) {
    ThreadChoice choice(most);
    for (int i = 0; i < 10000; ++i) {
      ASSERT_EQ(choice.threads(), most);
      choice.count(0.05, 0.05 * (most / 2 + most % 2 + (i % 3 == 0 ? 0.2 : 0.01))); // half and more
    }
  }
}

TEST(ThreadChoice, ComputesLittleLessThanOneThreadWhereThatIsBest) {
  for (const double until : {3.0, 10.0, 60.0}) {
    ThreadChoice two(2), four(4);
    EXPECT_GT(over_that_of(1, two, shared_by_program, until), 0.9) << until;
    EXPECT_GT(over_that_of(1, four, shared_by_program, until), 0.9) << until;
  }
}

TEST(ThreadChoice, LosesLittleWhereSeveralThreadsHardlyMove) {
  ThreadChoice choice(2);
  const Machine machine = [](int threads, double time) {
    return threads > 1 ? 0.1 : shared_by_program(1, time);
  };
  EXPECT_GT(over_that_of(1, choice, machine, 8.0), 0.9);
}

TEST(ThreadChoice, StaysWithSeveralWhereTheyComputeMore) {
  ThreadChoice choice(2);
  EXPECT_GT(over_that_of(2, choice, shared_by_thread, 30.0), 0.9);
  EXPECT_GT(over_that_of(1, choice, shared_by_thread, 30.0), 1.2);
}

TEST(ThreadChoice, ComesBackWhenOtherProgramsHaveEnded) {
  ThreadChoice choice(4);
  over_that_of(1, choice, shared_by_program, 20.0);
  const Machine free = [](int threads, double) { return 0.95 * threads + 0.04; };
  over_that_of(1, choice, free, 5.0);
  EXPECT_EQ(choice.threads(), 4);
  EXPECT_GT(over_that_of(4, choice, free, 10.0), 0.99);
}

TEST(ThreadChoice, FindsANumberBetween) {
  const Machine quarter_taken = [](int threads, double) { // the others wait for each that is gone
    return threads > 8 ? 3.0 : 0.9 * threads;
  };
  ThreadChoice choice(16);
  EXPECT_GT(over_that_of(8, choice, quarter_taken, 20.0), 0.9);
  EXPECT_EQ(choice.threads(), 8);
}

} // namespace
} // namespace plyform::thread_choice_test
