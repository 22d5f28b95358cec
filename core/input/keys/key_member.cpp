// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/keys/key_member.hpp"

#include <algorithm>
#include <limits>

namespace plyform {

namespace {

/// Whether a key that is not given is missing, so that its member is set to `not_given`.
bool is_missed(const TableView& section, const KeyRow& row) {
  if (!row.otherwise.empty() || !row.goes_with(text(section, row.of))) return false;
  return std::none_of(row.instead.begin(), row.instead.end(),
                      [&](const std::string& other) { return given(section, other); });
}

} // namespace

void assign(double& member, const KeyRow& row, const TomlNode* node) {
  member = node ? node->number * unit_factor(row, 0) : not_given;
}

void assign(int& member, const KeyRow&, const TomlNode* node) {
  if (node) member = static_cast<int>(node->number);
}

void assign(bool& member, const KeyRow&, const TomlNode* node) {
  if (node) member = node->source_text == "true";
}

void assign(std::string& member, const KeyRow&, const TomlNode* node) {
  if (node) member = node->text;
}

void assign(Vec3& member, const KeyRow& row, const TomlNode* node) {
  for (std::size_t i = 0; i < 3; ++i)
    assign(member[static_cast<int>(i)], row, node ? &node->children[i] : nullptr);
}

void assign(std::optional<double>& member, const KeyRow& row, const TomlNode* node) {
  if (node) assign(member.emplace(), row, node);
}

void read_members(const TableView& section, std::type_index type, void* object) {
  for (const KeyRow* row : keys_below(section.pattern))
    for (const KeyMember& member : row->members) {
      if (member.of != type) continue;
      const TomlNode* node = given(section, last_part(row->key));
      if (node || is_missed(section, *row)) member.set(object, *row, node);
    }
}

} // namespace plyform
