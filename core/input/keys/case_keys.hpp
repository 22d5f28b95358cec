// SPDX-License-Identifier: GPL-3.0-or-later
// The keys of case and fabric files as users see them: the table that `plyform keys` prints, and
// what --set changes.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace plyform {

/// One --set KEY=VALUE: dotted path with list items by number from 0 (ply.2.angle), and TOML value
/// (a bare word that is not a TOML value is read as a string).
using Override = std::pair<std::string, std::string>;

/// What a column of numbers may be; infinite where there is no bound.
struct KeyColumn {
  std::string unit; ///< mm, N, s, deg ...; - for none
  double least = 0.0, most = 0.0;
  bool open_least = false, open_most = false; ///< whether the ends do not belong to it
  double usual_least = 0.0, usual_most = 0.0; ///< what is beyond gets a warning
};

/// A key as a form needs it. TOML: text that stands for a value in a file.
struct KeyForm {
  /// table, tables, map, fabric, text, name, path, choice, number, integer, boolean, numbers,
  /// pairs, names, profile, outlines: KeyKind in core/input/keys/schema.hpp
  std::string kind;
  bool required = false;               ///< in every table that may have it
  std::string fallback;                ///< TOML, taken when it is not given; empty: none
  std::string otherwise;               ///< the same in words, if it is no value
  std::vector<std::string> implied_by; ///< keys of the same table beside which `implied` is taken
  std::string implied;                 ///< TOML
  std::vector<std::string> choices;    ///< of a choice; beside `refers`: words for several items
  std::vector<std::string> refers;     ///< patterns of the tables of whose items it is a name
  std::vector<KeyColumn> columns;      ///< of numbers; the last one is that of all further ones
  std::size_t count = 0;               ///< of numbers and names; 0: any number
  std::size_t least_items = 0, most_items = 0; ///< of a list; 0: no bound
  std::vector<std::string>
      instead;    ///< keys of which one only is given, and one is unless otherwise
  std::string of; ///< choice key of the same table that it depends on; or empty
  std::vector<std::string> of_values; ///< values of that key with which it may stand
};

/// One row of `plyform keys`.
struct KeyInfo {
  std::string key;      ///< dotted path; [[tool]] items as tool[].radius
  std::string type;     ///< number, integer, string, boolean, list of ...
  std::string unit;     ///< mm, N, s, deg, g/m2, 1/mm, - ...
  std::string fallback; ///< default as TOML, or "required", or "required for ..."
  std::string range;    ///< "> 0", "[0, 1]", "one of ..."
  std::string meaning;
  KeyForm form;
};

/// Every key of case and fabric files, from the table the reader itself uses.
std::vector<KeyInfo> case_keys();

/// case_keys as JSON: a list of objects with the members of KeyInfo and KeyForm by their names, but
/// `default` for the fallback in words, and null for a bound that there is none of.
std::string case_keys_json();

} // namespace plyform
