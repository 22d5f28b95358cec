// SPDX-License-Identifier: GPL-3.0-or-later
// How many threads to compute with. Beside other programs several threads can be slower than one: a
// thread that has to let its processor go while it does a task holds up all others.
#pragma once

#include <cstddef>
#include <vector>

namespace plyform {

/// Compares numbers of threads by the seconds that they compute in a second, those left out in
/// which they wait for each other: what they get done, whatever it is. It begins with all threads,
/// and tries half as many only where these could compute more, which on a machine with nothing else
/// to do they never can.
class ThreadChoice {
public:
  /// `most` >= 1
  explicit ThreadChoice(int most);

  /// The number to use until the next call of `count`: the most, a half of it, ..., 1.
  int threads() const { return choices_[now_].threads; }

  /// Counts `wall` seconds > 0, some hundredths, in which that number computed for `computed`
  /// seconds, the sum of all of them.
  void count(double wall, double computed);

private:
  /// Sums that forget.
  struct Seconds {
    double wall = 0.0, computed = 0.0;
    double rate() const { return computed / wall; } ///< seconds computed in a second
    void fade(double after, double memory);         ///< s
    void add(double more_wall, double more_computed);
  };
  struct Choice {
    int threads = 1;
    Seconds seconds;
  };

  double promise(std::size_t choice) const;
  void forget_if_free();
  bool has_stayed(std::size_t next) const;

  std::vector<Choice> choices_; ///< the most threads first
  std::size_t now_ = 0;
  double stayed_ = 0.0; ///< s with this number
  Seconds of_late_;     ///< with this number, the last tenths of a second
};

} // namespace plyform
