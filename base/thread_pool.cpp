// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/thread_pool.hpp"

#include "base/thread_choice.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <chrono>
#include <cstdint>
#include <exception>
#include <limits>
#include <mutex>
#include <pthread.h>
#include <sched.h>
#include <thread>
#include <time.h>
#include <utility>
#include <vector>

namespace plyform {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_between(Clock::time_point begin, Clock::time_point end) {
  return std::chrono::duration<double>(end - begin).count();
}

/// Processor time, s.
double processor_seconds(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// How long a thread spins before it lets others have its processor, s: longer than it mostly has
/// to wait. Where another program wants the processor it is gone for milliseconds each time.
constexpr double spinning = 1e-4;

} // namespace

/// The processor time of one thread. Alone in its cache lines, as the thread counts in it.
class alignas(128) ThreadTime {
public:
  /// Clock of this thread's processor time; of the thread that counts and asks if not set.
  void set_clock(clockid_t clock) { clock_ = clock; }

  /// Waits awake until `over()`, `limit` seconds at most. Returns whether it is over. For the
  /// thread itself.
  template <class Condition>
  bool wait(double limit, const Condition& over) {
    // two looks at the clock that are further apart have had another program in between
    constexpr double gone = 5e-5; // s
    const Clock::time_point begin = Clock::now();
    double waited = waited_.load(std::memory_order_relaxed);
    for (Clock::time_point last = begin; !over();) {
      const Clock::time_point now = Clock::now();
      const double turn = seconds_between(last, now), all = seconds_between(begin, now);
      last = now;
      if (turn < gone) waited_.store(waited += turn, std::memory_order_relaxed);
      if (all > limit) return false;
      if (all > spinning) std::this_thread::yield();
    }
    return true;
  }

  /// Seconds of processor time since the last call in which it did not wait. For the thread that
  /// calls ThreadPool::run.
  double computed() {
    const double used = processor_seconds(clock_), waited = waited_.load(std::memory_order_relaxed);
    const double use = used - std::exchange(used_, used);
    return std::max(0.0, use - (waited - std::exchange(waited_before_, waited)));
  }

private:
  std::atomic<double> waited_{0.0}; ///< s of processor time
  clockid_t clock_ = CLOCK_THREAD_CPUTIME_ID;
  double used_ = 0.0, waited_before_ = 0.0; ///< at the last call of `computed`
};

// One round: the calling thread opens it, works too, closes it when no task is left, and waits for
// the helper threads that have entered: one that has lost its processor, or sleeps, holds nobody
// up before it has begun a task. Helpers spin for a while, then sleep: a time step takes a fraction
// of a millisecond, so waking threads through the kernel each time would be too slow.
struct ThreadPool::Impl {
  /// The tasks that a thread begins with. Alone in its cache lines, as the owner counts in it.
  struct alignas(128) Share {
    std::atomic<int> next{0};
    int end = 0;
    const int* tasks = nullptr; ///< null: numbered as they are
  };

  explicit Impl(int threads)
      : shares(static_cast<std::size_t>(threads)), times(shares.size()),
        choice(std::min(threads, available_cores())), active(choice.threads()) {}

  /// `round` counts in its lowest bits the helpers that are in it, has a bit for whether more may
  /// enter, and its number above.
  static constexpr unsigned open = 0x1000, inside = open - 1, next = 2 * open;

  std::vector<Share> shares;     ///< the calling thread's first
  std::vector<ThreadTime> times; ///< likewise
  std::vector<std::thread> helpers;
  const std::function<void(int)>* task = nullptr;
  std::atomic<unsigned> round{0};
  std::atomic<bool> quit{false};
  std::mutex failure_lock;
  std::exception_ptr failure;

  ThreadChoice choice;
  bool chosen = false;     ///< by work_with
  std::atomic<int> active; ///< threads that work, the first ones
  Clock::time_point counted = Clock::now(), last_round = counted;

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
    leave_out_a_pause();
    const bool together = active.load(std::memory_order_relaxed) > 1;
    if (together) open_round();
    work(0);
    if (together) close_round();
    choose_threads();
    if (failure) std::rethrow_exception(std::exchange(failure, nullptr));
  }

