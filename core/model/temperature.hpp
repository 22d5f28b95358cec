// SPDX-License-Identifier: GPL-3.0-or-later
// How a property of a material depends on temperature: a factor on what it is at a reference, and
// temperatures over the time of a process.
//
//   f     -      the property over that at the reference; f(T_0) = 1
//   T     degC   temperature;  T_0  the reference;  T_K  K, T + 273.15
//   E     J/mol  activation energy of flow;  R  gas constant
//   C_1 -, C_2 K constants of Williams, Landel and Ferry for the reference T_0
//
//   Arrhenius:  f = exp(E/R (1/T_K - 1/T_0K)), of melts well above where they solidify        (1)
//   WLF:        f = 10^(-C_1 (T - T_0) / (C_2 + T - T_0)), up to 100 K above the glass
//               transition                                                                    (2)
//   table:      ln f is the monotone curve (core/model/monotone_curve.hpp) through the
//               logarithms of its points, less its value at T_0                               (3)
//
// (1) is the rate equation of Arrhenius in the form of Eyring (J. Chem. Phys. 4, 1936); (2):
// M. L. Williams, R. F. Landel and J. D. Ferry, J. Am. Chem. Soc. 77 (1955) 3701-3707, with
// C_1 = 8.86 and C_2 = 101.6 K for T_0 = T_g + 50 K, or 17.44 and 51.6 K for T_0 = T_g.
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace plyform {

constexpr double gas_constant = 8.31446261815324; ///< J/(mol K), exact (SI 2019)
constexpr double absolute_zero = -273.15;         ///< degC

struct ArrheniusFactor {
  double energy = 0.0;    ///< E, J/mol
  double reference = 0.0; ///< degC
};

struct WlfFactor {
  double c1 = 0.0, c2 = 0.0; ///< -, K
  double reference = 0.0;    ///< degC
};

struct TableFactor {
  std::vector<double> temperature; ///< degC, ascending, two at least
  std::vector<double> values;      ///< of the property, in any unit, above 0
  double reference = 0.0;          ///< degC, inside the table
};

/// degC; both ends belong to it.
struct TemperatureRange {
  double least = absolute_zero, most = 0.0;
  bool holds(double celsius) const { return celsius >= least && celsius <= most; }
  std::string text() const; ///< "160 to 220 degC"
};

/// (1), (2) or (3); 1 everywhere unless it is made of one of them. Outside its range it stays as at
/// the end, and whoever asks it says so.
class TemperatureFactor {
public:
  TemperatureFactor() = default;
  TemperatureFactor(ArrheniusFactor law) : law_(law) {}
  TemperatureFactor(WlfFactor law) : law_(law) {}
  /// Throws std::invalid_argument unless the table is as TableFactor says.
  TemperatureFactor(TableFactor law);

  double at(double celsius) const;
  /// Where it is known: of (1) and (2) where f is at most a million, as what is colder is a solid;
  /// of (3) the temperatures of the table; of none all.
  TemperatureRange range() const;
  /// Its least and its largest between these temperatures.
  std::pair<double, double> extremes(const TemperatureRange& between) const;
  bool depends() const { return law_.index() != 0; } ///< else it is 1

private:
  struct LogTable {
    std::vector<double> temperature, log_value;
    double log_reference;
  };
  static double log_value_at(const LogTable& table, double celsius);

  std::variant<std::monostate, ArrheniusFactor, WlfFactor, LogTable> law_;
};

/// A temperature that is reached at a time of the process.
struct TemperatureStage {
  double time = 0.0;    ///< s, of the process
  double celsius = 0.0; ///< degC
  bool operator==(const TemperatureStage&) const = default;
};

/// degC at a time (s) of the process, of stages in order of time, at least one: straight from one
/// to the next, and as the first before and as the last after them.
double temperature_at(const std::vector<TemperatureStage>& stages, double time);

} // namespace plyform
