// SPDX-License-Identifier: GPL-3.0-or-later
// How long work that goes on will still take. tools/base/progress.py does the same.
#pragma once

#include <algorithm>
#include <deque>
#include <optional>
#include <utility>

namespace plyform {

/// Goes by how fast the work was in the last third of its time, not from its start: work that slows
/// down, as a mould closes, goes on as it is now. What is not heard of for long counts too.
class TimeLeft {
public:
  /// seconds: since the work began, no less than before; fraction: of it that is done, 0 to 1.
  void show(double seconds, double fraction) {
    constexpr std::size_t most = 200; // points that are kept
    if (seen_.size() >= 2 && seconds - seen_[seen_.size() - 2].first < seconds / most)
      seen_.pop_back();
    seen_.emplace_back(seconds, fraction);
    while (seen_.size() > 2 && seen_[1].first <= (1.0 - late) * seconds)
      seen_.pop_front();
  }

  /// s from `seconds` on to a fraction of `whole`; nothing as long as too little of the work is
  /// done.
  std::optional<double> left(double seconds, double whole = 1.0) const {
    constexpr double least = 0.02; // a smaller fraction tells nothing
    if (seen_.empty() || !(seen_.back().second >= least * whole)) return std::nullopt;
    const auto [begin, from] = seen_.size() > 1 ? seen_.front() : std::pair(0.0, 0.0);
    const double done = seen_.back().second;
    const double mean = done / seconds, late_speed = (done - from) / (seconds - begin);
    const double speed = done > from && seconds > begin ? late_speed : mean;
    return std::max(whole - done, 0.0) / speed;
  }

private:
  static constexpr double late = 1.0 / 3.0; // of the time so far
  std::deque<std::pair<double, double>> seen_;
};

} // namespace plyform
