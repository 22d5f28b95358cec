// SPDX-License-Identifier: GPL-3.0-or-later
// How deep tables and lists of a TOML text are nested, before the parser, which goes down into them
// by recursion, sees it.
#pragma once

#include <optional>
#include <string_view>

namespace plyform {

/// Parts of a dotted key, and brackets within each other, that are read at most. Keys of a case
/// have five parts, its lists three levels.
constexpr int most_nested = 16;

struct TomlPlace {
  int line = 1, column = 1; ///< from 1; columns in characters
};

/// Where a text is nested deeper than most_nested; nothing if it is not. Strings and comments do
/// not count.
std::optional<TomlPlace> nested_too_deep(std::string_view text);

} // namespace plyform
