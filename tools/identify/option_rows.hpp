// SPDX-License-Identifier: GPL-3.0-or-later
// Options of the rows of identify_tests.cpp in short.
#pragma once

#include "tools/identify/identify_tests.hpp"

#include <initializer_list>
#include <utility>

namespace plyform::option_rows {

using Kind = TestOption::Kind;
using Place = TestOption::Place;
using Options = std::vector<TestOption>;
using Target = std::function<OptionTarget(IdentifyArguments&)>;

/// A member of the arguments.
template <class Value>
Target at(Value IdentifyArguments::*member) {
  return [member](IdentifyArguments& a) -> OptionTarget { return &(a.*member); };
}

inline Target at(double SpecimenArguments::*member) {
  return [member](IdentifyArguments& a) -> OptionTarget { return &(a.specimen.*member); };
}

inline Target at(ColumnArguments IdentifyArguments::*column, std::string ColumnArguments::*member) {
  return [=](IdentifyArguments& a) -> OptionTarget { return &(a.*column.*member); };
}

inline TestOption number(std::string name, std::string unit, std::string words, Target target) {
  return {std::move(name), Kind::number, std::move(unit), std::move(words), std::move(target)};
}

inline TestOption size(std::string name, std::string unit, std::string words, Target target,
                       bool required = false) {
  TestOption one = number(std::move(name), std::move(unit), std::move(words), std::move(target));
  one.place = Place::size, one.required = required;
  return one;
}

/// Several, with commas between.
inline TestOption numbers(std::string name, std::string unit, std::string words, Target target) {
  return {std::move(name), Kind::numbers, std::move(unit), std::move(words), std::move(target)};
}

inline TestOption text(std::string name, std::string words, Target target) {
  return {std::move(name), Kind::text, "", std::move(words), std::move(target)};
}

inline TestOption choice(std::string name, std::string words, std::vector<std::string> choices,
                         Target target) {
  TestOption one{std::move(name), Kind::choice, "", std::move(words), std::move(target)};
  one.choices = std::move(choices);
  return one;
}

inline TestOption flag(std::string name, std::string words, Target target) {
  return {std::move(name), Kind::flag, "", std::move(words), std::move(target)};
}

/// Curves of specimens of another kind.
inline TestOption files(std::string name, std::string words) {
  return {std::move(name), Kind::files, "", std::move(words), at(&IdentifyArguments::others)};
}

inline TestOption needed(TestOption one) {
  one.required = true;
  return one;
}

/// Above the fold of a page.
inline TestOption above(TestOption one) {
  one.place = Place::size;
  return one;
}

/// Of the command line only.
inline TestOption by_command(TestOption one) {
  one.place = Place::command;
  return one;
}

inline TestOption within(TestOption one, double least, double most) {
  one.least = least, one.most = most;
  return one;
}

inline Options together(std::initializer_list<Options> parts) {
  Options all;
  for (const Options& part : parts)
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// Columns of `x` and `y`.
inline Options columns(const std::string& x, const std::string& y) {
  using A = IdentifyArguments;
  using C = ColumnArguments;
  const std::string column = "name or number of the column of ", unit = "unit of the ";
  return {
      text("x-column", column + x + " [as the header says]", at(&A::x, &C::name)),
      by_command(text("y-column", column + y + " [as the header says]", at(&A::y, &C::name))),
      text("x-unit", unit + x + ", if the header has none or a wrong one", at(&A::x, &C::unit)),
      text("y-unit", unit + y + ", if the header has none or a wrong one", at(&A::y, &C::unit))};
}

/// What it starts from and writes.
inline Options outputs() {
  using A = IdentifyArguments;
  return {by_command(needed(text("fabric", "fabric file with all but the law", at(&A::fabric)))),
          by_command(needed(text("output", "fabric file to write", at(&A::output)))),
          by_command(text("fit", "CSV file of measured and fitted rows [OUTPUT's stem_fit.csv]",
                          at(&A::fit))),
          by_command(text("report",
                          "JSON file of the law, its limits, warnings and mistakes, for programs; "
                          "also written where the curve is refused",
                          at(&A::report))),
          flag("yes-doubtful",
               "go on though the curve shows a disturbance or the law is no fabric's",
               at(&A::doubtful))};
}

/// Range of rows, and what machines add to a curve; `taut`: the unit of the toe.
inline Options corrections(const std::string& range, const std::string& unit,
                           const std::string& taut) {
  using A = IdentifyArguments;
  const auto fit = [](std::string name, Kind kind, std::string of, std::string words, Target to) {
    return TestOption{std::move(name), kind, std::move(of), std::move(words), std::move(to)};
  };
  return {
      number("from", unit, range + " from which rows count [0]", at(&A::from)),
      number("to", unit, range + " up to which rows count", at(&A::to)),
      number("compliance", "mm/N", "by which machine, load cell and clamps give way; 0: none",
             at(&A::compliance)),
      fit("zero", Kind::fit, "N", "load that the cell shows without a load, or fit", at(&A::zero)),
      fit("toe", Kind::fit, taut,
          "extension at which the specimen is taut, or fit: toe compensation", at(&A::toe)),
      fit("slip", Kind::only_fit, "", "fit: takes a sudden slip in the clamps off", at(&A::slip))};
}

inline TestOption direction() {
  return above(needed(choice("direction", "yarns that it is a test of", {"warp", "weft", "both"},
                             at(&IdentifyArguments::direction))));
}

inline TestOption gauge_length() {
  return size("gauge-length", "mm", "if the curve has displacements in the place of strains [1]",
              at(&IdentifyArguments::gauge_length));
}

} // namespace plyform::option_rows
