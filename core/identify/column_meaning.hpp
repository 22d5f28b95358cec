// SPDX-License-Identifier: GPL-3.0-or-later
// What a column of a curve is, from its header: "Load (kN)", "Extension [mm]", "F / N", "force_N",
// "shear angle in deg", or a second header row with the units. A unit decides; without one the
// words of the name do ("Crosshead travel" is a length). Units are those of base/units.hpp; of what
// stands where a unit does and is none of them, nothing is guessed: the column is refused.
//
// Words also say of which measure a column is: a true stress is no nominal one.
#pragma once

#include "base/units.hpp"

#include <optional>
#include <string>

namespace plyform {

struct ColumnMeaning {
  Quantity quantity = Quantity::unknown;
  double factor = 1.0;
  std::string unit;              ///< as written; empty: none, and factor is that of usual_factor
  std::string unknown_unit = {}; ///< what stands in the place of a unit and is none that is known
};

/// Of numbers without a unit: mm, N, degrees, 1.
double usual_factor(Quantity quantity);
/// "mm" where a column is taken as such without its unit being written; empty of strains.
std::string usual_unit(Quantity quantity);

/// Of a column with this name, and what stands below it in a row of units (or empty).
ColumnMeaning meaning_of(const std::string& name, const std::string& unit_below);

/// Whether a text of a second header row may be a unit: one word that says nothing else.
bool may_be_unit(const std::string& text);

/// Whether a name contains one of the words (English, lower case) as a whole word.
bool has_word(const std::string& name, const std::string& words);

/// What a column is by its words in the place of what tests take, and what to do with it.
struct OtherMeasure {
  std::string is;     ///< "a true stress, force over the section as it is"
  std::string remedy; ///< "divide it by the stretch, and call it nominal stress"
};

/// Of a column of this quantity whose name says that it is another measure; `wanted` ("overhang"):
/// what the test takes it for. Nothing where the name says nothing against it.
std::optional<OtherMeasure> other_measure(const std::string& name, Quantity quantity,
                                          const std::string& wanted);

} // namespace plyform
