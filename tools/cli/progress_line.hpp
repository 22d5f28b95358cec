// SPDX-License-Identifier: GPL-3.0-or-later
// Progress of a run on standard error.
#pragma once

#include "core/run/run.hpp"

#include <chrono>
#include <fmt/format.h>
#include <string>
#include <unistd.h>

namespace plyform {

/// Progress display: on a terminal one line that is overwritten, elsewhere a new line every few
/// seconds.
class ProgressLine {
public:
  void show(const Progress& p) {
    const auto now = std::chrono::steady_clock::now();
    const double since = std::chrono::duration<double>(now - last_).count();
    if (since < (terminal_ ? 0.2 : 5.0)) return;
    last_ = now;
    draw(fmt::format(
        "{}{:3.0f} %  stroke {:7.2f} mm  step {:8}  {:4.0f} s left  kinetic/shear {:.3f}  "
        "balance {:+.2e}{}",
        terminal_ ? "\r" : "", 100.0 * p.fraction, p.stroke_mm, p.step, p.remaining_s,
        p.kinetic_over_shear, p.balance_error, terminal_ ? "\033[K" : "\n"));
    drawn_ = terminal_;
  }
  void end() {
    if (drawn_) draw("\n");
  }

private:
  /// Past the stream stderr, which keeps such bytes from terminals. What is not taken is dropped.
  static void draw(const std::string& text) {
    [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text.data(), text.size());
  }

  bool terminal_ = isatty(STDERR_FILENO) != 0;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point last_{};
};

} // namespace plyform
