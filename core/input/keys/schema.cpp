// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/keys/schema.hpp"

#include "base/format.hpp"
#include "base/geometry.hpp"
#include "base/text.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plyform {

bool Range::holds(double x) const {
  return (open_least ? x > least : x >= least) && (open_most ? x < most : x <= most);
}

std::string Range::text() const {
  const bool below = std::isfinite(least), above = std::isfinite(most);
  if (below && above)
    return fmt::format("{}{:g}, {:g}{}", open_least ? '(' : '[', least, most,
                       open_most ? ')' : ']');
  if (below) return fmt::format("{} {:g}", open_least ? ">" : ">=", least);
  if (above) return fmt::format("{} {:g}", open_most ? "<" : "<=", most);
  return "";
}

std::string Range::rule() const {
  const std::string low = fmt::format("{} {:g}", open_least ? "greater than" : "at least", least);
  const std::string high = fmt::format("{} {:g}", open_most ? "less than" : "at most", most);
  const bool below = std::isfinite(least), above = std::isfinite(most);
  return "must be " + (below && above ? low + " and " + high : below ? low : high);
}

std::string Range::span() const {
  return fmt::format("{:g} to {:g}", least, most);
}

namespace {

const Range& of_column(const std::vector<Range>& ranges, std::size_t column) {
  static const Range any;
  return ranges.empty() ? any : ranges[std::min(column, ranges.size() - 1)];
}

} // namespace

const Range& KeyRow::range_of(std::size_t column) const {
  return of_column(ranges, column);
}

const Range& KeyRow::usual_of(std::size_t column) const {
  return of_column(usual, column);
}

bool KeyRow::goes_with(const std::string& choice) const {
  return of.empty() || std::find(with.begin(), with.end(), choice) != with.end();
}

const KeyRow* find_key(const std::string& pattern) {
  for (const KeyRow& row : key_table())
    if (row.key == pattern) return &row;
  return nullptr;
}

std::vector<const KeyRow*> keys_below(const std::string& pattern) {
  const std::string prefix = pattern.empty() ? "" : pattern + ".";
  std::vector<const KeyRow*> rows;
  for (const KeyRow& row : key_table())
    if (row.key.starts_with(prefix) && row.key.find('.', prefix.size()) == std::string::npos)
      rows.push_back(&row);
  return rows;
}

std::string pattern_of(const std::string& pattern, const std::string& name) {
  const std::string prefix = pattern.empty() ? "" : pattern + ".";
  const KeyRow* table = find_key(pattern);
  if (table && table->kind == KeyKind::map) return prefix + "NAME";
  // a quoted name with dots or brackets matches no pattern
  if (name.find_first_of(".[") != std::string::npos) return "";
  return find_key(prefix + name) ? prefix + name : "";
}

std::string last_part(const std::string& pattern) {
  return pattern.substr(pattern.rfind('.') + 1); // npos + 1 = 0: the whole pattern
}

namespace {

double factor_of_unit(const std::string& unit) {
  if (unit == "deg") return degree;
  if (unit == "g/m2") return 1e-12;    // 1e-6 t / 1e6 mm^2
  if (unit == "g/cm3") return 1e-9;    // 1e-6 t / 1e3 mm^3
  if (unit == "kg") return 1e-3;       // t
  if (unit == "J/(g K)") return 1e9;   // 1e3 N mm / (1e-6 t K)
  if (unit == "W/(m2 K)") return 1e-3; // 1e3 N mm/s / (1e6 mm^2 K)
  if (unit == "kJ/mol") return 1e3;    // J/mol, as it divides by the gas constant
  if (unit == "Pa s") return 1e-6;     // N s/mm^2
  return 1.0;
}

} // namespace

std::string unit_of_column(const KeyRow& row, std::size_t column) {
  std::string units = row.unit;
  for (std::size_t c = 0; c < column && units.find(", ") != std::string::npos; ++c)
    units = units.substr(units.find(", ") + 2);
  return units.substr(0, units.find(", "));
}

double unit_factor(const KeyRow& row, std::size_t column) {
  return factor_of_unit(unit_of_column(row, column));
}

} // namespace plyform
