// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/thread_choice.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

// What two threads computed beside two other programs on two cores was 0.53 in a second, within
// 0.1 whenever a tenth of a second was looked at. One thread computed 0.5 where it shared its core,
// and 1 where the others shared theirs, for 0.3 to 0.8 s each, 0.65 in all.

constexpr double memory = 10.0;  ///< s, after which other programs may have come or gone
constexpr double of_late = 0.4;  ///< s
constexpr double settling = 1.0; ///< s that fewer threads are given, to have been on both cores

/// Error of the rate of one second, which goes with the root of the time: what a number of threads
/// may compute more than was seen. Fewer threads than cores are moved about.
constexpr double error_of_most = 0.1, error_of_fewer = 0.2;

} // namespace

void ThreadChoice::Seconds::fade(double after, double time) {
  const double kept = std::exp(-after / time);
  wall *= kept;
  computed *= kept;
}

void ThreadChoice::Seconds::add(double more_wall, double more_computed) {
  wall += more_wall;
  computed += more_computed;
}

ThreadChoice::ThreadChoice(int most) {
  for (int n = most; n > 1; n = (n + 1) / 2)
    choices_.push_back({n, {}});
  choices_.push_back({1, {}});
}

/// The seconds in a second that a number of threads may compute at best, as far as is known.
double ThreadChoice::promise(std::size_t choice) const {
  const auto& [threads, seconds] = choices_[choice];
  if (seconds.wall == 0.0) return threads;
  const double error = choice == 0 ? error_of_most : error_of_fewer;
  return std::min<double>(threads, seconds.rate() + error / std::sqrt(seconds.wall));
}

/// Forgets how more threads did if those of now have had processors of their own for a second: then
/// it was beside programs that have ended.
void ThreadChoice::forget_if_free() {
  constexpr double own = 0.95; // of the time
  if (stayed_ < settling || of_late_.rate() < own * threads()) return;
  for (std::size_t i = 0; i < now_; ++i)
    choices_[i].seconds = {};
}

/// Whether another number may be tried: not before this one is known, unless it is hopeless.
bool ThreadChoice::has_stayed(std::size_t next) const {
  constexpr double least = 0.1; // s, of what the most threads do it says enough
  if (stayed_ >= (now_ == 0 ? least : settling)) return true;
  const Seconds& other = choices_[next].seconds;
  return other.wall >= least && choices_[now_].seconds.rate() < 0.5 * other.rate();
}

void ThreadChoice::count(double wall, double computed) {
  for (Choice& choice : choices_)
    choice.seconds.fade(wall, memory);
  choices_[now_].seconds.add(wall, computed);
  of_late_.fade(wall, of_late);
  of_late_.add(wall, computed);
  stayed_ += wall;
  forget_if_free();
  std::size_t best = 0;
  for (std::size_t i = 1; i < choices_.size(); ++i)
    if (promise(i) > promise(best)) best = i;
  if (best == now_ || !has_stayed(best)) return;
  now_ = best;
  stayed_ = 0.0;
  of_late_ = {};
}

} // namespace plyform
