// SPDX-License-Identifier: GPL-3.0-or-later
// A pool of threads for numbered tasks. What a task computes must not depend on which thread runs
// it or when: then results are the same bits for any number of threads.
#pragma once

#include <functional>
#include <memory>
#include <vector>

namespace plyform {

/// Number of processors that the calling thread may run on, at least 1.
int available_cores();

/// Beside other programs fewer of its threads work, as many as get most done, and never more than
/// there are processors for: which threads work changes no results. Tasks must not wait for each
/// other.
class ThreadPool {
public:
  /// `threads` >= 1, the calling thread included.
  explicit ThreadPool(int threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  /// Calls task(0) .. task(count - 1), each once, and returns when all are done. Each thread begins
  /// with a share of its own, the same in every call with this count, so that what its processor
  /// holds of the last call serves again; when done it takes from the others'. Only threads that
  /// have begun are waited for. If tasks throw, the others are still done, and the first exception
  /// seen is rethrown.
  void run(int count, const std::function<void(int)>& task);

  /// The same of the tasks in these shares, one share a thread, in their order.
  void run(const std::vector<std::vector<int>>& shares, const std::function<void(int)>& task);

  /// The threads that it was made with.
  int size() const;

  /// From now on so many of them work, 1 to size(), whatever they get done. For tests.
  void work_with(int threads);

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace plyform
