// SPDX-License-Identifier: GPL-3.0-or-later
// The one table of units that files and options may write: columns of curves, drawings, parts. All
// readers ask it, the Python programs by plyform.units(), so that none knows a unit that another
// does not. Compounds follow from it: a force over a length, "kgf/cm", over an area, "lbf/in2".
//
// Spelling as in the SI; other letters (KN, psi and PSI) where they cannot be mistaken: not MN nor
// Mm, which are mN and mm as often as what they mean. In a column of loads pounds and ounces are
// forces, as scales and old machines show them; g and kg are not.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

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
  time,             ///< s
  other,            ///< none of these: an energy
};

/// "length" ...; "of unknown kind".
std::string quantity_name(Quantity quantity);

struct Unit {
  Quantity quantity;
  double factor; ///< to mm, N, rad, 1, N/mm, N/mm^2, s
};

/// The unit of that name, or nothing.
std::optional<Unit> find_unit(std::string_view name);

/// Why a name stands for no one unit: "a ton is of 1000 kgf, 2000 lbf or 2240 lbf; ..."; empty of
/// names that are just not known.
std::string ambiguous_unit(std::string_view name);

/// The units of a quantity, for messages: "mm, cm, m ...", one name of each.
std::string units_of(Quantity quantity);

/// All names of the table; of `quantity` or of all quantities.
std::vector<std::string> unit_names(std::optional<Quantity> quantity = {});

} // namespace plyform
