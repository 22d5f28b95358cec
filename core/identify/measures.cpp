// SPDX-License-Identifier: GPL-3.0-or-later
// Measures that words of a header name and no test takes: column_meaning.hpp.
#include "core/identify/column_meaning.hpp"

#include <algorithm>

namespace plyform {
namespace {

using Q = Quantity;

/// A measure: the column's quantity, words of which its name has one, words of which it has one too
/// (or none are needed), words of which it has none; what it is and what to do.
struct NamedMeasure {
  Quantity quantity;
  std::string_view words, also, but;
  std::string_view is, remedy;
};

// l: stretch, e: the strain in the column, g: the shear angle.
constexpr NamedMeasure measures[] = {
    {Q::stress, "true cauchy kirchhoff", "", "piola",
     "a true stress, force over the section as it is",
     "divide it by the stretch, as the section of rubber keeps its volume, and call it nominal "
     "stress"},
    {Q::stress, "piola pk2", "second 2nd ii pk2", "", "a second Piola-Kirchhoff stress",
     "multiply it by the stretch, and call it nominal stress"},
    {Q::stress, "shear", "", "", "a shear stress", "give the stress along the pull"},
    {Q::strain, "true log logarithmic ln natural hencky", "", "", "a logarithmic strain",
     "turn it into exp(e) - 1, and call it engineering strain"},
    {Q::strain, "green lagrange lagrangian", "", "", "a Green-Lagrange strain",
     "turn it into sqrt(1 + 2 e) - 1, and call it engineering strain"},
    {Q::strain, "almansi euler eulerian", "", "", "an Almansi strain",
     "turn it into 1 / sqrt(1 - 2 e) - 1, and call it engineering strain"},
    {Q::strain, "shear gamma", "", "", "a shear strain", "give the strain along the load"},
    {Q::strain, "transverse lateral volumetric volume plastic", "", "",
     "not the strain along the load", "give the column of the strain along the load"},
    {Q::angle, "half", "", "", "half of an angle", "double it"},
    {Q::angle, "double twice", "", "", "twice an angle", "halve it"},
    {Q::angle, "tan tangent sin cos slope", "", "", "the tangent, or a function of an angle",
     "give the angle itself"},
    {Q::force, "normalised normalized specific", "", "",
     "a normalised force in the unit of a force", "give the load as measured"},
    {Q::length, "width thickness diameter", "", "displacement extension elongation deflection",
     "a size of the specimen", "give the column by its name"},
    {Q::unknown, "log log10 lg ln sqrt squared square", "", "", "a function of what is wanted",
     "give the numbers themselves"},
    {Q::unknown, "rate velocity", "", "", "a rate", "give the numbers themselves"},
    {Q::length, "normalised normalized", "", "", "normalised", "give the numbers as measured"},
    {Q::time, "normalised normalized", "", "", "normalised", "give the numbers as measured"},
};

constexpr NamedMeasure shear_angles[] = {
    {Q::angle,
     "between included enclosed inter interyarn interfibre interfiber yarn yarns fibre fibres "
     "fiber "
     "fibers tow tows frame corner opening",
     "", "shear gamma \xCE\xB3 change", "an angle between the yarns, or of the frame",
     "give the shear angle, by which the angle between the yarns has changed: 90 degrees less "
     "that"},
};

constexpr NamedMeasure overhangs[] = {
    {Q::length, "bending", "", "",
     "a bending length, half of the overhang where the tip lies 41.5 degrees below the edge",
     "double it, and call it overhang"},
};

constexpr NamedMeasure frame_loads[] = {
    {Q::force, "shear", "", "", "a shear force, along the sides of the frame",
     "give the load of the machine, of a frame 2 cos(45 deg - g/2) times that, g the shear angle"},
};

bool says(const NamedMeasure& measure, const std::string& name, Quantity quantity) {
  const auto has = [&name](std::string_view words) { return has_word(name, std::string(words)); };
  return (measure.quantity == quantity || measure.quantity == Q::unknown) && has(measure.words) &&
         (measure.also.empty() || has(measure.also)) && !has(measure.but);
}

template <std::size_t n>
std::optional<OtherMeasure> first_of(const NamedMeasure (&list)[n], const std::string& name,
                                     Quantity quantity) {
  const auto* found = std::find_if(std::begin(list), std::end(list), [&](const NamedMeasure& one) {
    return says(one, name, quantity);
  });
  if (found == std::end(list)) return std::nullopt;
  return OtherMeasure{std::string(found->is), std::string(found->remedy)};
}

} // namespace

std::optional<OtherMeasure> other_measure(const std::string& name, Quantity quantity,
                                          const std::string& wanted) {
  if (wanted == "thickness or fibre volume") return std::nullopt; // what others are not to be
  if (const auto found = first_of(measures, name, quantity)) return found;
  if (wanted == "shear angle") return first_of(shear_angles, name, quantity);
  if (wanted == "overhang") return first_of(overhangs, name, quantity);
  if (wanted == "load of the frame") return first_of(frame_loads, name, quantity);
  return std::nullopt;
}

} // namespace plyform
