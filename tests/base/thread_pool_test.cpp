// SPDX-License-Identifier: GPL-3.0-or-later
// The team of threads: every task once, for many rounds.
#include "base/thread_pool.hpp"

#include <atomic>
#include <chrono>
#include <csignal>
#include <gtest/gtest.h>
#include <memory>
#include <pthread.h>
#include <sched.h>
#include <thread>
#include <vector>

namespace plyform::thread_pool_test {
namespace {

TEST(ThreadPool, DoesEveryTaskOnce) {
  for (const int threads : {1, 2, 3, 4, 7}) {
    ThreadPool pool(threads);
    pool.work_with(threads);
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
    pool.work_with(threads);
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
  pool.work_with(2);
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
    pool.work_with(threads);
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
  pool.work_with(2);
  std::atomic<int> sum{0};
  for (int round = 0; round < 5; ++round) {
    pool.run(10, [&](int i) { sum += i; });
    std::this_thread::sleep_for(std::chrono::milliseconds(20)); // helpers have gone to sleep
  }
  EXPECT_EQ(sum.load(), 5 * 45);
}

// A thread that is held by a signal, as one whose processor another program has.
std::atomic<bool> held{false}, let_go{false};

void hold(int) {
  held = true;
  while (!let_go.load()) {
  }
}

/// The thread of a pool of two that did not call it.
pthread_t helper_of(ThreadPool& pool) {
  const pthread_t caller = pthread_self();
  std::atomic<pthread_t> helper{caller};
  pool.run(2, [&](int) {
    if (pthread_equal(pthread_self(), caller) == 0) helper = pthread_self();
    while (pthread_equal(helper.load(), caller) != 0)
      std::this_thread::yield();
  });
  return helper.load();
}

TEST(ThreadPool, AThreadThatHasBegunNoTaskIsNotWaitedFor) {
  ThreadPool pool(2);
  pool.work_with(2);
  const pthread_t helper = helper_of(pool);
  held = let_go = false;
  ASSERT_NE(std::signal(SIGUSR1, hold), SIG_ERR);
  ASSERT_EQ(pthread_kill(helper, SIGUSR1), 0);
  while (!held.load())
    std::this_thread::yield();
  std::atomic<bool> done{false};
  std::thread later([&] { // so that a pool that waits fails instead of waiting for ever
    for (int ms = 0; ms < 5000 && !done; ++ms)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    let_go = true;
  });
  int sum = 0; // by one thread
  for (int round = 0; round < 3; ++round)
    pool.run(100, [&](int i) { sum += i; });
  EXPECT_FALSE(let_go.load());
  EXPECT_EQ(sum, 3 * 4950);
  done = true;
  later.join();
  std::signal(SIGUSR1, SIG_DFL);
  std::atomic<int> again{0};
  pool.run(100, [&](int i) { again += i; });
  EXPECT_EQ(again.load(), 4950);
}

TEST(ThreadPool, WorksWithOtherNumbersOfThreadsFromRoundToRound) {
  ThreadPool pool(4);
  pool.work_with(4);
  std::atomic<int> begun{0};
  pool.run(4, [&](int) { // each waits for all others, so that all threads are there
    ++begun;
    while (begun.load() < 4)
      std::this_thread::yield();
  });
  for (int round = 0; round < 300; ++round) {
    pool.work_with(1 + round * 7 % 4);
    std::vector<int> done(50, 0); // plain: a task that is done twice at once is a race
    pool.run(50, [&](int i) {
      ++done[static_cast<std::size_t>(i)];
      if (i == 0) std::this_thread::yield(); // so that others come in
    });
    ASSERT_EQ(done, std::vector<int>(50, 1)) << round;
  }
}

TEST(ThreadPool, NoMoreThreadsWorkThanMayRunAtOnce) {
  std::thread([] {
    cpu_set_t all, one;
    CPU_ZERO(&all);
    CPU_ZERO(&one);
    ASSERT_EQ(sched_getaffinity(0, sizeof all, &all), 0);
    for (int cpu = 0; cpu < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++cpu)
      if (CPU_ISSET(cpu, &all)) CPU_SET(cpu, &one);
    ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
    EXPECT_EQ(available_cores(), 1);
    ThreadPool pool(4);
    const pthread_t caller = pthread_self();
    int by_caller = 0;
    for (int round = 0; round < 100; ++round)
      pool.run(20, [&](int) {
        if (pthread_equal(pthread_self(), caller) != 0) ++by_caller;
        std::this_thread::yield(); // any other thread has its turn
      });
    EXPECT_EQ(by_caller, 100 * 20);
    EXPECT_EQ(pool.size(), 4);
  }).join();
}

TEST(ThreadPool, ComesAndGoesWithoutWork) {
  for (int i = 0; i < 50; ++i) {
    const ThreadPool pool(3); // ends while its helpers may not have begun
    EXPECT_EQ(pool.size(), 3);
  }
}

} // namespace
} // namespace plyform::thread_pool_test
