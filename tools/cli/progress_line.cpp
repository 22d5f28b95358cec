// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/cli/progress_line.hpp"

#include "base/format.hpp"

#include <algorithm>
#include <sys/ioctl.h>
#include <unistd.h>

namespace plyform {
namespace {

using Seconds = std::chrono::duration<double>;

constexpr Seconds silent{1.0}, on_terminal{0.2}, of_lines{5.0};

/// Past the stream stderr, which keeps such bytes from terminals. What is not taken is dropped.
void write_now(const std::string& text) {
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text.data(), text.size());
}

std::size_t columns() {
  winsize size{};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
  return known ? size.ws_col - 1U : 79U;
}

std::string clock_text(double seconds) {
  if (seconds < 99.5) return fmt::format("{:.0f} s", seconds);
  return seconds < 5970.0 ? fmt::format("{:.0f} min", seconds / 60.0)
                          : fmt::format("{:.1f} h", seconds / 3600.0);
}

} // namespace

ProgressLine::ProgressLine() : terminal_(isatty(STDERR_FILENO) != 0) {
  end();
}

void ProgressLine::show(std::string_view words, std::optional<double> fraction) {
  const double passed = Seconds(Clock::now() - begin_).count();
  if (fraction) left_.show(passed, *fraction);
  if (!is_due()) return;
  if (!fraction) return draw(fmt::format("{}, {}", words, clock_text(passed)));
  std::string text = fmt::format("{}, {:.0f} %", words, 100.0 * *fraction);
  if (const auto left = left_.left(passed))
    text += fmt::format(", about {} left", clock_text(*left));
  draw(text);
}

void ProgressLine::show(const Progress& p, std::string_view words) {
  if (!is_due()) return;
  const std::string left =
      p.remaining_s > 0.0 ? fmt::format(", {} left", clock_text(p.remaining_s)) : "";
  draw(fmt::format("{}{}{:3.0f} %{}, stroke {:.2f} mm, step {}, kinetic/shear {:.3f}, balance "
                   "{:+.1e}",
                   words, words.empty() ? "" : ": ", 100.0 * p.fraction, left, p.stroke_mm, p.step,
                   p.kinetic_over_shear, p.balance_error));
}

void ProgressLine::end() {
  if (drawn_ && terminal_) write_now("\r\033[K");
  drawn_ = false;
  begin_ = Clock::now();
  left_ = {};
  next_ = begin_ + std::chrono::duration_cast<Clock::duration>(terminal_ ? silent : of_lines);
}

bool ProgressLine::is_due() {
  const auto now = Clock::now();
  if (now < next_) return false;
  next_ = now + std::chrono::duration_cast<Clock::duration>(terminal_ ? on_terminal : of_lines);
  return true;
}

void ProgressLine::draw(std::string text) {
  drawn_ = true;
  if (terminal_)
    text = fmt::format("\r{}\033[K", text.substr(0, std::min(text.size(), columns())));
  else
    text += '\n';
  write_now(text);
}

} // namespace plyform
