// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/units.hpp"

#include "base/geometry.hpp"

#include <algorithm>
#include <cctype>

namespace plyform {
namespace {

using Q = Quantity;

/// Whether the letters of a name may be capitals or not.
enum class Letters { exact, any };
constexpr Letters exact = Letters::exact, any = Letters::any;

struct NamedUnit {
  std::string_view name;
  Quantity quantity;
  double factor;
  Letters letters;
};

// Sizes: BIPM, The International System of Units (2019); NIST Special Publication 811 (2008),
// appendix B, for inch, pound, ounce, poundal, psi, kip, atm, mmHg (conventional).
constexpr double inch = 25.4, gram_force = 9.80665e-3, pound = 4.4482216152605;

// The first name of each size is the one that messages give.
constexpr NamedUnit units[] = {
    {"mm", Q::length, 1.0, exact},
    {"MM", Q::length, 1.0, exact},
    {"millimeter", Q::length, 1.0, any},
    {"millimetre", Q::length, 1.0, any},
    {"millimeters", Q::length, 1.0, any},
    {"millimetres", Q::length, 1.0, any},
    {"cm", Q::length, 10.0, any},
    {"centimeter", Q::length, 10.0, any},
    {"centimetre", Q::length, 10.0, any},
    {"centimeters", Q::length, 10.0, any},
    {"centimetres", Q::length, 10.0, any},
    {"dm", Q::length, 100.0, any},
    {"m", Q::length, 1000.0, exact},
    {"meter", Q::length, 1000.0, any},
    {"metre", Q::length, 1000.0, any},
    {"meters", Q::length, 1000.0, any},
    {"metres", Q::length, 1000.0, any},
    {"km", Q::length, 1e6, any},
    {"um", Q::length, 1e-3, any},
    {"\xC2\xB5m", Q::length, 1e-3, exact}, // micro sign
    {"\xCE\xBCm", Q::length, 1e-3, exact}, // Greek mu
    {"micron", Q::length, 1e-3, any},
    {"microns", Q::length, 1e-3, any},
    {"micrometer", Q::length, 1e-3, any},
    {"micrometre", Q::length, 1e-3, any},
    {"micrometers", Q::length, 1e-3, any},
    {"micrometres", Q::length, 1e-3, any},
    {"nm", Q::length, 1e-6, exact},
    {"in", Q::length, inch, any},
    {"inch", Q::length, inch, any},
    {"inches", Q::length, inch, any},
    {"zoll", Q::length, inch, any},
    {"\"", Q::length, inch, exact},
    {"ft", Q::length, 304.8, any},
    {"foot", Q::length, 304.8, any},
    {"feet", Q::length, 304.8, any},
    {"yd", Q::length, 914.4, any},
    {"yard", Q::length, 914.4, any},
    {"yards", Q::length, 914.4, any},
    {"mile", Q::length, 1609344.0, any},
    {"miles", Q::length, 1609344.0, any},
    {"mil", Q::length, 1e-3 * inch, any},
    {"mils", Q::length, 1e-3 * inch, any},
    {"thou", Q::length, 1e-3 * inch, any},
    {"uin", Q::length, 1e-6 * inch, any},
    {"microinch", Q::length, 1e-6 * inch, any},
    {"microinches", Q::length, 1e-6 * inch, any},
    {"N", Q::force, 1.0, exact},
    {"newton", Q::force, 1.0, any},
    {"newtons", Q::force, 1.0, any},
    {"kN", Q::force, 1000.0, any},
    {"kilonewton", Q::force, 1000.0, any},
    {"kilonewtons", Q::force, 1000.0, any},
    {"daN", Q::force, 10.0, any},
    {"cN", Q::force, 0.01, any},
    {"mN", Q::force, 1e-3, exact},
    {"millinewton", Q::force, 1e-3, any},
    {"millinewtons", Q::force, 1e-3, any},
    {"uN", Q::force, 1e-6, exact},
    {"dyn", Q::force, 1e-5, any},
    {"dyne", Q::force, 1e-5, any},
    {"dynes", Q::force, 1e-5, any},
    {"gf", Q::force, gram_force, any},
    {"p", Q::force, gram_force, exact},
    {"pond", Q::force, gram_force, any},
    {"gram-force", Q::force, gram_force, any},
    {"kgf", Q::force, 1e3 * gram_force, any},
    {"kp", Q::force, 1e3 * gram_force, any},
    {"kilopond", Q::force, 1e3 * gram_force, any},
    {"kiloponds", Q::force, 1e3 * gram_force, any},
    {"kilogram-force", Q::force, 1e3 * gram_force, any},
    {"tf", Q::force, 1e6 * gram_force, any},
    {"tonne-force", Q::force, 1e6 * gram_force, any},
    {"lbf", Q::force, pound, any},
    {"lb", Q::force, pound, any},
    {"lbs", Q::force, pound, any},
    {"lbsf", Q::force, pound, any},
    {"pound", Q::force, pound, any},
    {"pounds", Q::force, pound, any},
    {"pound-force", Q::force, pound, any},
    {"pounds-force", Q::force, pound, any},
    {"ozf", Q::force, pound / 16.0, any},
    {"oz", Q::force, pound / 16.0, any},
    {"ounce", Q::force, pound / 16.0, any},
    {"ounces", Q::force, pound / 16.0, any},
    {"ounce-force", Q::force, pound / 16.0, any},
    {"kip", Q::force, 1e3 * pound, any},
    {"kips", Q::force, 1e3 * pound, any},
    {"klbf", Q::force, 1e3 * pound, any},
    {"klb", Q::force, 1e3 * pound, any},
    {"pdl", Q::force, 0.138254954376, any},
    {"poundal", Q::force, 0.138254954376, any},
    {"poundals", Q::force, 0.138254954376, any},
    {"deg", Q::angle, degree, any},
    {"degs", Q::angle, degree, any},
    {"degree", Q::angle, degree, any},
    {"degrees", Q::angle, degree, any},
    {"\xC2\xB0", Q::angle, degree, exact}, // degree sign
    {"\xC2\xBA", Q::angle, degree, exact}, // ordinal sign, which is typed for it
    {"altgrad", Q::angle, degree, any},
    {"rad", Q::angle, 1.0, any},
    {"radian", Q::angle, 1.0, any},
    {"radians", Q::angle, 1.0, any},
    {"mrad", Q::angle, 1e-3, exact},
    {"gon", Q::angle, 0.9 * degree, any},
    {"gons", Q::angle, 0.9 * degree, any},
    {"gradian", Q::angle, 0.9 * degree, any},
    {"gradians", Q::angle, 0.9 * degree, any},
    {"neugrad", Q::angle, 0.9 * degree, any},
    {"arcmin", Q::angle, degree / 60.0, any},
    {"arcsec", Q::angle, degree / 3600.0, any},
    {"%", Q::strain, 0.01, exact},
    {"percent", Q::strain, 0.01, any},
    {"pct", Q::strain, 0.01, any},
    {"prozent", Q::strain, 0.01, any},
    {"\xE2\x80\xB0", Q::strain, 1e-3, exact}, // per mille sign
    {"permille", Q::strain, 1e-3, any},
    {"promille", Q::strain, 1e-3, any},
    {"microstrain", Q::strain, 1e-6, any},
    {"ustrain", Q::strain, 1e-6, any},
    {"\xC2\xB5\xCE\xB5", Q::strain, 1e-6, exact},
    {"\xCE\xBC\xCE\xB5", Q::strain, 1e-6, exact},
    {"pli", Q::force_per_length, pound / inch, any},
    {"MPa", Q::stress, 1.0, exact},
    {"MPA", Q::stress, 1.0, exact},
    {"Mpa", Q::stress, 1.0, exact},
    {"megapascal", Q::stress, 1.0, any},
    {"kPa", Q::stress, 1e-3, any},
    {"kilopascal", Q::stress, 1e-3, any},
    {"hPa", Q::stress, 1e-4, any},
    {"Pa", Q::stress, 1e-6, any},
    {"pascal", Q::stress, 1e-6, any},
    {"GPa", Q::stress, 1e3, any},
    {"gigapascal", Q::stress, 1e3, any},
    {"bar", Q::stress, 0.1, any},
    {"bars", Q::stress, 0.1, any},
    {"mbar", Q::stress, 1e-4, exact},
    {"millibar", Q::stress, 1e-4, any},
    {"atm", Q::stress, 0.101325, any},
    {"psi", Q::stress, pound / (inch * inch), any},
    {"ksi", Q::stress, 1e3 * pound / (inch * inch), any},
    {"psf", Q::stress, pound / (144.0 * inch * inch), any},
    {"torr", Q::stress, 0.101325 / 760.0, any},
    {"mmHg", Q::stress, 1.333224e-4, any},
    {"inHg", Q::stress, 3.386389e-3, any},
    {"mmH2O", Q::stress, 9.80665e-6, any},
    {"stretch", Q::stretch, 1.0, any},
    {"s", Q::time, 1.0, exact},
    {"sec", Q::time, 1.0, any},
    {"secs", Q::time, 1.0, any},
    {"second", Q::time, 1.0, any},
    {"seconds", Q::time, 1.0, any},
    {"sek", Q::time, 1.0, any},
    {"ms", Q::time, 1e-3, exact},
    {"msec", Q::time, 1e-3, any},
    {"us", Q::time, 1e-6, exact},
    {"\xC2\xB5s", Q::time, 1e-6, exact},
    {"\xCE\xBCs", Q::time, 1e-6, exact},
    {"min", Q::time, 60.0, any},
    {"mins", Q::time, 60.0, any},
    {"minute", Q::time, 60.0, any},
    {"minutes", Q::time, 60.0, any},
    {"h", Q::time, 3600.0, exact},
    {"hr", Q::time, 3600.0, any},
    {"hrs", Q::time, 3600.0, any},
    {"hour", Q::time, 3600.0, any},
    {"hours", Q::time, 3600.0, any},
    {"day", Q::time, 86400.0, any},
    {"days", Q::time, 86400.0, any},
    {"J", Q::other, 1.0, exact},
    {"mJ", Q::other, 1.0, exact},
    {"kJ", Q::other, 1.0, any},
    {"Nm", Q::other, 1.0, exact},
    {"Nmm", Q::other, 1.0, exact},
    {"kNm", Q::other, 1.0, exact},
    {"g", Q::other, 1.0, exact},
    {"gram", Q::other, 1.0, any},
    {"grams", Q::other, 1.0, any},
    {"kg", Q::other, 1.0, any},
    {"kilogram", Q::other, 1.0, any},
    {"kilograms", Q::other, 1.0, any},
    {"mg", Q::other, 1.0, exact},
    {"V", Q::other, 1.0, exact},
    {"mV", Q::other, 1.0, exact},
    {"volt", Q::other, 1.0, any},
    {"volts", Q::other, 1.0, any},
    {"mA", Q::other, 1.0, exact},
    {"W", Q::other, 1.0, exact},
    {"Hz", Q::other, 1.0, any},
    {"rpm", Q::other, 1.0, any},
    {"C", Q::other, 1.0, exact},
    {"degC", Q::other, 1.0, any},
    {"degF", Q::other, 1.0, any},
    {"\xC2\xB0"
     "C",
     Q::other, 1.0, exact},
    {"\xC2\xB0"
     "F",
     Q::other, 1.0, exact},
    {"K", Q::other, 1.0, exact},
    {"tex", Q::other, 1.0, any},
    {"dtex", Q::other, 1.0, any},
    {"den", Q::other, 1.0, any},
};

struct Doubt {
  std::string_view names, reason;
};

constexpr Doubt doubts[] = {
    {" ton tons tonf tonsf tonne tonnes t ",
     "a ton is of 1000 kgf, 2000 lbf or 2240 lbf: turn the column into kN or tf, 1000 kgf"},
    {" grad grade grads ", "is a degree in German and a gon elsewhere: write deg or gon"},
    {" MN Mm Ms mPa mpa MS MBAR Mbar mn ",
     "m is milli and M mega, and capitals are often not meant: write the unit in full letters or "
     "turn the column into another"}};

char lower(char c) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

bool same_letters(std::string_view a, std::string_view b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(),
                                            [](char x, char y) { return lower(x) == lower(y); });
}

std::optional<Unit> simple_unit(std::string_view name) {
  for (const NamedUnit& unit : units)
    if (unit.name == name) return Unit{unit.quantity, unit.factor};
  for (const NamedUnit& unit : units)
    if (unit.letters == any && same_letters(unit.name, name))
      return Unit{unit.quantity, unit.factor};
  return std::nullopt;
}

/// A unit with a power behind it: "mm2", "in^2", "mm" and a superscript 2.
struct Power {
  Unit unit;
  int power;
};
std::optional<Power> unit_with_power(std::string_view text) {
  int power = 1;
  for (const auto& [mark, value] : {std::pair<std::string_view, int>{"^2", 2},
                                    {"**2", 2},
                                    {"\xC2\xB2", 2},
                                    {"2", 2},
                                    {"^3", 3},
                                    {"\xC2\xB3", 3},
                                    {"3", 3}})
    if (text.size() > mark.size() && text.ends_with(mark)) {
      text.remove_suffix(mark.size());
      power = value;
      break;
    }
  const auto unit = simple_unit(text);
  return unit ? std::optional(Power{*unit, power}) : std::nullopt;
}

/// "N/mm", "kgf/cm2", "mm/m"; other quotients of units that are known are something else.
std::optional<Unit> quotient(std::string_view name) {
  const std::size_t stroke = name.find('/');
  if (stroke == std::string_view::npos) return std::nullopt;
  const std::string_view over = name.substr(0, stroke);
  const auto below = unit_with_power(name.substr(stroke + 1));
  const auto above = unit_with_power(over);
  if (!below || (!above && over != "1")) return std::nullopt;
  if (!above || above->power > 1) return Unit{Q::other, 1.0};
  const Q upper = above->unit.quantity, lower_one = below->unit.quantity;
  const double size = above->unit.factor;
  double per = below->unit.factor;
  if (upper == Q::length && lower_one == Q::length && below->power == 1)
    return Unit{Q::strain, size / per};
  if (upper == Q::force && lower_one == Q::length && below->power < 3) {
    if (below->power == 1) return Unit{Q::force_per_length, size / per};
    per *= below->unit.factor;
    return Unit{Q::stress, size / per};
  }
  return Unit{Q::other, 1.0};
}

/// Products, "N*mm" or "lbf.in", and longer quotients, of units that are known: something else.
bool is_compound(std::string_view name) {
  std::size_t parts = 0;
  while (!name.empty()) {
    const std::size_t end = std::min(name.find_first_of("/*.-"), name.size());
    std::string_view part = name.substr(0, end);
    name.remove_prefix(std::min(end + 1, name.size()));
    if (part != "1" && !unit_with_power(part)) return false;
    ++parts;
  }
  return parts > 1;
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
  if (name.empty()) return std::nullopt;
  if (const auto unit = simple_unit(name)) return unit;
  if (const auto unit = quotient(name)) return unit;
  if (is_compound(name)) return Unit{Q::other, 1.0};
  return std::nullopt;
}

std::string ambiguous_unit(std::string_view name) {
  const auto stands_in = [](std::string_view names, const std::string& word) {
    return names.find(" " + word + " ") != std::string_view::npos;
  };
  std::string word(name);
  if (find_unit(word)) return "";
  for (const Doubt& doubt : doubts)
    if (stands_in(doubt.names, word)) return std::string(doubt.reason);
  std::transform(word.begin(), word.end(), word.begin(), lower);
  for (const Doubt& doubt : {doubts[0], doubts[1]})
    if (stands_in(doubt.names, word)) return std::string(doubt.reason);
  return "";
}

std::string units_of(Quantity quantity) {
  std::string names;
  std::vector<double> listed;
  for (const NamedUnit& unit : units) {
    if (unit.quantity != quantity ||
        std::find(listed.begin(), listed.end(), unit.factor) != listed.end())
      continue;
    listed.push_back(unit.factor);
    names += (names.empty() ? "" : ", ") + std::string(unit.name);
  }
  const auto add = [&names](const std::string& more) {
    names += (names.empty() ? "" : ", ") + more;
  };
  if (quantity == Q::strain) add("mm/mm, in/in, mm/m ...");
  if (quantity == Q::force_per_length) add("N/mm, N/m, kN/m, kgf/cm, lbf/in ...");
  if (quantity == Q::stress) add("N/mm2, kgf/cm2, lbf/in2 ...");
  return names;
}

std::vector<std::string> unit_names(std::optional<Quantity> quantity) {
  std::vector<std::string> names;
  for (const NamedUnit& unit : units)
    if (!quantity || unit.quantity == *quantity) names.emplace_back(unit.name);
  return names;
}

} // namespace plyform
