// SPDX-License-Identifier: GPL-3.0-or-later
// Values of keys that check_section found valid, in the program's units.
#include "base/format.hpp"
#include "core/input/keys/schema_check.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace plyform {

namespace {

const KeyRow& row_of(const TableView& section, const std::string& key) {
  const std::string pattern = pattern_of(section.pattern, key);
  const KeyRow* row = find_key(pattern);
  if (!row) throw std::logic_error("no such key in the table: " + section.pattern + "." + key);
  return *row;
}

} // namespace

const TomlNode* given(const TableView& section, const std::string& key) {
  const TomlNode* value = section.entry ? section.entry->find(key) : nullptr;
  return value && value->valid ? value : nullptr;
}

TableView subsection(const TableView& section, const std::string& key) {
  TomlNode* value = section.entry ? section.entry->find(key) : nullptr;
  if (value && value->kind != TomlNode::Kind::table) value = nullptr;
  return {value, pattern_of(section.pattern, key), item_of(section, key)};
}

std::vector<TableView> subsections(const TableView& section, const std::string& key) {
  std::vector<TableView> sections;
  TomlNode* value = section.entry ? section.entry->find(key) : nullptr;
  if (!value || !value->valid) return sections;
  const std::string pattern = pattern_of(section.pattern, key), item = item_of(section, key);
  const bool map = value->kind == TomlNode::Kind::table;
  for (std::size_t i = 0; i < value->children.size(); ++i) {
    TomlNode& child = value->children[i];
    const std::string name = map ? child.key : fmt::format("{}", i);
    TomlNode* table = child.kind == TomlNode::Kind::table ? &child : nullptr;
    sections.push_back({table, pattern + (map ? ".NAME" : "[]"), item + "." + name});
  }
  return sections;
}

namespace {

bool all_valid(const TomlNode& node) {
  return node.valid && std::all_of(node.children.begin(), node.children.end(), all_valid);
}

} // namespace

bool is_sound(const TableView& section) {
  return section.entry && all_valid(*section.entry);
}

bool is_sound(const TableView& section, const std::string& key) {
  const TomlNode* value = section.entry ? section.entry->find(key) : nullptr;
  return !value || all_valid(*value);
}

bool knows_names(const TableView& section, const std::string& key) {
  const TomlNode* tables = given(section, key);
  if (!tables) return false;
  if (tables->kind == TomlNode::Kind::table) return true; // a map: their keys are the names
  const std::vector<TableView> sections = subsections(section, key);
  return std::all_of(sections.begin(), sections.end(),
                     [](const TableView& table) { return given(table, "name") != nullptr; });
}

double number(const TableView& section, const std::string& key) {
  const TomlNode* value = given(section, key);
  return value ? value->number * unit_factor(row_of(section, key), 0) : not_given;
}

std::vector<double> numbers(const TableView& section, const std::string& key) {
  std::vector<double> list;
  if (const TomlNode* value = given(section, key)) {
    const double factor = unit_factor(row_of(section, key), 0);
    for (const TomlNode& item : value->children)
      list.push_back(item.number * factor);
  }
  return list;
}

std::vector<Vec2> pairs(const TableView& section, const std::string& key) {
  std::vector<Vec2> list;
  if (const TomlNode* value = given(section, key)) {
    const KeyRow& row = row_of(section, key);
    const double first = unit_factor(row, 0), second = unit_factor(row, 1);
    for (const TomlNode& item : value->children)
      list.emplace_back(item.children[0].number * first, item.children[1].number * second);
  }
  return list;
}

std::string text(const TableView& section, const std::string& key) {
  const TomlNode* value = given(section, key);
  return value ? value->text : "";
}

Vec2 vector2(const TableView& section, const std::string& key) {
  const std::vector<double> v = numbers(section, key);
  return v.size() == 2 ? Vec2(v[0], v[1]) : Vec2::Constant(not_given);
}

Vec3 vector3(const TableView& section, const std::string& key) {
  const std::vector<double> v = numbers(section, key);
  return v.size() == 3 ? Vec3(v[0], v[1], v[2]) : Vec3::Constant(not_given);
}

void value_error(const TableView& section, const std::string& key, const std::string& rule,
                 const std::string& remedy, Diagnostics& diagnostics) {
  TomlNode* value = section.entry ? section.entry->find(key) : nullptr;
  if (!value) return;
  diagnostics.error(value->at, item_of(section, key), value->source_text, rule, remedy);
  value->valid = false;
}

void row_error(const TableView& section, const std::string& key, std::size_t row,
               const std::string& rule, const std::string& remedy, Diagnostics& diagnostics) {
  TomlNode* value = section.entry ? section.entry->find(key) : nullptr;
  if (!value || row >= value->children.size()) return;
  const TomlNode& entry = value->children[row];
  diagnostics.error(entry.at, fmt::format("{}.{}", item_of(section, key), row), entry.source_text,
                    rule, remedy);
}

} // namespace plyform
