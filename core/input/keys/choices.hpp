// SPDX-License-Identifier: GPL-3.0-or-later
// Words of choice keys and their values, one table per key, which both the schema and the reader
// use.
#pragma once

#include "core/model/case.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace plyform {

template <class Value>
struct Choice {
  const char* word;
  Value value;
};

inline constexpr Choice<MeshKind> mesh_choices[] = {
    {"diagonal", MeshKind::diagonal}, {"alternating", MeshKind::alternating},
    {"crossed", MeshKind::crossed},   {"fibres", MeshKind::fibres},
    {"free", MeshKind::free},         {"file", MeshKind::file}};

inline constexpr Choice<ElementKind> element_choices[] = {{"auto", ElementKind::automatic},
                                                          {"plain", ElementKind::plain},
                                                          {"averaged", ElementKind::averaged}};

inline constexpr Choice<Motion> motion_choices[] = {
    {"fixed", Motion::fixed}, {"driven", Motion::driven}, {"force", Motion::force}};

inline constexpr Choice<SelfContact> self_choices[] = {
    {"auto", SelfContact::automatic}, {"off", SelfContact::off}, {"on", SelfContact::on}};

inline constexpr Choice<Symmetry> symmetry_choices[] = {
    {"none", Symmetry::none}, {"scene", Symmetry::scene}, {"alike", Symmetry::alike}};

/// The words, in the order of the table.
template <class Value, std::size_t count>
std::vector<std::string> words_of(const Choice<Value> (&choices)[count]) {
  std::vector<std::string> words;
  for (const Choice<Value>& choice : choices)
    words.emplace_back(choice.word);
  return words;
}

/// The value of a word; that of the first word for an unknown one (which the schema check reports).
template <class Value, std::size_t count>
Value value_of(const Choice<Value> (&choices)[count], std::string_view word) {
  for (const Choice<Value>& choice : choices)
    if (word == choice.word) return choice.value;
  return choices[0].value;
}

} // namespace plyform
