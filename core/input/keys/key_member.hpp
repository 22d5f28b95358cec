// SPDX-License-Identifier: GPL-3.0-or-later
// Binds rows of the table of keys to members of structs, and reads tables of a file into structs by
// these bindings, so that each key is named in one place only.
#pragma once

#include "core/input/keys/choices.hpp"
#include "core/input/keys/schema_check.hpp"

#include <optional>

namespace plyform {

// Assigns a value in the program's units to a member. For null numbers become NaN, so that
// comparisons fail and no second error is reported for the same value; other members are not
// changed.
void assign(double& member, const KeyRow& row, const TomlNode* node);
void assign(int& member, const KeyRow& row, const TomlNode* node);
void assign(bool& member, const KeyRow& row, const TomlNode* node);
void assign(std::string& member, const KeyRow& row, const TomlNode* node);
void assign(Vec3& member, const KeyRow& row, const TomlNode* node);
void assign(std::optional<double>& member, const KeyRow& row, const TomlNode* node);

template <class Struct, class Value>
KeyMember to(Value Struct::*member) {
  return {typeid(Struct), [member](void* object, const KeyRow& row, const TomlNode* node) {
            assign(static_cast<Struct*>(object)->*member, row, node);
          }};
}

/// Binding of a choice key; `choices` must outlive the row.
template <class Struct, class Value, std::size_t count>
KeyMember to(Value Struct::*member, const Choice<Value> (&choices)[count]) {
  return {typeid(Struct), [member, &choices](void* object, const KeyRow&, const TomlNode* node) {
            if (node) static_cast<Struct*>(object)->*member = value_of(choices, node->text);
          }};
}

/// Fills the members of `object`, a struct of this type, as the template below.
void read_members(const TableView& section, std::type_index type, void* object);

/// Fills the members of `object` to which keys of `section` are bound. Members of optional keys
/// that are not given, and of keys of another choice, are not changed.
template <class Struct>
void read_members(const TableView& section, Struct& object) {
  read_members(section, typeid(Struct), &object);
}

} // namespace plyform
