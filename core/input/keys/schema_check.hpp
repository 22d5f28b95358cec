// SPDX-License-Identifier: GPL-3.0-or-later
// Checks the entries of a file against the table of keys, and returns valid values.
#pragma once

#include "base/geometry.hpp"
#include "core/input/keys/schema.hpp"
#include "core/input/keys/toml_tree.hpp"

#include <limits>
#include <string>
#include <vector>

namespace plyform {

/// A table of the file with its pattern (tool[]) and dotted path (tool.1). `entry` is null if the
/// table is missing or invalid: no key counts as given then.
struct TableView {
  TomlNode* entry;
  std::string pattern, item;
};

/// Reports unknown and missing keys, keys of another choice, wrong types and numbers out of range,
/// in the section and all below it; marks wrong entries as invalid (TomlNode::valid); and inserts
/// the defaults of keys that are not given.
void check_section(const TableView& section, Diagnostics& diagnostics);

/// Reports a key of the section that the table does not have, and suggests the nearest one, or
/// lists all.
void report_unknown_key(const TableView& section, const Place& at, const std::string& key,
                        const std::string& value, Diagnostics& diagnostics);

/// Dotted path of a key of the section: "tool.1.radius".
std::string item_of(const TableView& section, const std::string& key);

/// The value of a key, or null if it is not given or invalid.
const TomlNode* given(const TableView& section, const std::string& key);

TableView subsection(const TableView& section, const std::string& key);
/// The tables of a list of tables or the tables of a map; none of one that is wrong as a whole, as
/// it is no list, or has more than there may be.
std::vector<TableView> subsections(const TableView& section, const std::string& key);

/// Stands for a number that is not given or invalid: comparisons with it fail.
/// Whether nothing in it was found wrong, and nothing in it is missing: whoever compares values of
/// several keys may ask for it.
bool is_sound(const TableView& section);
/// The same of one key; of one that is not there nothing is wrong.
bool is_sound(const TableView& section, const std::string& key);

/// Whether all names of the tables of a list or a map are known, so that a word that is none of
/// them names nothing: there are tables, and none without its name.
bool knows_names(const TableView& section, const std::string& key);

constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

/// Values in the program's units (mm, N, s, t, rad). `not_given` or empty if not given or invalid,
/// so that no second error is reported for the same value.
double number(const TableView& section, const std::string& key);
std::vector<double> numbers(const TableView& section, const std::string& key);
std::vector<Vec2> pairs(const TableView& section, const std::string& key);
std::string text(const TableView& section, const std::string& key);
Vec2 vector2(const TableView& section, const std::string& key);
Vec3 vector3(const TableView& section, const std::string& key);

/// Reports an error in the value of a key.
void value_error(const TableView& section, const std::string& key, const std::string& rule,
                 const std::string& remedy, Diagnostics& diagnostics);
/// The same of one item of a list that is given, as a row of a table.
void row_error(const TableView& section, const std::string& key, std::size_t row,
               const std::string& rule, const std::string& remedy, Diagnostics& diagnostics);

} // namespace plyform
