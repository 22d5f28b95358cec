// SPDX-License-Identifier: GPL-3.0-or-later
// Measures computing time for the report at the end of a run; results never depend on it.
#pragma once

#include <chrono>

namespace plyform {

/// Seconds that one contact has taken since the start.
struct ContactTime {
  double forces = 0.0, search = 0.0;
};

/// Adds the seconds from its construction to its destruction to a total.
class Stopwatch {
public:
  explicit Stopwatch(double& total) : total_(total) {}
  ~Stopwatch() { total_ += std::chrono::duration<double>(Clock::now() - begin_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

private:
  using Clock = std::chrono::steady_clock;
  double& total_;
  Clock::time_point begin_ = Clock::now();
};

} // namespace plyform
