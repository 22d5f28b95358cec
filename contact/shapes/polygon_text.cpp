// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/shapes/polygon_text.hpp"

#include <charconv>
#include <cmath>
#include <cstdlib>

namespace plyform {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

/// A word as it is shown in messages: short, and printable.
std::string shown(std::string_view word) {
  constexpr std::size_t most = 30;
  std::string text(word.substr(0, most));
  for (char& c : text)
    if (c < ' ' || c > '~') c = '?';
  return word.size() > most ? text + "..." : text;
}

/// A word as a number, infinite or NaN too; nothing if it is none.
std::optional<double> number_of(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc::invalid_argument || end != word.data() + word.size()) return std::nullopt;
  if (error == std::errc::result_out_of_range) // too large, or too small and then next to 0
    value = std::strtod(std::string(word).c_str(), nullptr);
  return value;
}

} // namespace

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

bool WordReader::skip_blanks(bool over_lines) {
  for (; at_ < text_.size(); ++at_) {
    if (comment_ != 0 && text_[at_] == comment_) {
      at_ = std::min(text_.find('\n', at_), text_.size());
      if (at_ == text_.size()) return false;
    }
    if (text_[at_] == '\n') {
      if (!over_lines) return false;
      ++line_;
    } else if (!is_blank(text_[at_])) {
      return true;
    }
  }
  return false;
}

std::string_view WordReader::word() {
  return skip_blanks(true) ? word_of_line() : std::string_view();
}

std::string_view WordReader::word_of_line() {
  if (!skip_blanks(false)) return {};
  const std::size_t from = at_;
  while (at_ < text_.size() && text_[at_] != '\n' && !is_blank(text_[at_]) &&
         !(comment_ != 0 && text_[at_] == comment_))
    ++at_;
  return text_.substr(from, at_ - from);
}

void WordReader::skip_line() {
  at_ = std::min(text_.find('\n', at_), text_.size());
}

void WordReader::fail(const std::string& what) const {
  throw std::runtime_error(fmt::format("line {}: {}", line_, what));
}

double WordReader::coordinate(std::string_view word) const {
  if (word.empty()) fail("a coordinate is missing, the file is truncated; export or copy it again");
  const std::optional<double> value = number_of(word);
  if (!value) fail(fmt::format("'{}' is not a number; export the mesh again", shown(word)));
  if (!std::isfinite(*value)) fail(not_finite);
  return *value;
}

std::int64_t WordReader::integer(std::string_view word, const char* what) const {
  if (word.empty())
    fail(fmt::format("{} is missing, the file is truncated; export or copy it again", what));
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size())
    fail(fmt::format("{} is '{}', not a whole number; export the mesh again", what, shown(word)));
  return value;
}

std::size_t WordReader::point_number(std::string_view word, std::size_t points) const {
  const std::int64_t number = integer(word, "the number of a point");
  if (number < 0 || static_cast<std::uint64_t>(number) >= points)
    fail(fmt::format("a face names point {}, but there are only {}, from 0; export the mesh again",
                     number, points));
  return static_cast<std::size_t>(number);
}

std::size_t WordReader::count(std::string_view word, const char* what, std::size_t bytes) const {
  const std::int64_t number = integer(word, what);
  if (number < 0 || static_cast<std::uint64_t>(number) > (text_.size() - at_) / bytes + 1)
    fail(fmt::format("{} is {}, more than the rest of the file can hold: it is truncated, or the "
                     "number wrong; export or copy it again",
                     what, number));
  return static_cast<std::size_t>(number);
}

void WordReader::expect_end(const std::string& counted) {
  if (const std::string_view more = word(); !more.empty())
    fail(fmt::format("'{}' stands after {}; correct the count, or export the mesh again",
                     shown(more), counted));
}

} // namespace plyform
