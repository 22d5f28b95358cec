// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/keys/schema_check.hpp"

#include "base/format.hpp"
#include "base/names.hpp"
#include "base/text.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {

namespace {

using Kind = TomlNode::Kind;

/// "give the radius, in mm": the first part of the meaning, without explanations.
std::string give(const KeyRow& row) {
  const std::string meaning = row.meaning.substr(0, row.meaning.find(';'));
  return "give the " + meaning + (row.unit == "-" ? "" : ", in " + row.unit);
}

/// Context of the check of a value.
struct Check {
  const KeyRow& row;
  Diagnostics& diagnostics;
  /// Reports an error and marks the value as invalid. Returns false, for the caller to return.
  bool fail(TomlNode& value, const std::string& item, const std::string& rule) const {
    diagnostics.error(value.at, item, value.source_text, rule, give(row));
    return value.valid = false;
  }
};

/// Warns of an angle that is 15, 30, 45 ... degrees if it is taken for rad.
void warn_of_radians(const Check& check, const TomlNode& value, const std::string& item) {
  constexpr double round = 15.0;                  // degrees
  constexpr double rounding = 0.3;                // degrees: of two or three digits that are given
  const double most = check.row.range_of(0).most; // of a direction, not of an error
  const double as_rad = std::abs(value.number) / degree;
  const double nearest = round * std::round(as_rad / round);
  if (check.row.unit != "deg" || check.row.kind != KeyKind::number || most < 90.0) return;
  if (nearest == 0.0 || nearest > 360.0 || std::abs(as_rad - nearest) > rounding) return;
  if (value.number == std::round(value.number)) return;
  check.diagnostics.warning(
      value.at, fmt::format("{} = {}: is in degrees; give {:g} if it is meant in rad", item,
                            value.source_text, std::copysign(nearest, value.number)));
}

/// The unit of a column with a blank before it; empty of plain numbers.
std::string unit_behind(const KeyRow& row, std::size_t column) {
  const std::string unit = unit_of_column(row, column);
  return unit == "-" ? "" : " " + unit;
}

bool check_number(const Check& check, TomlNode& value, const std::string& item,
                  std::size_t column) {
  if (!value.is_number()) return check.fail(value, item, "must be a number");
  if (!std::isfinite(value.number)) return check.fail(value, item, "must be a finite number");
  const Range& range = check.row.range_of(column);
  if (!range.holds(value.number)) return check.fail(value, item, range.rule());
  if (const Range& usual = check.row.usual_of(column); !usual.holds(value.number))
    check.diagnostics.warning(
        value.at, fmt::format("{} = {}: is unusual, usually {}{}; check number and unit", item,
                              value.source_text, usual.span(), unit_behind(check.row, column)));
  warn_of_radians(check, value, item);
  return true;
}

/// Whether a list or a map has no more items than can be worked with.
bool check_most(const Check& check, TomlNode& value, const std::string& item) {
  constexpr std::size_t tables = 1000, points = 20'000, numbers = 100'000;
  const KeyKind kind = check.row.kind;
  const std::size_t usual = kind == KeyKind::tables || kind == KeyKind::map         ? tables
                            : kind == KeyKind::profile || kind == KeyKind::outlines ? points
                                                                                    : numbers;
  const std::size_t most = check.row.most_items ? check.row.most_items : usual;
  return value.children.size() <= most ||
         check.fail(
             value, item,
             fmt::format("has {} items, and may have {} at most", value.children.size(), most));
}

bool check_list(const Check& check, TomlNode& value, const std::string& item, const char* what) {
  if (value.kind != Kind::list)
    return check.fail(value, item, fmt::format("must be a list of {}", what));
  if (value.children.size() < check.row.least_items)
    return check.fail(value, item,
                      fmt::format("must have at least {} item{}, not {}", check.row.least_items,
                                  check.row.least_items == 1 ? "" : "s", value.children.size()));
  return check_most(check, value, item);
}

/// Checks a list of `least` to `most` numbers.
bool check_numbers(const Check& check, TomlNode& value, const std::string& item, std::size_t least,
                   std::size_t most) {
  const std::string wanted =
      least == most ? fmt::format("{}", most) : fmt::format("{} or {}", least, most);
  if (value.kind != Kind::list || value.children.size() < least || value.children.size() > most)
    return check.fail(value, item, fmt::format("must be a list of {} numbers", wanted));
  bool valid = true;
  for (std::size_t i = 0; i < value.children.size(); ++i)
    valid &= check_number(check, value.children[i], fmt::format("{}.{}", item, i), i);
  return value.valid = valid;
}

bool check_any_numbers(const Check& check, TomlNode& value, const std::string& item) {
  if (!check_list(check, value, item, "numbers")) return false;
  bool valid = true;
  for (std::size_t i = 0; i < value.children.size(); ++i)
    valid &= check_number(check, value.children[i], fmt::format("{}.{}", item, i), i);
  return value.valid = valid;
}

/// Leaves the first warning of many about one list, from number `from` on.
void tell_first(std::vector<std::string>& warnings, std::size_t from) {
  if (warnings.size() <= from + 1) return;
  const std::size_t more = warnings.size() - from - 1;
  warnings.resize(from + 1);
  warnings.back() += fmt::format("; so {} {} more of the list", more == 1 ? "is" : "are", more);
}

bool check_pairs(const Check& check, TomlNode& value, const std::string& item) {
  if (!check_list(check, value, item, "pairs of numbers")) return false;
  const std::size_t told = check.diagnostics.warnings.size();
  bool valid = true;
  for (std::size_t i = 0; i < value.children.size(); ++i)
    valid &= check_numbers(check, value.children[i], fmt::format("{}.{}", item, i), 2, 2);
  tell_first(check.diagnostics.warnings, told);
  return value.valid = valid;
}

/// `arcs`: pattern of the tables in the list.
bool check_profile(const Check& check, TomlNode& value, const std::string& item,
                   const std::string& arcs) {
  if (!check_list(check, value, item, "points")) return false;
  bool valid = true;
  for (std::size_t i = 0; i < value.children.size(); ++i) {
    TomlNode& point = value.children[i];
    const std::string path = fmt::format("{}.{}", item, i);
    if (point.kind == Kind::table) {
      check_section({&point, arcs, path}, check.diagnostics);
      for (const TomlNode& part : point.children)
        valid &= part.valid;
      valid &= point.valid;
    } else {
      valid &= check_numbers(check, point, path, 2, 3);
    }
  }
  return value.valid = valid;
}

bool check_outlines(const Check& check, TomlNode& value, const std::string& item) {
  if (value.kind != Kind::list)
    return check.fail(value, item, "must be a list of lists of points, or of circles");
  if (!check_most(check, value, item)) return false;
  bool valid = true;
  for (std::size_t i = 0; i < value.children.size(); ++i) {
    TomlNode& child = value.children[i];
    const std::string path = fmt::format("{}.{}", item, i);
    if (child.kind != Kind::table) {
      valid &= check_profile(check, child, path, check.row.key + "[][]");
      continue;
    }
    check_section({&child, check.row.key + "[]", path}, check.diagnostics);
    for (const TomlNode& part : child.children)
      valid &= part.valid;
    valid &= child.valid;
  }
  return value.valid = valid;
}

bool check_names(const Check& check, TomlNode& value, const std::string& item) {
  if (value.kind != Kind::list || value.children.size() != check.row.count)
    return check.fail(value, item, fmt::format("must be a list of {} names", check.row.count));
  bool valid = true;
  for (std::size_t i = 0; i < value.children.size(); ++i)
    if (value.children[i].kind != Kind::string)
      valid = check.fail(value.children[i], fmt::format("{}.{}", item, i), "must be a string");
  return value.valid = valid;
}

bool check_string(const Check& check, TomlNode& value, const std::string& item) {
  if (value.kind != Kind::string) return check.fail(value, item, "must be a string");
  if (check.row.kind != KeyKind::text && value.text.empty())
    return check.fail(value, item, "must not be empty");
  constexpr const char* allowed =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  if (check.row.kind == KeyKind::name && value.text.find_first_not_of(allowed) != std::string::npos)
    return check.fail(value, item, "may have only letters a to z, digits, _ and -");
  const bool name = check.row.kind == KeyKind::name;
  if (const std::string fault = name ? fault_of_file_name(value.text) : ""; !fault.empty())
    return check.fail(value, item, fault);
  constexpr std::size_t longest = 4096; // bytes: that of a path
  if (value.text.size() > longest)
    return check.fail(
        value, item,
        fmt::format("must not be longer than {} bytes, and has {}", longest, value.text.size()));
  const std::vector<std::string>& choices = check.row.choices;
  if (check.row.kind == KeyKind::choice &&
      std::find(choices.begin(), choices.end(), value.text) == choices.end())
    return check.fail(value, item, "must be one of " + joined(choices));
  return true;
}

bool check_tables(const Check& check, TomlNode& value, const std::string& item) {
  const std::string header = last_part(check.row.key);
  const auto is_table = [](const TomlNode& entry) { return entry.kind == Kind::table; };
  if (value.kind != Kind::list ||
      !std::all_of(value.children.begin(), value.children.end(), is_table))
    return check.fail(value, item,
                      fmt::format("must be a list of tables, each under [[{}]]", item));
  if (!check_list(check, value, item, "tables")) return false;
  for (std::size_t i = 0; i < value.children.size(); ++i)
    check_section({&value.children[i], check.row.key + "[]", fmt::format("{}.{}", item, i)},
                  check.diagnostics);
  return true;
}

bool check_table(const Check& check, TomlNode& value, const std::string& item) {
  const bool path = check.row.kind == KeyKind::fabric;
  if (value.kind != Kind::table)
    return check.fail(value, item, path ? "must be a path or a table" : "must be a table");
  check_section({&value, check.row.key, item}, check.diagnostics);
  return true;
}

bool check_value(const Check& check, TomlNode& value, const std::string& item) {
  if (!value.valid) return false; // has been reported: a fabric file that cannot be read
  switch (check.row.kind) {
  case KeyKind::table:
  case KeyKind::map:
  case KeyKind::fabric:
    return check_table(check, value, item);
  case KeyKind::tables:
    return check_tables(check, value, item);
  case KeyKind::text:
  case KeyKind::name:
  case KeyKind::path:
  case KeyKind::choice:
    return check_string(check, value, item);
  case KeyKind::integer:
    if (value.kind == Kind::number) return check.fail(value, item, "must be a whole number");
    return check_number(check, value, item, 0);
  case KeyKind::boolean:
    return value.kind == Kind::boolean || check.fail(value, item, "must be true or false");
  case KeyKind::number:
    return check_number(check, value, item, 0);
  case KeyKind::numbers:
    if (check.row.count == 0) return check_any_numbers(check, value, item);
    return check_numbers(check, value, item, check.row.count, check.row.count);
  case KeyKind::pairs:
    return check_pairs(check, value, item);
  case KeyKind::outlines:
    return check_outlines(check, value, item);
  case KeyKind::names:
    return check_names(check, value, item);
  case KeyKind::profile:
    return check_profile(check, value, item, check.row.key + "[]");
  }
  return true;
}

void report_other_choice(const TableView& section, const KeyRow& row, TomlNode& value,
                         const std::string& choice, Diagnostics& diagnostics) {
  std::vector<std::string> keys;
  for (const KeyRow* other : keys_below(section.pattern))
    if (other->of == row.of && other->goes_with(choice)) keys.push_back(last_part(other->key));
  diagnostics.error(value.key_at, item_of(section, value.key), value.source_text,
                    fmt::format("{} is no key of {} {}", value.key, row.of, choice),
                    keys.empty() ? fmt::format("take it out, or choose a {} that has it: {}",
                                               row.of, joined(row.with))
                                 : fmt::format("it has {}", joined(keys)));
  value.valid = false;
}

void add_default(TomlNode& table, const KeyRow& row) {
  std::string reason;
  const bool implied = std::any_of(row.implied_by.begin(), row.implied_by.end(),
                                   [&](const std::string& key) { return table.find(key); });
  std::optional<TomlNode> value =
      parse_value(implied ? row.implied : row.fallback, table.at.file, 1, reason);
  value->key = last_part(row.key);
  value->at = value->key_at = table.at;
  table.children.push_back(std::move(*value));
}

/// The first of the alternative keys (KeyRow::instead) that the table has, before the row in the
/// table of keys or anywhere; empty if there is none.
std::string alternative_given(const TomlNode& table, const KeyRow& row, bool only_before) {
  const std::string above = row.key.substr(0, row.key.size() - last_part(row.key).size());
  for (const std::string& other : row.instead)
    if (table.find(other) && (!only_before || find_key(above + other) < &row)) return other;
  return "";
}

/// Whether none of the row's alternatives comes before it in the table of keys.
bool is_first_alternative(const KeyRow& row) {
  const std::string above = row.key.substr(0, row.key.size() - last_part(row.key).size());
  return !row.instead.empty() &&
         std::all_of(row.instead.begin(), row.instead.end(),
                     [&](const std::string& other) { return find_key(above + other) > &row; });
}

/// Checks the value of one key of the table, or that it is missing.
void check_row(const TableView& section, const KeyRow& row, Diagnostics& diagnostics) {
  const std::string key = last_part(row.key);
  TomlNode& table = *section.entry;
  bool applies = true;
  if (!row.of.empty()) {
    const TomlNode* choice = given(section, row.of);
    applies = choice && row.goes_with(choice->text);
    if (TomlNode* value = table.find(key); value && choice && !applies)
      return report_other_choice(section, row, *value, choice->text, diagnostics);
  }
  if (applies && !row.fallback.empty() && !table.find(key)) add_default(table, row);
  const std::string item = item_of(section, key);
  // Of alternative keys, the row that comes first in the table reports that all are missing, later
  // ones that one before is given too, so that no error is reported twice.
  if (TomlNode* value = table.find(key)) {
    check_value({row, diagnostics}, *value, item);
    if (const std::string other = alternative_given(table, row, true); !other.empty())
      diagnostics.error(value->key_at, item, value->source_text,
                        fmt::format("cannot stand beside {}", other), "take one of the two out");
  } else if (applies && (row.required() || (is_first_alternative(row) && row.otherwise.empty() &&
                                            alternative_given(table, row, false).empty()))) {
    const std::string above = row.key.substr(0, row.key.size() - key.size());
    const TomlNode* choice = row.of.empty() ? nullptr : given(section, row.of);
    std::string others;
    for (const std::string& other : row.instead)
      if (!choice || find_key(above + other)->goes_with(choice->text)) others += ", or " + other;
    diagnostics.error(table.at, item, "", "is missing", give(row) + others);
    table.valid = false;
  }
}

} // namespace

