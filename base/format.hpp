// SPDX-License-Identifier: GPL-3.0-or-later
// The one printer of text with numbers: within plyform fmt::format and fmt::print are these, whose
// numbers with a point are finite or words. "nan" and "inf" say nothing to a user, and a number
// that is none must not look like one. Files that are read again are written by fmt::format_to,
// which leaves numbers as they are.
#pragma once

#include <cmath>
#include <concepts>
#include <cstdio>
#include <fmt/format.h>
#include <string>
#include <type_traits>
#include <utility>

namespace plyform {

/// A number in a text: by its format where it is finite, else in words.
struct ToldNumber {
  double value;
  /// "unknown" for NaN, "endless" and "minus endless" for infinity.
  const char* word() const {
    if (std::isnan(value)) return "unknown";
    return value > 0.0 ? "endless" : "minus endless";
  }
};

} // namespace plyform

template <>
struct fmt::formatter<plyform::ToldNumber> {
  constexpr auto parse(format_parse_context& context) {
    return std::is_constant_evaluated() ? number.parse(context) : parse_then(context);
  }
  format_context::iterator format(plyform::ToldNumber told, format_context& context) const;

private:
  format_parse_context::iterator parse_then(format_parse_context& context);
  formatter<double> number;
};

namespace plyform::fmt {

using namespace ::fmt;

/// What stands in a text for an argument.
template <class T>
using Told = std::conditional_t<std::floating_point<std::remove_cvref_t<T>>, ToldNumber,
                                std::remove_cvref_t<T>>;

template <class T>
decltype(auto) told(const T& value) {
  static_assert(!std::same_as<T, float>, "its shortest text is another one as a double's");
  if constexpr (std::floating_point<T>)
    return ToldNumber{static_cast<double>(value)};
  else
    return (value); // itself, not a copy
}

/// The format of a text for these arguments.
template <class... T>
using TextOf = ::fmt::format_string<Told<T>...>;

template <class... T>
std::string format(TextOf<T...> text, const T&... values) {
  return ::fmt::vformat(text, ::fmt::make_format_args(told(values)...));
}

template <class... T>
void print(std::FILE* file, TextOf<T...> text, const T&... values) {
  ::fmt::vprint(file, text, ::fmt::make_format_args(told(values)...));
}

template <class... T>
void print(TextOf<T...> text, const T&... values) {
  ::fmt::vprint(stdout, text, ::fmt::make_format_args(told(values)...));
}

} // namespace plyform::fmt
