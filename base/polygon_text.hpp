// SPDX-License-Identifier: GPL-3.0-or-later
// Internal to base: words, numbers and lines of mesh files, and readers of formats.
#pragma once

#include "base/format.hpp"
#include "base/polygon_file.hpp"
#include "base/words.hpp"

#include <cstdint>
#include <optional>
#include <stdexcept>

namespace plyform {

inline constexpr const char* not_finite =
    "a coordinate is not a finite number; export the mesh again";

/// Words of a text, separated by blanks, with the number of their line.
class WordReader {
public:
  /// comment: the character from which the rest of a line is left out, or 0.
  explicit WordReader(std::string_view text, char comment = 0) : text_(text), comment_(comment) {}

  /// The next word, on any line; empty at the end of the text.
  std::string_view word();
  /// The next word of the line that the last word stands on; empty at its end.
  std::string_view word_of_line();
  void skip_line();
  /// Bytes of the text read so far.
  std::size_t position() const { return at_; }

  /// Throws std::runtime_error: "line N: " with the line of the last word, and `what`.
  [[noreturn]] void fail(const std::string& what) const;

  /// A finite number. Throws if the word is none.
  double coordinate(std::string_view word) const;
  /// A whole number. what: it, in the message if the word is none.
  std::int64_t integer(std::string_view word, const char* what) const;
  /// The number of a point below `points`. Throws if the word is none.
  std::size_t point_number(std::string_view word, std::size_t points) const;
  /// A count of things that the rest of the text can hold, at `bytes` each at least. Throws if not.
  std::size_t count(std::string_view word, const char* what, std::size_t bytes = 2) const;
  /// Throws if anything but blanks and comments is left. counted: "the 12 faces that ..."
  void expect_end(const std::string& counted);

private:
  bool skip_blanks(bool over_lines); ///< whether a word follows
  std::string_view text_;
  char comment_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
};

PolygonSoup parse_stl(std::string_view bytes);
PolygonSoup parse_obj(std::string_view bytes);
PolygonSoup parse_off(std::string_view bytes);
/// polygon_ply.cpp
PolygonSoup parse_ply(std::string_view bytes);

} // namespace plyform
