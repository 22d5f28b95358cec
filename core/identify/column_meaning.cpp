// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/column_meaning.hpp"

#include "base/geometry.hpp"
#include "base/text.hpp"

#include <algorithm>
#include <cctype>
#include <vector>

namespace plyform {
namespace {

using Q = Quantity;

struct Words {
  std::string_view words;
  Quantity quantity;
};

// What a column without a unit is, by the first line that has a word of its name. Greek: lambda,
// gamma, epsilon, sigma.
constexpr Words words_of_quantities[] = {
    {"time zeit", Q::time},
    {"tenacity energy work torque moment temperature width thickness diameter speed rate velocity "
     "acceleration",
     Q::other},
    {"stress pressure spannung druck \xCF\x83", Q::stress},
    {"stretch lambda \xCE\xBB", Q::stretch},
    {"angle gamma winkel \xCE\xB3", Q::angle},
    {"strain dehnung fraction vf \xCE\xB5", Q::strain},
    {"force load kraft", Q::force},
    {"extension displacement elongation crosshead stroke travel deflection weg overhang length",
     Q::length},
};

// Words that stand where a unit may and are none: which of several columns it is, where, by what.
constexpr std::string_view labels =
    "raw filtered smooth smoothed corrected uncorrected compensated zeroed tared measured fitted "
    "fit model experiment experimental exp test tests specimen specimens sample curve run mean "
    "average averaged avg median max maximum minimum peak total sum net abs absolute cell channel "
    "ch sensor gauge gage lvdt extensometer machine frame grip clamp upper lower left right top "
    "bottom front back warp weft fill fibre fiber yarn yarns tow tows along across diagonal axial "
    "axis direction side middle centre center edge outer inner first third last start end "
    "value values data signal reading readings number index step cycle loading unloading up down "
    "offset std dev deviation error err scatter limit theory fea simulated simulation dic camera "
    "video image analysis photo optical nominal engineering eng true cauchy hencky logarithmic log "
    "green lagrange shear normal normalised normalized tensile tension compressive compression "
    "bending flexural biaxial uniaxial equibiaxial picture pull out steady static dynamic viscous "
    "elastic slack drawn positive negative fabric ply layer cloth rubber zone position distance "
    "tip chord sag drop slip half between ratio gap the of and for from by with without over per "
    "in to "
    "a head bias x y z lang laengs quer mitte rel relative";

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// Letters, digits, and what units are written with.
bool in_token(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return std::isalnum(byte) != 0 || byte >= 0x80 || c == '%' || c == '"';
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

/// What stands in the brackets of a name, the last ones first.
std::vector<std::string> in_brackets(const std::string& name) {
  std::vector<std::string> found;
  for (std::size_t end = name.find_last_of(")]}"); end != std::string::npos && end > 0;
       end = name.find_last_of(")]}", end - 1)) {
    const char open = name[end] == ')' ? '(' : name[end] == ']' ? '[' : '{';
    const std::size_t start = name.find_last_of(open, end);
    if (start == std::string::npos) break;
    found.push_back(bare(name.substr(start, end - start + 1)));
    if (start == 0) break;
    end = start;
  }
  return found;
}

/// The tokens of a list of words, sorted: headers may have very many names.
std::vector<std::string> sorted_words(std::string_view words) {
  std::vector<std::string> sorted = tokens_of(words);
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

/// By the first line of the list that has one of these tokens.
Quantity quantity_of(const std::vector<std::string>& tokens) {
  static const auto lists = [] {
    std::vector<std::pair<std::vector<std::string>, Quantity>> all;
    for (const Words& line : words_of_quantities)
      all.emplace_back(sorted_words(line.words), line.quantity);
    return all;
  }();
  for (const auto& [words, quantity] : lists)
    for (const std::string& token : tokens)
      if (std::binary_search(words.begin(), words.end(), lower_case(token))) return quantity;
  return Q::unknown;
}

Quantity quantity_by_words(const std::string& name) {
  return quantity_of(tokens_of(name));
}

bool is_number(const std::string& token) {
  return std::all_of(token.begin(), token.end(),
                     [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// Whether a token is a number, or a word that is no unit.
bool is_label(const std::string& token) {
  static const std::vector<std::string> known = sorted_words(labels);
  return is_number(token) || std::binary_search(known.begin(), known.end(), lower_case(token)) ||
         quantity_of({token}) != Q::unknown;
}

bool has_digit(const std::string& token) {
  return std::any_of(token.begin(), token.end(),
                     [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// By the unit, and of what has no dimension by the words.
ColumnMeaning meaning_by(const Unit& unit, const std::string& text, const std::string& name) {
  const bool stretch = unit.quantity == Q::strain && quantity_by_words(name) == Q::stretch;
  return {stretch ? Q::stretch : unit.quantity, unit.factor, text};
}

ColumnMeaning meaning_by_words(const std::string& name) {
  const Quantity quantity = quantity_by_words(name);
  return {quantity, usual_factor(quantity), ""};
}

ColumnMeaning not_known(const std::string& name, const std::string& text) {
  ColumnMeaning meaning = meaning_by_words(name);
  meaning.unknown_unit = text;
  return meaning;
}

/// A text where a unit should stand, or nothing if it says something else.
std::optional<ColumnMeaning> meaning_of_unit(const std::string& text, const std::string& name) {
  if (text.empty()) return std::nullopt;
  if (text == "-" || text == "1") { // of no dimension
    ColumnMeaning meaning = meaning_by_words(name);
    const bool fits = meaning.quantity == Q::strain || meaning.quantity == Q::stretch ||
                      meaning.quantity == Q::unknown;
    return fits ? meaning : ColumnMeaning{Q::other, 1.0, text};
  }
  const std::vector<std::string> tokens = tokens_of(text);
  for (const std::string& spelt : {text, joined(tokens, "-")}) // "pound force"
    if (const auto unit = find_unit(spelt)) return meaning_by(*unit, text, name);
  if (std::all_of(tokens.begin(), tokens.end(), is_label)) return std::nullopt;
  return not_known(name, text);
}

/// Tokens without those at the end that only say what the column is, or which of several.
std::vector<std::string> without_labels(std::vector<std::string> tokens) {
  while (tokens.size() > 1 && is_label(tokens.back()) && !find_unit(tokens.back()))
    tokens.pop_back();
  return tokens;
}

/// "f_N_per_mm", "Load pound force": units that are written in several words.
std::optional<ColumnMeaning> unit_of_words(const std::vector<std::string>& parts,
                                           const std::string& name) {
  const std::size_t n = parts.size();
  if (n > 3 && parts[n - 2] == "per") {
    const std::string over = parts[n - 3] + "/" + parts[n - 1];
    if (const auto unit = find_unit(over)) return meaning_by(*unit, over, name);
  }
  if (n < 3) return std::nullopt;
  const std::string both = parts[n - 2] + "-" + parts[n - 1];
  const auto unit = find_unit(both);
  return unit && unit->quantity != Q::other ? std::optional(meaning_by(*unit, both, name))
                                            : std::nullopt;
}

/// A token at the end of a name that stands where a unit may, and is none that is known. Single
/// letters and tokens with digits say which of several columns it is: "load A", "force_x2".
std::optional<ColumnMeaning> unknown_at_end(const std::string& last, const std::string& name) {
  const std::size_t stroke = name.find_last_of('/');
  const bool after_stroke = stroke != std::string::npos &&
                            tokens_of(name.substr(stroke + 1)) == std::vector<std::string>{last};
  const bool of_quantity = quantity_by_words(name.substr(0, name.rfind(last))) != Q::unknown;
  if (is_label(last) || (!of_quantity && !after_stroke)) return std::nullopt;
  if (!after_stroke && (last.size() == 1 || has_digit(last))) return std::nullopt;
  return not_known(name, last);
}

/// The unit at the end of "force_N", "F / N", "Load in kN", "force_N_filtered" or "kN force". A
/// column named "m" or "N" alone is not taken for one.
std::optional<ColumnMeaning> unit_at_end(const std::string& name) {
  if (const std::size_t at = name.find_last_of(" \t_");
      at != std::string::npos && name.find('/', at) != std::string::npos)
    if (const auto unit = find_unit(name.substr(at + 1)))
      return meaning_by(*unit, name.substr(at + 1), name);
  const std::vector<std::string> all = tokens_of(name);
  if (const auto known = unit_of_words(all, name)) return known;
  const std::vector<std::string> parts = without_labels(all);
  if (all.size() < 2) return std::nullopt;
  const std::string& last = parts.back();
  const auto unit = find_unit(last);
  if (!unit) return unknown_at_end(last, name);
  if (parts.size() == 1) // "kN force", but not "s load" nor "min load"
    return last.size() > 1 && !is_label(last) ? std::optional(meaning_by(*unit, last, name))
                                              : std::nullopt;
  if (const auto known = unit_of_words(parts, name)) return known;
  const std::string& before = parts[parts.size() - 2];
  if (before == "per" || (find_unit(before) && lower_case(before) != "in"))
    return ColumnMeaning{Q::other, 1.0, before + " " + last};
  return meaning_by(*unit, last, name);
}

} // namespace

double usual_factor(Quantity quantity) {
  return quantity == Quantity::angle ? degree : 1.0;
}

std::string usual_unit(Quantity quantity) {
  switch (quantity) {
  case Q::length:
    return "mm";
  case Q::force:
    return "N";
  case Q::angle:
    return "degrees";
  case Q::force_per_length:
    return "N/mm";
  case Q::stress:
    return "N/mm2";
  case Q::time:
    return "s";
  default:
    return "";
  }
}

bool has_word(const std::string& name, const std::string& words) {
  const std::vector<std::string> known = tokens_of(words);
  for (const std::string& part : tokens_of(name))
    if (std::find(known.begin(), known.end(), lower_case(part)) != known.end()) return true;
  return false;
}

bool may_be_unit(const std::string& text) {
  const std::string inner = bare(text);
  if (find_unit(inner) || (!inner.empty() && inner != text)) return true;
  return tokens_of(inner).size() == 1 && inner.size() > 1 && !has_digit(inner) && !is_label(inner);
}

ColumnMeaning meaning_of(const std::string& name, const std::string& unit_below) {
  if (const auto found = meaning_of_unit(bare(unit_below), name)) return *found;
  std::optional<ColumnMeaning> doubtful;
  for (const std::string& text : in_brackets(name))
    if (const auto found = meaning_of_unit(text, name)) {
      if (found->unknown_unit.empty()) return *found;
      if (!doubtful) doubtful = found;
    }
  if (doubtful) return *doubtful;
  if (const auto found = unit_at_end(name)) return *found;
  if (has_word(name, "force load") && has_word(name, "per") && has_word(name, "width length"))
    return {Q::force_per_length, 1.0, ""};
  return meaning_by_words(name);
}

} // namespace plyform
