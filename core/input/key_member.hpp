// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of the table of keys bound to the members that they fill, and tables of a file read into
// structs by them: no key is named twice.
#pragma once

#include "core/input/choices.hpp"
#include "core/input/schema_check.hpp"

#include <optional>

namespace plyform {

// A value in the program's units. Without one (null) numbers become NaN, so that comparisons fail
// and no second mistake is reported for the same value; the others stay as they are.
void assign(double& member, const KeyRow& row, const TomlNode* node);
void assign(int& member, const KeyRow& row, const TomlNode* node);
void assign(std::string& member, const KeyRow& row, const TomlNode* node);
void assign(Vec3& member, const KeyRow& row, const TomlNode* node);
void assign(std::optional<double>& member, const KeyRow& row, const TomlNode* node);

template <class Struct, class Value>
KeyMember to(Value Struct::*member) {
  return {typeid(Struct), [member](void* object, const KeyRow& row, const TomlNode* node) {
            assign(static_cast<Struct*>(object)->*member, row, node);
          }};
}

/// A choice: `choices` must outlive the row.
template <class Struct, class Value, std::size_t count>
KeyMember to(Value Struct::*member, const Choice<Value> (&choices)[count]) {
  return {typeid(Struct), [member, &choices](void* object, const KeyRow&, const TomlNode* node) {
            if (node) static_cast<Struct*>(object)->*member = value_of(choices, node->text);
          }};
}

/// Fills what `section` has for a struct of this type.
void read_members(const TableView& section, std::type_index type, void* object);

/// Fills the members of `object` to which keys of `section` are bound. Keys that are not given and
/// need not be, and those of another choice, leave their member as it is.
template <class Struct>
void read_members(const TableView& section, Struct& object) {
  read_members(section, typeid(Struct), &object);
}

} // namespace plyform
