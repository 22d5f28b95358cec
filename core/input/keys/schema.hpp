// SPDX-License-Identifier: GPL-3.0-or-later
// The one table of all keys of case and fabric files. The reader checks files against it and
// `plyform keys` prints it, so that the two cannot disagree.
//
// Key patterns: NAME stands for a user-defined name, [] for an item of a list:
// blanks.NAME.size, tool[].radius. Fabric files have the keys below fabrics.NAME.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <typeindex>
#include <vector>

namespace plyform {

enum class KeyKind {
  table,  ///< [key]
  tables, ///< [[key]]
  map,    ///< [key.NAME]
  fabric, ///< path of a fabric file, or its table
  text,   ///< any string
  name,   ///< string of letters, digits, _ and -
  path,   ///< string, relative to the file that contains it
  choice, ///< one of `choices`
  number,
  integer,
  boolean,
  numbers,  ///< list of `count` numbers, or of any number of them if count is 0
  pairs,    ///< list of [a, b]
  names,    ///< list of `count` strings
  profile,  ///< list of [a, b], [a, b, fillet] and tables, which are arcs
  outlines, ///< list of such lists, or of tables, which are circles
};

/// Range of allowed numbers; the ends belong to it unless open.
struct Range {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool open_least = false, open_most = false;
  bool holds(double x) const;
  std::string text() const; ///< "> 0", "[0, 1]", empty when unbounded
  std::string rule() const; ///< "must be greater than 0"
  std::string span() const; ///< "0 to 1"; of a range with two ends
};

struct KeyRow;
struct TomlNode;

/// The member that a key's value is assigned to when its table is read into a struct
/// (key_member.hpp).
struct KeyMember {
  std::type_index of; ///< the struct
  /// node: the value; null if it is missing or invalid, which has been reported.
  std::function<void(void* object, const KeyRow& row, const TomlNode* node)> set;
};

/// A key. It is required unless it has a fallback, an `otherwise` or an alternative key `instead`.
struct KeyRow {
  std::string key; ///< pattern
  KeyKind kind = KeyKind::number;
  std::string unit = "-"; ///< of each column: "deg, N mm"
  std::string fallback{}; ///< TOML value taken when the key is not given
  /// Another default in a table that has one of these keys: the keys, then the value.
  std::vector<std::string> implied_by{};
  std::string implied{};
  std::string otherwise{}; ///< default in words, if it is not a value
  /// Alternative keys, of which each names all others: two must not be given, and one must be
  /// unless they have an `otherwise`.
  std::vector<std::string> instead{};
  std::vector<Range> ranges{}; ///< per column; the last one applies to all further columns
  std::vector<Range> usual{};  ///< the same of numbers as they are used; others get a warning
  /// For KeyKind::choice; beside `refers`: words that stand for several of the items.
  std::vector<std::string> choices{};
  /// Patterns of the tables or lists of whose items the value (or each of `names`) is a name:
  /// "blanks", "ply", "fabrics.NAME.family".
  std::vector<std::string> refers{};
  std::size_t count = 0;            ///< number of items of numbers and names; 0 = any
  std::size_t least_items = 0;      ///< smallest number of items of lists of any length
  std::size_t most_items = 0;       ///< largest number of them; 0: as many as usual for its kind
  std::string of{};                 ///< choice key of the same table that this key depends on
  std::vector<std::string> with{};  ///< values of that choice key for which this key is allowed
  std::string meaning{};            ///< noun phrase, completes "give the ..."
  std::vector<KeyMember> members{}; ///< members that it fills, of different structs

  bool required() const { return fallback.empty() && otherwise.empty() && instead.empty(); }
  const Range& range_of(std::size_t column) const;
  const Range& usual_of(std::size_t column) const;
  bool goes_with(const std::string& choice) const;
};

const std::vector<KeyRow>& key_table();

/// The row of a pattern, or null.
const KeyRow* find_key(const std::string& pattern);

/// The rows one level below a pattern ("" for the top of the case file).
std::vector<const KeyRow*> keys_below(const std::string& pattern);

/// The pattern of `name` in the table with the given pattern, empty if there is no such key.
std::string pattern_of(const std::string& pattern, const std::string& name);

/// The last part of a pattern: radius for tool[].radius.
std::string last_part(const std::string& pattern);

/// The unit of a column: "N/mm2" of the second one of "mm, N/mm2".
std::string unit_of_column(const KeyRow& row, std::size_t column);

/// Factor from the unit of a column to the program's units (mm, N, s, t, rad): 1e-12 for g/m2.
double unit_factor(const KeyRow& row, std::size_t column);

} // namespace plyform
