// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/thread_pool.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace plyform {

// One round: the calling thread publishes the task, increments `round`, works too, and waits until
// every helper thread has left the round. Helpers spin for a while, then sleep on `round`: a time
// step takes a fraction of a millisecond, so waking threads through the kernel each time would be
// too slow.
struct ThreadPool::Impl {
  /// The tasks that a thread begins with. Alone in its cache lines, as the owner counts in it.
  struct alignas(128) Share {
    std::atomic<int> next{0};
    int end = 0;
    const int* tasks = nullptr; ///< null: numbered as they are
  };

  explicit Impl(int threads) : shares(static_cast<std::size_t>(threads)) {}

  /// How long a thread spins before it lets others have its processor, some 100 microseconds:
  /// longer than it mostly has to wait. Where another program wants the processor it is gone for
  /// milliseconds each time.
  static constexpr int spins = 100000;

  std::vector<Share> shares; ///< the calling thread's first
  std::vector<std::thread> helpers;
  const std::function<void(int)>* task = nullptr;
  std::atomic<int> busy{0};
  std::atomic<unsigned> round{0};
  std::atomic<bool> quit{false};
  std::mutex failure_lock;
  std::exception_ptr failure;

  void work_on(Share& share) {
    while (share.next.load(std::memory_order_relaxed) < share.end) {
      const int i = share.next.fetch_add(1, std::memory_order_relaxed);
      if (i >= share.end) return;
      try {
        (*task)(share.tasks ? share.tasks[i] : i);
      } catch (...) {
        const std::lock_guard lock(failure_lock);
        if (!failure) failure = std::current_exception();
      }
    }
  }

  void work(std::size_t thread) {
    for (std::size_t i = 0; i < shares.size(); ++i)
      work_on(shares[(thread + i) % shares.size()]);
  }

  /// Does the tasks of the shares.
  void run() {
    busy.store(static_cast<int>(helpers.size()), std::memory_order_relaxed);
    round.fetch_add(1, std::memory_order_release);
    round.notify_all();
    work(0);
    for (int spin = 0; busy.load(std::memory_order_acquire) > 0;)
      if (spin < spins)
        ++spin;
      else
        std::this_thread::yield();
    if (failure) std::rethrow_exception(std::exchange(failure, nullptr));
  }

  void help(std::size_t thread) {
    unsigned seen = 0;
    for (;;) {
      // spins, then lets others have the processor if they want it, for about as long as a step has
      // one thread at work alone, then sleeps
      constexpr int yields = 1000;
      const auto same = [&] { return round.load(std::memory_order_acquire) == seen; };
      for (int s = 0; s < spins && same(); ++s) {
      }
      for (int y = 0; y < yields && same(); ++y)
        std::this_thread::yield();
      round.wait(seen, std::memory_order_acquire);
      seen = round.load(std::memory_order_acquire);
      if (quit.load()) return;
      work(thread);
      busy.fetch_sub(1, std::memory_order_release);
    }
  }
};

ThreadPool::ThreadPool(int threads) : impl_(std::make_unique<Impl>(threads)) {
  for (std::size_t i = 1; i < impl_->shares.size(); ++i)
    impl_->helpers.emplace_back([this, i] { impl_->help(i); });
}

ThreadPool::~ThreadPool() {
  impl_->quit = true;
  impl_->round.fetch_add(1, std::memory_order_release);
  impl_->round.notify_all();
  for (std::thread& t : impl_->helpers)
    t.join();
}

void ThreadPool::run(int count, const std::function<void(int)>& task) {
  Impl& s = *impl_;
  if (count == 0) return;
  if (s.helpers.empty()) {
    for (int i = 0; i < count; ++i)
      task(i);
    return;
  }
  s.task = &task;
  const auto threads = static_cast<std::int64_t>(s.shares.size());
  for (std::int64_t t = 0; t < threads; ++t) {
    Impl::Share& share = s.shares[static_cast<std::size_t>(t)];
    share.tasks = nullptr;
    share.next.store(static_cast<int>(t * count / threads), std::memory_order_relaxed);
    share.end = static_cast<int>((t + 1) * count / threads);
  }
  s.run();
}

void ThreadPool::run(const std::vector<std::vector<int>>& shares,
                     const std::function<void(int)>& task) {
  Impl& s = *impl_;
  assert(shares.size() == s.shares.size());
  s.task = &task;
  for (std::size_t t = 0; t < shares.size(); ++t) {
    s.shares[t].tasks = shares[t].data();
    s.shares[t].next.store(0, std::memory_order_relaxed);
    s.shares[t].end = static_cast<int>(shares[t].size());
  }
  s.run();
}

int available_cores() {
  return static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

int ThreadPool::size() const {
  return static_cast<int>(impl_->helpers.size()) + 1;
}

} // namespace plyform
