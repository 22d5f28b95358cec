// SPDX-License-Identifier: GPL-3.0-or-later
// Values of keys that passed the check, in the program's units.
#include "core/input/schema_check.hpp"

#include <fmt/format.h>
#include <limits>
#include <stdexcept>

namespace plyform {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

const KeyRow& row_of(const Section& section, const std::string& key) {
  const std::string pattern = pattern_of(section.pattern, key);
  const KeyRow* row = find_key(pattern);
  if (!row) throw std::logic_error("no such key in the table: " + section.pattern + "." + key);
  return *row;
}

} // namespace

const Entry* given(const Section& section, const std::string& key) {
  const Entry* value = section.entry ? section.entry->find(key) : nullptr;
  return value && value->sound ? value : nullptr;
}

Section subsection(const Section& section, const std::string& key) {
  Entry* value = section.entry ? section.entry->find(key) : nullptr;
  if (value && value->kind != Entry::Kind::table) value = nullptr;
  return {value, pattern_of(section.pattern, key), item_of(section, key)};
}

std::vector<Section> subsections(const Section& section, const std::string& key) {
  std::vector<Section> sections;
  Entry* value = section.entry ? section.entry->find(key) : nullptr;
  if (!value) return sections;
  const std::string pattern = pattern_of(section.pattern, key), item = item_of(section, key);
  const bool map = value->kind == Entry::Kind::table;
  for (std::size_t i = 0; i < value->children.size(); ++i) {
    Entry& child = value->children[i];
    const std::string name = map ? child.key : fmt::format("{}", i);
    Entry* table = child.kind == Entry::Kind::table ? &child : nullptr;
    sections.push_back({table, pattern + (map ? ".NAME" : "[]"), item + "." + name});
  }
  return sections;
}

double number(const Section& section, const std::string& key) {
  const Entry* value = given(section, key);
  return value ? value->number * unit_factor(row_of(section, key), 0) : nothing;
}

std::vector<double> numbers(const Section& section, const std::string& key) {
  std::vector<double> list;
  if (const Entry* value = given(section, key))
    for (const Entry& item : value->children)
      list.push_back(item.number * unit_factor(row_of(section, key), 0));
  return list;
}

std::vector<Vec2> pairs(const Section& section, const std::string& key) {
  std::vector<Vec2> list;
  if (const Entry* value = given(section, key))
    for (const Entry& item : value->children)
      list.emplace_back(item.children[0].number * unit_factor(row_of(section, key), 0),
                        item.children[1].number * unit_factor(row_of(section, key), 1));
  return list;
}

std::string text(const Section& section, const std::string& key) {
  const Entry* value = given(section, key);
  return value ? value->text : "";
}

Vec2 vector2(const Section& section, const std::string& key) {
  const std::vector<double> v = numbers(section, key);
  return v.size() == 2 ? Vec2(v[0], v[1]) : Vec2::Constant(nothing);
}

Vec3 vector3(const Section& section, const std::string& key) {
  const std::vector<double> v = numbers(section, key);
  return v.size() == 3 ? Vec3(v[0], v[1], v[2]) : Vec3::Constant(nothing);
}

void value_error(const Section& section, const std::string& key, const std::string& rule,
                 const std::string& remedy, Findings& findings) {
  Entry* value = section.entry ? section.entry->find(key) : nullptr;
  if (!value) return;
  findings.error(value->at, item_of(section, key), value->written, rule, remedy);
  value->sound = false;
}

} // namespace plyform
