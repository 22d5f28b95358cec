// SPDX-License-Identifier: GPL-3.0-or-later
// The table of keys in words, for people, and in parts, for forms.
#include "core/input/keys/case_keys.hpp"

#include "base/format.hpp"
#include "base/text.hpp"
#include "core/input/keys/schema.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace plyform {
namespace {

std::string type_text(const KeyRow& row) {
  switch (row.kind) {
  case KeyKind::table:
    return "table";
  case KeyKind::tables:
    return "list of tables";
  case KeyKind::map:
    return "table of tables";
  case KeyKind::fabric:
    return "string (a path) or table";
  case KeyKind::text:
    return "string";
  case KeyKind::name:
    return "string (letters, digits, _ and -)";
  case KeyKind::path:
    return "string (a path)";
  case KeyKind::choice:
    return "string";
  case KeyKind::number:
    return "number";
  case KeyKind::boolean:
    return "true or false";
  case KeyKind::integer:
    return "integer";
  case KeyKind::numbers:
    return row.count ? fmt::format("list of {} numbers", row.count) : "list of numbers";
  case KeyKind::pairs:
    return "list of [a, b]";
  case KeyKind::outlines:
    return "list of outlines or tables";
  case KeyKind::names:
    return fmt::format("list of {} strings", row.count);
  case KeyKind::profile:
    return "list of [a, b], [a, b, fillet] or tables";
  }
  return "";
}

std::string fallback_text(const KeyRow& row) {
  if (!row.otherwise.empty()) return row.otherwise;
  if (!row.instead.empty()) return "required, or " + joined(row.instead);
  if (!row.fallback.empty()) return row.fallback;
  return row.of.empty() ? "required" : fmt::format("required for {} {}", row.of, joined(row.with));
}

std::string range_text(const KeyRow& row) {
  if (row.kind == KeyKind::choice) return "one of " + joined(row.choices);
  std::vector<std::string> parts;
  for (const Range& range : row.ranges)
    parts.push_back(range.text().empty() ? "any" : range.text());
  for (const Range& range : row.usual)
    parts.push_back("usually " + range.span());
  if (row.least_items) parts.push_back(fmt::format("{} items or more", row.least_items));
  return joined(parts);
}

const char* kind_word(KeyKind kind) {
  switch (kind) {
  case KeyKind::table:
    return "table";
  case KeyKind::tables:
    return "tables";
  case KeyKind::map:
    return "map";
  case KeyKind::fabric:
    return "fabric";
  case KeyKind::text:
    return "text";
  case KeyKind::name:
    return "name";
  case KeyKind::path:
    return "path";
  case KeyKind::choice:
    return "choice";
  case KeyKind::number:
    return "number";
  case KeyKind::integer:
    return "integer";
  case KeyKind::boolean:
    return "boolean";
  case KeyKind::numbers:
    return "numbers";
  case KeyKind::pairs:
    return "pairs";
  case KeyKind::names:
    return "names";
  case KeyKind::profile:
    return "profile";
  case KeyKind::outlines:
    return "outlines";
  }
  return "";
}

bool has_numbers(KeyKind kind) {
  return kind == KeyKind::number || kind == KeyKind::integer || kind == KeyKind::numbers ||
         kind == KeyKind::pairs || kind == KeyKind::profile || kind == KeyKind::outlines;
}

std::vector<std::string> units_of(const KeyRow& row) {
  const std::string between = ", ";
  std::vector<std::string> units;
  for (std::size_t from = 0; from != std::string::npos;) {
    const std::size_t end = row.unit.find(between, from);
    units.push_back(row.unit.substr(from, end - from));
    from = end == std::string::npos ? end : end + between.size();
  }
  return units;
}

std::vector<KeyColumn> columns_of(const KeyRow& row) {
  std::vector<KeyColumn> columns;
  if (!has_numbers(row.kind)) return columns;
  const std::vector<std::string> units = units_of(row);
  const std::size_t count = std::max({units.size(), row.ranges.size(), row.usual.size()});
  for (std::size_t c = 0; c < count; ++c) {
    const Range &range = row.range_of(c), &usual = row.usual_of(c);
    columns.push_back({units[std::min(c, units.size() - 1)], range.least, range.most,
                       range.open_least, range.open_most, usual.least, usual.most});
  }
  return columns;
}

KeyForm form_of(const KeyRow& row) {
  return {kind_word(row.kind), row.required(), row.fallback, row.otherwise,   row.implied_by,
          row.implied,         row.choices,    row.refers,   columns_of(row), row.count,
          row.least_items,     row.most_items, row.instead,  row.of,          row.with};
}

using Json = nlohmann::ordered_json;

Json bound(double x) {
  return std::isfinite(x) ? Json(x) : Json(nullptr);
}

Json json_of(const KeyColumn& c) {
  return {{"unit", c.unit},
          {"least", bound(c.least)},
          {"most", bound(c.most)},
          {"open_least", c.open_least},
          {"open_most", c.open_most},
          {"usual_least", bound(c.usual_least)},
          {"usual_most", bound(c.usual_most)}};
}

Json json_of(const KeyInfo& k) {
  const KeyForm& f = k.form;
  Json columns = Json::array();
  for (const KeyColumn& column : f.columns)
    columns.push_back(json_of(column));
  return {{"key", k.key},
          {"type", k.type},
          {"unit", k.unit},
          {"default", k.fallback},
          {"range", k.range},
          {"meaning", k.meaning},
          {"kind", f.kind},
          {"required", f.required},
          {"fallback", f.fallback},
          {"otherwise", f.otherwise},
          {"implied_by", f.implied_by},
          {"implied", f.implied},
          {"choices", f.choices},
          {"refers", f.refers},
          {"columns", columns},
          {"count", f.count},
          {"least_items", f.least_items},
          {"most_items", f.most_items},
          {"instead", f.instead},
          {"of", f.of},
          {"of_values", f.of_values}};
}

} // namespace

std::vector<KeyInfo> case_keys() {
  std::vector<KeyInfo> infos;
  for (const KeyRow& row : key_table()) {
    std::string meaning = row.meaning;
    if (!row.of.empty()) meaning += fmt::format(" ({} {})", row.of, joined(row.with));
    infos.push_back({row.key, type_text(row), row.unit, fallback_text(row), range_text(row),
                     meaning, form_of(row)});
  }
  return infos;
}

std::string case_keys_json() {
  Json keys = Json::array();
  for (const KeyInfo& key : case_keys())
    keys.push_back(json_of(key));
  return keys.dump(1);
}

} // namespace plyform
