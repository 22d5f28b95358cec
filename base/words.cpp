// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/words.hpp"

#include "base/format.hpp"

#include <charconv>
#include <cstdint>
#include <limits>

namespace plyform {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Whether the magnitude of a decimal number that no double can hold is above 1, not below.
bool is_large(std::string_view number) {
  constexpr std::int64_t most = 1'000'000'000; // no file has as many digits
  std::int64_t place = 0;                      // of the first digit that is not 0
  bool point = false, begun = false;
  std::size_t i = 0;
  for (; i < number.size() && (is_digit(number[i]) || number[i] == '.' || number[i] == '-'); ++i) {
    if (number[i] == '.') point = true;
    if (!is_digit(number[i])) continue;
    begun = begun || number[i] != '0';
    if (begun && !point) ++place;
    if (!begun && point) --place;
  }
  if (i >= number.size()) return place > 0;
  std::string_view digits = number.substr(i + 1); // of the exponent
  if (digits.starts_with('+')) digits.remove_prefix(1);
  const bool below = digits.starts_with('-');
  if (below) digits.remove_prefix(1);
  std::int64_t exponent = 0;
  for (const char c : digits)
    if (exponent < most) exponent = 10 * exponent + (c - '0');
  return place + (below ? -exponent : exponent) > 0;
}

/// A character of UTF-8: how many bytes it has, 0 if they are none.
struct Character {
  std::size_t bytes = 0;
  char32_t code = 0;
};

Character character_at(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) -> std::uint32_t {
    return at + i < text.size() ? static_cast<unsigned char>(text[at + i]) : 0;
  };
  const std::uint32_t first = byte(0);
  if (first < 0x80) return {1, first};
  const std::size_t bytes = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4) return {};
  char32_t code = first & (0x7FU >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return {};
    code = code << 6U | (byte(i) & 0x3FU);
  }
  const char32_t least = bytes == 4 ? 0x10000 : bytes == 3 ? 0x800 : 0x80;
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  return code < least || surrogate || code > 0x10FFFF ? Character{} : Character{bytes, code};
}

/// Characters that change what stands around them, or are not seen.
bool is_unseen(char32_t code) {
  const auto within = [code](char32_t first, char32_t last) {
    return code >= first && code <= last;
  };
  return code < 0x20 || within(0x7F, 0x9F) || code == 0xAD || code == 0x61C || code == 0x180E ||
         within(0x200B, 0x200F) || within(0x2028, 0x202E) || within(0x2060, 0x206F) ||
         code == 0xFEFF || within(0xFFF9, 0xFFFB) || within(0xE0000, 0xE0FFF) ||
         (code & 0xFFFEU) == 0xFFFEU;
}

std::string escaped(char32_t code) {
  if (code == '\n') return "\\n";
  if (code == '\t') return "\\t";
  if (code == '\r') return "\\r";
  const auto number = static_cast<std::uint32_t>(code);
  return number < 0x80 ? fmt::format("\\x{:02x}", number) : fmt::format("\\u{{{:x}}}", number);
}

/// Appends the character at `at` as it is shown; returns how many bytes it has.
std::size_t append_shown(std::string_view text, std::size_t at, std::string_view kept,
                         std::string& out) {
  const Character c = character_at(text, at);
  if (c.bytes == 0) {
    out += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[at]));
    return 1;
  }
  if (is_unseen(c.code) && (c.bytes > 1 || kept.find(text[at]) == std::string_view::npos))
    out += escaped(c.code);
  else
    out += text.substr(at, c.bytes);
  return c.bytes;
}

} // namespace

std::optional<double> number_in(std::string_view word) {
  if (word.starts_with('+')) {
    word.remove_prefix(1);
    if (word.starts_with('-')) return std::nullopt;
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc::invalid_argument || end != word.data() + word.size()) return std::nullopt;
  if (error != std::errc::result_out_of_range) return value;
  const double size = is_large(word) ? std::numeric_limits<double>::infinity() : 0.0;
  return word.starts_with('-') ? -size : size;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

std::string printable(std::string_view text, std::string_view kept) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t at = 0; at < text.size();)
    at += append_shown(text, at, kept, out);
  return out;
}

std::string shown(std::string_view text, std::size_t most) {
  std::string out;
  std::size_t at = 0;
  for (std::size_t count = 0; at < text.size() && count < most; ++count)
    at += append_shown(text, at, {}, out);
  return at < text.size() ? out + "..." : out;
}

} // namespace plyform
