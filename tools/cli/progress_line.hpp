// SPDX-License-Identifier: GPL-3.0-or-later
// What long work does and how far it is, on standard error. tools/base/progress.py is the same for
// Python programs.
#pragma once

#include "base/time_left.hpp"
#include "core/run/run.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace plyform {

/// On a terminal one line that is drawn over itself and wiped at the end, elsewhere a whole line
/// every five seconds. Nothing of work under a second.
class ProgressLine {
public:
  ProgressLine();
  ~ProgressLine() { end(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// fraction: of the work done, 0 to 1, if it is known.
  void show(std::string_view words, std::optional<double> fraction = std::nullopt);

  /// Of a run; words: what the run is for, if not for its results.
  void show(const Progress& progress, std::string_view words = {});

  /// Wipes the line. What is shown later is other work.
  void end();

private:
  using Clock = std::chrono::steady_clock;
  bool is_due();
  void draw(std::string text);

  bool terminal_, drawn_ = false;
  Clock::time_point begin_ = Clock::now(), next_;
  TimeLeft left_;
};

} // namespace plyform
