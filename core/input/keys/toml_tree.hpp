// SPDX-License-Identifier: GPL-3.0-or-later
// The entries of a TOML file with the position of every value. Types of the parser (toml++) are
// used in toml_tree.cpp only.
#pragma once

#include "base/diagnostics.hpp"

#include <optional>
#include <string>
#include <vector>

namespace plyform {

/// A value and, for tables and lists, its entries.
struct TomlNode {
  enum class Kind { table, list, string, integer, number, boolean, date };
  Kind kind = Kind::table;
  Place at;                       ///< of the value; of the header for [tables]
  Place key_at;                   ///< of its key; the same as `at` in a list
  std::string key;                ///< in its table; empty in a list
  std::string source_text;        ///< as written in the file, shortened
  std::string text;               ///< of a string
  double number = 0.0;            ///< of an integer or number
  std::vector<TomlNode> children; ///< of a table in the order of the file, of a list
  bool valid = true;              ///< false once an error in it has been reported

  TomlNode* find(const std::string& name);
  const TomlNode* find(const std::string& name) const;
  bool is_number() const { return kind == Kind::integer || kind == Kind::number; }
};

/// Whether a step of a key into a list is taken for a number: digits only.
bool is_number_of_item(const std::string& step);

/// Where the item is in a list that a step of a key names: by number from 0, or by the `name` that
/// one item alone has.
std::optional<std::size_t> place_in_list(const TomlNode& list, const std::string& step);

/// "its items are numbered from 0 to 1: die, punch", for those who asked for another.
std::string items_remedy(const TomlNode& list);

/// File name in errors of overrides.
inline constexpr const char* override_file = "--set";

/// Parses TOML text; reports a syntax error with its position in `name` and returns nothing then.
std::optional<TomlNode> parse_entries(const std::string& text, const std::string& name,
                                      Diagnostics& diagnostics);

/// Parses one value as TOML, without its key. If it is not a TOML value, returns nothing and sets
/// `reason`. column: of its first character (from 1) in the text that positions refer to.
std::optional<TomlNode> parse_value(const std::string& text, const std::string& name, int column,
                                    std::string& reason);

} // namespace plyform
