// SPDX-License-Identifier: GPL-3.0-or-later
// What stands in a TOML file, with the place of every value: the parser's types end here, so that
// the rest of the reader knows nothing of them.
#pragma once

#include "core/base/diagnostics.hpp"

#include <optional>
#include <string>
#include <vector>

namespace plyform {

/// A value and, for tables and lists, what is in it.
struct TomlNode {
  enum class Kind { table, list, string, integer, number, boolean, date };
  Kind kind = Kind::table;
  Place at;                       ///< of the value; of the header for [tables]
  Place key_at;                   ///< of its key; the same as `at` in a list
  std::string key;                ///< in its table; empty in a list
  std::string source_text;        ///< as it stands in the file, shortened
  std::string text;               ///< of a string
  double number = 0.0;            ///< of an integer or number
  std::vector<TomlNode> children; ///< of a table in the order of the file, of a list
  bool valid = true;              ///< false once a mistake in it has been reported

  TomlNode* find(const std::string& name);
  const TomlNode* find(const std::string& name) const;
  bool is_number() const { return kind == Kind::integer || kind == Kind::number; }
};

/// The file name of errors in overrides.
inline constexpr const char* override_file = "--set";

/// Parses TOML text; a syntax error is reported with its place in `name` and answered with nothing.
std::optional<TomlNode> parse_entries(const std::string& text, const std::string& name,
                                      Diagnostics& diagnostics);

/// One value as TOML, without its key. Nothing if it is no TOML value; `reason` then says why.
/// `column` (from 1) is where it starts in the text the places shall refer to.
std::optional<TomlNode> parse_value(const std::string& text, const std::string& name, int column,
                                    std::string& reason);

} // namespace plyform
