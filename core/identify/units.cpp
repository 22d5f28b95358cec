// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/units.hpp"

#include "base/geometry.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

namespace plyform {
namespace {

using Q = Quantity;

struct NamedUnit {
  std::string_view name;
  Unit unit;
};

// Those in capitals by mistake are below the right ones. MN and Mm are not there: they are mN and
// mm as often as what they mean.
constexpr NamedUnit units[] = {
    {"mm", {Q::length, 1.0}},
    {"cm", {Q::length, 10.0}},
    {"m", {Q::length, 1000.0}},
    {"um", {Q::length, 1e-3}},
    {"\xC2\xB5m", {Q::length, 1e-3}}, // micro sign
    {"\xCE\xBCm", {Q::length, 1e-3}}, // Greek mu
    {"in", {Q::length, 25.4}},
    {"inch", {Q::length, 25.4}},
    {"MM", {Q::length, 1.0}},
    {"millimeter", {Q::length, 1.0}},
    {"millimetre", {Q::length, 1.0}},
    {"N", {Q::force, 1.0}},
    {"kN", {Q::force, 1000.0}},
    {"cN", {Q::force, 0.01}},
    {"mN", {Q::force, 1e-3}},
    {"daN", {Q::force, 10.0}},
    {"gf", {Q::force, 9.80665e-3}},
    {"kgf", {Q::force, 9.80665}},
    {"lbf", {Q::force, 4.4482216152605}},
    {"KN", {Q::force, 1000.0}},
    {"newton", {Q::force, 1.0}},
    {"Newton", {Q::force, 1.0}},
    {"deg", {Q::angle, degree}},
    {"degree", {Q::angle, degree}},
    {"degrees", {Q::angle, degree}},
    {"\xC2\xB0", {Q::angle, degree}}, // degree sign
    {"rad", {Q::angle, 1.0}},
    {"mrad", {Q::angle, 1e-3}},
    {"DEG", {Q::angle, degree}},
    {"%", {Q::strain, 0.01}},
    {"percent", {Q::strain, 0.01}},
    {"pct", {Q::strain, 0.01}},
    {"mm/mm", {Q::strain, 1.0}},
    {"m/m", {Q::strain, 1.0}},
    {"N/mm", {Q::force_per_length, 1.0}},
    {"kN/m", {Q::force_per_length, 1.0}},
    {"N/cm", {Q::force_per_length, 0.1}},
    {"N/m", {Q::force_per_length, 1e-3}},
    {"mN/mm", {Q::force_per_length, 1e-3}},
    {"cN/mm", {Q::force_per_length, 0.01}},
    {"N/mm2", {Q::stress, 1.0}},
    {"N/mm^2", {Q::stress, 1.0}},
    {"N/mm\xC2\xB2", {Q::stress, 1.0}}, // superscript 2
    {"MPa", {Q::stress, 1.0}},
    {"kPa", {Q::stress, 1e-3}},
    {"Pa", {Q::stress, 1e-6}},
    {"GPa", {Q::stress, 1e3}},
    {"psi", {Q::stress, 6.894757293168e-3}},
    {"stretch", {Q::stretch, 1.0}},
    {"s", {Q::time, 1.0}},
    {"sec", {Q::time, 1.0}},
    {"ms", {Q::time, 1e-3}},
    {"min", {Q::time, 60.0}},
    {"h", {Q::time, 3600.0}},
    {"J", {Q::other, 1.0}},
    {"mJ", {Q::other, 1.0}},
    {"Nm", {Q::other, 1.0}},
    {"Nmm", {Q::other, 1.0}},
    {"g", {Q::other, 1.0}},
    {"kg", {Q::other, 1.0}},
    {"V", {Q::other, 1.0}},
    {"mV", {Q::other, 1.0}},
    {"Hz", {Q::other, 1.0}},
    {"C", {Q::other, 1.0}},
    {"\xC2\xB0"
     "C",
     {Q::other, 1.0}},
};

struct Words {
  std::string_view words;
  Quantity quantity;
};

// What a column without a unit is, by the first line that has a word of its name.
constexpr Words words_of_quantities[] = {
    {"time zeit", Q::time},
    {"stress spannung", Q::stress},
    {"stretch", Q::stretch},
    {"tenacity energy work torque moment temperature width thickness speed", Q::other},
    {"angle gamma winkel", Q::angle},
    {"strain dehnung", Q::strain},
    {"force load kraft", Q::force},
    {"extension displacement elongation crosshead stroke travel deflection weg overhang",
     Q::length},
};

/// Letters, digits, and what units are written with.
bool in_token(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return std::isalnum(byte) != 0 || byte >= 0x80 || c == '%';
}

std::vector<std::string> tokens_of(std::string_view name) {
  std::vector<std::string> tokens(1);
  for (const char c : name) {
    if (in_token(c))
      tokens.back() += c;
    else if (!tokens.back().empty())
      tokens.emplace_back();
  }
  if (tokens.back().empty()) tokens.pop_back();
  return tokens;
}

std::string bare(std::string_view text) {
  constexpr const char* around = " \t()[]{}";
  const std::size_t from = text.find_first_not_of(around);
  if (from == std::string_view::npos) return "";
  return std::string(text.substr(from, text.find_last_not_of(around) - from + 1));
}

/// What stands in the last brackets of a name, or nothing.
std::string in_brackets(const std::string& name) {
  const std::size_t end = name.find_last_of(")]");
  if (end == std::string::npos) return "";
  const std::size_t start = name.find_last_of(name[end] == ')' ? '(' : '[', end);
  return start == std::string::npos ? "" : bare(name.substr(start, end - start + 1));
}

/// A text where a unit should stand: its meaning; a compound of units (N/mm) is something else.
std::optional<ColumnMeaning> meaning_of_unit(const std::string& text) {
  if (text.empty()) return std::nullopt;
  if (const auto unit = find_unit(text)) return ColumnMeaning{unit->quantity, unit->factor, text};
  const std::vector<std::string> parts = tokens_of(text);
  const bool compound = text.find_first_of("/*^") != std::string::npos && !parts.empty() &&
                        std::all_of(parts.begin(), parts.end(), [](const std::string& part) {
                          return find_unit(part) || part == "tex" || part == "2" || part == "3";
                        });
  if (compound) return ColumnMeaning{Q::other, 1.0, text};
  return std::nullopt;
}

/// The unit at the end of "force_N", "F / N" or "Load in kN". Words that stand before it, so that a
/// column named "m" or "N" alone is not taken for one.
std::optional<ColumnMeaning> unit_at_end(const std::string& name) {
  if (const std::size_t space = name.find_last_of(" \t"); space != std::string::npos)
    if (const auto found = meaning_of_unit(name.substr(space + 1))) return found;
  const std::vector<std::string> parts = tokens_of(name);
  if (parts.size() < 2) return std::nullopt;
  const std::string &last = parts.back(), &before = parts[parts.size() - 2];
  const auto unit = find_unit(last);
  if (!unit) return std::nullopt;
  if (before == "per" && parts.size() > 3) {
    const std::string over = parts[parts.size() - 3] + "/" + last;
    if (const auto known = find_unit(over))
      return ColumnMeaning{known->quantity, known->factor, over};
  }
  const bool compound = before == "per" || (find_unit(before) && before != "in");
  if (compound) return ColumnMeaning{Q::other, 1.0, before + " " + last};
  return ColumnMeaning{unit->quantity, unit->factor, last};
}

} // namespace

std::string quantity_name(Quantity quantity) {
  switch (quantity) {
  case Q::length:
    return "length";
  case Q::force:
    return "force";
  case Q::angle:
    return "angle";
  case Q::strain:
    return "strain";
  case Q::force_per_length:
    return "force per length";
  case Q::stress:
    return "stress";
  case Q::stretch:
    return "stretch";
  case Q::time:
    return "time";
  case Q::other:
    return "something else";
  default:
    return "of unknown kind";
  }
}

std::optional<Unit> find_unit(std::string_view name) {
  for (const NamedUnit& unit : units)
    if (unit.name == name) return unit.unit;
  return std::nullopt;
}

std::string units_of(Quantity quantity) {
  std::string names;
  for (const NamedUnit& unit : units)
    if (unit.unit.quantity == quantity)
      names += (names.empty() ? "" : ", ") + std::string(unit.name);
  return names;
}

double usual_factor(Quantity quantity) {
  return quantity == Quantity::angle ? degree : 1.0;
}

bool has_word(const std::string& name, const std::string& words) {
  const std::vector<std::string> known = tokens_of(words);
  for (std::string part : tokens_of(name)) {
    std::transform(part.begin(), part.end(), part.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (std::find(known.begin(), known.end(), part) != known.end()) return true;
  }
  return false;
}

ColumnMeaning meaning_of(const std::string& name, const std::string& unit_below) {
  if (const auto found = meaning_of_unit(bare(unit_below))) return *found;
  if (const auto found = meaning_of_unit(in_brackets(name))) return *found;
  if (const auto found = unit_at_end(name)) return *found;
  for (const Words& words : words_of_quantities)
    if (has_word(name, std::string(words.words)))
      return {words.quantity, usual_factor(words.quantity), ""};
  return {};
}

} // namespace plyform
