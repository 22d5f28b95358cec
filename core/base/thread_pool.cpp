// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/thread_pool.hpp"

#include <algorithm>
#include <atomic>
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
  std::vector<std::thread> helpers;
  const std::function<void(int)>* task = nullptr;
  int count = 0;
  std::atomic<int> next{0};
  std::atomic<int> busy{0};
  std::atomic<unsigned> round{0};
  std::atomic<bool> quit{false};
  std::mutex failure_lock;
  std::exception_ptr failure;

  void work() {
    for (int i = next.fetch_add(1); i < count; i = next.fetch_add(1)) {
      try {
        (*task)(i);
      } catch (...) {
        const std::lock_guard lock(failure_lock);
        if (!failure) failure = std::current_exception();
      }
    }
  }

  void help() {
    unsigned seen = 0;
    for (;;) {
      // spins for about 20 microseconds, then lets others have the processor if they want it, for
      // about as long as a step has one thread at work alone
      constexpr int spins = 20000, yields = 1000;
      const auto same = [&] { return round.load(std::memory_order_acquire) == seen; };
      for (int s = 0; s < spins && same(); ++s) {
      }
      for (int y = 0; y < yields && same(); ++y)
        std::this_thread::yield();
      round.wait(seen, std::memory_order_acquire);
      seen = round.load(std::memory_order_acquire);
      if (quit.load()) return;
      work();
      busy.fetch_sub(1, std::memory_order_release);
    }
  }
};

ThreadPool::ThreadPool(int threads) : impl_(std::make_unique<Impl>()) {
  for (int i = 1; i < threads; ++i)
    impl_->helpers.emplace_back([this] { impl_->help(); });
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
  if (s.helpers.empty()) {
    for (int i = 0; i < count; ++i)
      task(i);
    return;
  }
  s.task = &task;
  s.count = count;
  s.next.store(0, std::memory_order_relaxed);
  s.busy.store(static_cast<int>(s.helpers.size()), std::memory_order_relaxed);
  s.round.fetch_add(1, std::memory_order_release);
  s.round.notify_all();
  s.work();
  for (int spin = 0; s.busy.load(std::memory_order_acquire) > 0; ++spin)
    if (spin > 1000) std::this_thread::yield();
  if (s.failure) std::rethrow_exception(std::exchange(s.failure, nullptr));
}

int available_cores() {
  return static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

int ThreadPool::size() const {
  return static_cast<int>(impl_->helpers.size()) + 1;
}

} // namespace plyform
