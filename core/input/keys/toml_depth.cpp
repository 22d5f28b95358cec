// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/keys/toml_depth.hpp"

#include <algorithm>
#include <string>

namespace plyform {
namespace {

/// The end of the string that begins at `at`, behind its closing quotes.
std::size_t end_of_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const std::string three(3, quote);
  const bool long_one = text.substr(at, 3) == three;
  const std::string_view close = long_one ? std::string_view(three) : text.substr(at, 1);
  for (std::size_t i = at + close.size(); i < text.size(); ++i) {
    if (quote == '"' && text[i] == '\\') {
      ++i;
    } else if (text.substr(i, close.size()) == close) {
      std::size_t end = i + close.size();
      while (long_one && end < std::min(i + 5, text.size()) && text[end] == quote)
        ++end; // one or two quotes before the closing ones are of the string
      return end;
    } else if (!long_one && text[i] == '\n') {
      return i; // is not closed: the parser says so
    }
  }
  return text.size();
}

TomlPlace place_at(std::string_view text, std::size_t at) {
  const std::string_view before = text.substr(0, at);
  const std::size_t begin = before.rfind('\n') + 1; // npos + 1 = 0
  const auto columns =
      std::count_if(before.begin() + static_cast<std::ptrdiff_t>(begin), before.end(),
                    [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; });
  return {static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1,
          static_cast<int>(columns) + 1};
}

} // namespace

std::optional<TomlPlace> nested_too_deep(std::string_view text) {
  int brackets = 0, dots = 0; // dots: of this key, or number
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (c == '"' || c == '\'') {
      at = end_of_string(text, at);
      continue;
    }
    if (c == '#') {
      at = std::min(text.find('\n', at), text.size());
      continue;
    }
    if (c == '[' || c == '{') ++brackets;
    if (c == ']' || c == '}') brackets = std::max(brackets - 1, 0);
    if (c == '.')
      ++dots;
    else if (std::string_view("=,[]{}\n").find(c) != std::string_view::npos)
      dots = 0;
    if (brackets > most_nested || dots >= most_nested) return place_at(text, at);
    ++at;
  }
  return std::nullopt;
}

} // namespace plyform
