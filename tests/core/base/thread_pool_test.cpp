// SPDX-License-Identifier: GPL-3.0-or-later
// The team of threads: every task once, for many rounds.
#include "core/base/thread_pool.hpp"

#include <atomic>
#include <chrono>
#include <gtest/gtest.h>
#include <memory>
#include <thread>
#include <vector>

namespace plyform::thread_pool_test {
namespace {

TEST(ThreadPool, DoesEveryTaskOnce) {
  for (const int threads : {1, 2, 3, 4, 7}) {
    ThreadPool pool(threads);
    EXPECT_EQ(pool.size(), threads);
    for (const int count : {0, 1, 2, 3, 7, 8, 100, 1000}) {
      std::vector<std::atomic<int>> done(static_cast<std::size_t>(count));
      pool.run(count, [&](int i) { ++done.at(static_cast<std::size_t>(i)); });
      for (const auto& n : done)
        EXPECT_EQ(n.load(), 1) << threads << " threads, " << count << " tasks";
    }
  }
}

TEST(ThreadPool, DoesEveryTaskOfSharesOnceHoweverUnevenTheyAre) {
  for (const int threads : {1, 2, 3, 4}) {
    ThreadPool pool(threads);
    for (const int with_all : {0, threads - 1}) { // has all tasks but one of each other thread
      std::vector<std::vector<int>> shares(static_cast<std::size_t>(threads));
      constexpr int count = 500;
      for (int i = 0; i < count; ++i)
        shares[static_cast<std::size_t>(i < threads ? i : with_all)].push_back(count - 1 - i);
      std::vector<std::atomic<int>> done(count);
      pool.run(shares, [&](int i) { ++done.at(static_cast<std::size_t>(i)); });
      for (const auto& n : done)
        EXPECT_EQ(n.load(), 1) << threads << " threads";
    }
  }
}

TEST(ThreadPool, AThreadThatIsHeldUpHasItsShareDoneByOthers) {
  ThreadPool pool(2);
  std::atomic<int> rest{0};
  pool.run(10, [&](int i) { // 0 waits for all others, those of its own share among them
    if (i > 0) {
      ++rest;
      return;
    }
    while (rest.load() < 9)
      std::this_thread::yield();
  });
  EXPECT_EQ(rest.load(), 9);
}

TEST(ThreadPool, WhatARoundWroteIsSeenByTheNext) {
  // Plain integers: each round reads what other threads wrote in the one before. With the thread
  // sanitizer a missing hand-over is a failure by itself.
  constexpr int size = 37, rounds = 3000;
  for (const int threads : {2, 3}) {
    ThreadPool pool(threads);
    std::vector<long> now(size, 1), next(size, 0);
    std::vector<long> expected = now;
    for (int round = 0; round < rounds; ++round) {
      pool.run(size, [&](int i) {
        const auto n = static_cast<std::size_t>(i);
        next[n] = (now[n] + now[(n + 1) % size] + i) % 1000003;
      });
      now.swap(next);
      std::vector<long> after(size);
      for (std::size_t n = 0; n < size; ++n)
        after[n] = (expected[n] + expected[(n + 1) % size] + static_cast<long>(n)) % 1000003;
      expected = after;
    }
    EXPECT_EQ(now, expected) << threads;
  }
}

TEST(ThreadPool, WakesAfterALongPause) {
  ThreadPool pool(2);
  std::atomic<int> sum{0};
  for (int round = 0; round < 5; ++round) {
    pool.run(10, [&](int i) { sum += i; });
    std::this_thread::sleep_for(std::chrono::milliseconds(20)); // helpers have gone to sleep
  }
  EXPECT_EQ(sum.load(), 5 * 45);
}

TEST(ThreadPool, ComesAndGoesWithoutWork) {
  for (int i = 0; i < 50; ++i) {
    const ThreadPool pool(3); // ends while its helpers may not have begun
    EXPECT_EQ(pool.size(), 3);
  }
}

} // namespace
} // namespace plyform::thread_pool_test
