// SPDX-License-Identifier: GPL-3.0-or-later
// What a column of a curve is, from its header: "Load (kN)", "Extension [mm]", "F / N", "force_N",
// "shear angle in deg", or a second header row with the units. A unit decides; without one the
// words of the name do ("Crosshead travel" is a length). Of compound units a force over a length
// is known, "N/mm" or "..._N_per_mm". Spelling of units as in the SI; other
// letters (KN, MM) where they cannot be mistaken.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace plyform {

enum class Quantity {
  unknown,          ///< neither unit nor word says what it is
  length,           ///< mm
  force,            ///< N
  angle,            ///< rad
  strain,           ///< 1
  force_per_length, ///< N/mm
  stress,           ///< N/mm^2
  stretch,          ///< 1, length over that before
  time,
  other, ///< none of these: an energy
};

/// "length" ...; "of unknown kind".
std::string quantity_name(Quantity quantity);

struct Unit {
  Quantity quantity;
  double factor; ///< to mm, N, rad, 1, N/mm, N/mm^2
};

/// The unit of that name, or nothing.
std::optional<Unit> find_unit(std::string_view name);

/// Names of the units of a quantity, for messages: "mm, cm, m ...".
std::string units_of(Quantity quantity);

struct ColumnMeaning {
  Quantity quantity = Quantity::unknown;
  double factor = 1.0;
  std::string unit; ///< as written; empty: none, and factor is that of usual_factor
};

/// Of numbers without a unit: mm, N, degrees, 1.
double usual_factor(Quantity quantity);

/// Of a column with this name, and what stands below it in a row of units (or empty).
ColumnMeaning meaning_of(const std::string& name, const std::string& unit_below);

/// Whether a name contains one of the words (English, lower case) as a whole word.
bool has_word(const std::string& name, const std::string& words);

} // namespace plyform