void report_unknown_key(const TableView& section, const Place& at, const std::string& key,
                        const std::string& value, Diagnostics& diagnostics) {
  std::vector<std::string> known; // keys of this section, without those of other choices
  for (const KeyRow* row : keys_below(section.pattern)) {
    const TomlNode* choice = row->of.empty() ? nullptr : given(section, row->of);
    if (!choice || row->goes_with(choice->text)) known.push_back(last_part(row->key));
  }
  const std::string nearest = nearest_word(key, known);
  const std::string place = section.pattern.empty() ? "the case" : section.pattern;
  diagnostics.error(
      at, item_of(section, key), value, fmt::format("unknown key, {} has no {}", place, key),
      nearest.empty() ? "it has " + joined(known) : fmt::format("did you mean {}?", nearest));
}

void check_section(const TableView& section, Diagnostics& diagnostics) {
  TomlNode& table = *section.entry;
  const KeyRow* own = find_key(section.pattern);
  if (own && own->kind == KeyKind::map) { // every key is a user-defined name
    if (!check_most({*own, diagnostics}, table, section.item)) return;
    for (TomlNode& child : table.children)
      if (const std::string fault = fault_of_name(child.key); fault.empty())
        check_value({*find_key(section.pattern + ".NAME"), diagnostics}, child,
                    item_of(section, child.key));
      else
        diagnostics.error(child.key_at, item_of(section, child.key), "", "its name " + fault,
                          "choose another name");
    return;
  }
  const std::vector<const KeyRow*> rows = keys_below(section.pattern);
  for (const KeyRow* row : rows) // choice keys first, as others depend on them
    if (row->of.empty()) check_row(section, *row, diagnostics);
  for (const KeyRow* row : rows)
    if (!row->of.empty()) check_row(section, *row, diagnostics);
  for (const TomlNode& child : table.children)
    if (pattern_of(section.pattern, child.key).empty())
      report_unknown_key(section, child.key_at, child.key, child.source_text, diagnostics);
}

std::string item_of(const TableView& section, const std::string& key) {
  return section.item.empty() ? key : section.item + "." + key;
}

} // namespace plyform