  void open_round() {
    const unsigned last = round.load(std::memory_order_relaxed); // closed, with nobody inside
    round.store((last + next) | open, std::memory_order_release);
    round.notify_all();
  }

  /// Waits for the helpers that are in the round.
  void close_round() {
    round.fetch_and(~open, std::memory_order_relaxed);
    const auto empty = [&] { return (round.load(std::memory_order_acquire) & inside) == 0; };
    times[0].wait(std::numeric_limits<double>::infinity(), empty);
  }

  /// Counts no seconds in which the program did something else between two rounds: wrote a file.
  void leave_out_a_pause() {
    constexpr double pause = 0.02; // s, longer than a processor mostly goes to another program
    if (seconds_between(last_round, Clock::now()) > pause) count_from_now();
  }

  void count_from_now() {
    counted = Clock::now();
    for (ThreadTime& time : times)
      time.computed();
  }

  void choose_threads() {
    constexpr double often = 0.05; // s: some turns of other programs, of 4 ms each
    last_round = Clock::now();
    const double wall = seconds_between(counted, last_round);
    if (chosen || wall < often) return;
    double computed = 0.0;
    for (ThreadTime& time : times)
      computed += time.computed();
    counted = last_round;
    choice.count(wall, computed);
    let_work(choice.threads());
  }

  void let_work(int threads) {
    if (active.exchange(threads) != threads) active.notify_all();
  }

  /// Enters the round of now if it is open and has another number than `last`, which becomes its
  /// number.
  bool enter(unsigned& last) {
    unsigned now = round.load(std::memory_order_relaxed);
    while (is_open(now, last))
      if (round.compare_exchange_weak(now, now + 1, std::memory_order_acquire)) {
        last = now / next;
        return true;
      }
    return false;
  }

  static bool is_open(unsigned round, unsigned last) {
    return (round & open) != 0 && round / next != last;
  }

  /// Waits for a round to enter, for a while awake.
  void wait_for_round(std::size_t thread, unsigned last) {
    constexpr double awake = 1e-3; // s: about as long as a step has one thread at work alone
    unsigned now = 0;
    const auto due = [&] {
      now = round.load(std::memory_order_relaxed);
      return is_open(now, last) || quit.load(std::memory_order_relaxed);
    };
    if (!times[thread].wait(awake, due)) round.wait(now, std::memory_order_relaxed);
  }

  void help(std::size_t thread) {
    unsigned last = 0;
    while (!quit.load()) {
      const int working = active.load();
      if (static_cast<int>(thread) >= working) {
        active.wait(working);
        continue;
      }
      wait_for_round(thread, last);
      if (!enter(last)) continue;
      work(thread);
      round.fetch_sub(1, std::memory_order_release);
    }
  }
};

ThreadPool::ThreadPool(int threads) : impl_(std::make_unique<Impl>(threads)) {
  Impl& s = *impl_;
  for (std::size_t i = 1; i < s.shares.size(); ++i) {
    s.helpers.emplace_back([&s, i] { s.help(i); });
    clockid_t clock{};
    if (pthread_getcpuclockid(s.helpers.back().native_handle(), &clock) == 0)
      s.times[i].set_clock(clock);
  }
  s.count_from_now();
}

ThreadPool::~ThreadPool() {
  Impl& s = *impl_;
  s.quit = true;
  s.let_work(size());
  s.round.fetch_add(Impl::next, std::memory_order_release);
  s.round.notify_all();
  for (std::thread& t : s.helpers)
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
  cpu_set_t cores;
  if (sched_getaffinity(0, sizeof cores, &cores) == 0) return std::max(1, CPU_COUNT(&cores));
  return static_cast<int>(std::max(1u, std::thread::hardware_concurrency())); // more than a set has
}

int ThreadPool::size() const {
  return static_cast<int>(impl_->helpers.size()) + 1;
}

void ThreadPool::work_with(int threads) {
  assert(threads >= 1 && threads <= size());
  impl_->chosen = true;
  impl_->let_work(threads);
}

} // namespace plyform
