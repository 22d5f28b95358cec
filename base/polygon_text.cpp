// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/polygon_text.hpp"

#include <charconv>
#include <cmath>

namespace plyform {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

} // namespace

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
  const std::optional<double> value = number_in(word);
  if (!value) fail(fmt::format("'{}' is not a number; export the mesh again", shown(word, 30)));
  if (!std::isfinite(*value)) fail(not_finite);
  return *value;
}

std::int64_t WordReader::integer(std::string_view word, const char* what) const {
  if (word.empty())
    fail(fmt::format("{} is missing, the file is truncated; export or copy it again", what));
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size())
    fail(fmt::format("{} is '{}', not a whole number; export the mesh again", what,
                     shown(word, 30)));
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
                     shown(more, 30), counted));
}

} // namespace plyform
