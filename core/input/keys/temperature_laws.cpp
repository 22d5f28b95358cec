// SPDX-License-Identifier: GPL-3.0-or-later
// How viscosities and elastic shear follow the temperature: keys and their reading.
#include "base/format.hpp"
#include "core/input/keys/key_member.hpp"
#include "core/input/keys/temperature_keys.hpp"

namespace plyform {

namespace {

using K = KeyKind;

KeyRow constant_row(const std::string& table, const std::string& key, const std::string& unit,
                    const Range& usual, const std::string& meaning) {
  return {.key = table + ".viscosity." + key,
          .unit = unit,
          .ranges = {{.least = 0.0, .most = 1e4, .open_least = true}},
          .usual = {usual},
          .meaning = meaning};
}

KeyRow factor_table_row(const std::string& key, const std::string& what) {
  return {.key = key,
          .kind = K::pairs,
          .unit = "degC, -",
          .ranges = {temperature_range, {.least = 1e-9, .most = 1e9}},
          .least_items = 2,
          .meaning = "[temperature, " + what +
                     "], ascending, with the reference inside; a smooth monotone curve through the "
                     "logarithms"};
}

/// The table of such a row; none if it is wrong.
TemperatureFactor read_factor_table(const TableView& section, double reference,
                                    Diagnostics& diagnostics) {
  TableFactor table{{}, {}, reference};
  const std::vector<Vec2> rows = pairs(section, "table");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i > 0 && !(rows[i].x() > rows[i - 1].x())) {
      row_error(section, "table", i, "must be warmer than the row before",
                "put the rows in order, each temperature once", diagnostics);
      return {};
    }
    table.temperature.push_back(rows[i].x()), table.values.push_back(rows[i].y());
  }
  if (rows.size() < 2) return {};
  if (reference < table.temperature.front() || reference > table.temperature.back()) {
    value_error(section, "table",
                fmt::format("goes from {:g} to {:g} degC, without the reference of {:g}",
                            table.temperature.front(), table.temperature.back(), reference),
                "give a reference inside, or more rows", diagnostics);
    return {};
  }
  return table;
}

} // namespace

Rows temperature_law_rows(const std::string& table, const std::string& of,
                          const std::string& what) {
  KeyRow energy = constant_row(table, "activation_energy", "kJ/mol", {.least = 5.0, .most = 300.0},
                               "E of Arrhenius: viscosity goes as exp(E/(R T)), T in K");
  energy.instead = {"c1", "table"};
  KeyRow c1 = constant_row(table, "c1", "-", {.least = 2.0, .most = 40.0},
                           "C1 of Williams, Landel and Ferry for this reference: viscosity goes as "
                           "10^(-C1 (T - T0)/(C2 + T - T0)); 8.86 if that is 50 K above the glass "
                           "transition");
  c1.instead = {"activation_energy", "table"};
  KeyRow c2 =
      constant_row(table, "c2", "K", {.least = 20.0, .most = 300.0}, "C2 of it, beside c1; 101.6");
  c2.otherwise = "none";
  KeyRow by_table = factor_table_row(table + ".viscosity.table", "viscosity in any unit");
  by_table.instead = {"activation_energy", "c1"};
  return {{.key = table,
           .kind = K::table,
           .otherwise = "none: the same at all temperatures",
           .meaning = "how " + of + " on temperature"},
          {.key = table + ".reference",
           .unit = "degC",
           .ranges = {temperature_range},
           .usual = {usual_temperature},
           .meaning = "temperature at which the numbers of the laws hold"},
          {.key = table + ".viscosity", .kind = K::table, .meaning = "factor on " + what},
          energy,
          c1,
          c2,
          by_table};
}

TemperatureFactor read_temperature_law(const TableView& around, Diagnostics& diagnostics) {
  if (!given(around, "reference")) return {};
  const double reference = number(around, "reference");
  const TableView section = subsection(around, "viscosity");
  if (given(section, "activation_energy"))
    return ArrheniusFactor{number(section, "activation_energy"), reference};
  if (given(section, "c1") != nullptr) {
    if (given(section, "c2"))
      return WlfFactor{number(section, "c1"), number(section, "c2"), reference};
    value_error(section, "c1", "needs c2 beside it", "give both constants, of the same reference",
                diagnostics);
    return {};
  }
  if (!given(section, "table")) return {}; // told by the table of keys
  return read_factor_table(section, reference, diagnostics);
}

Rows fabric_temperature_rows() {
  const std::string table = "fabrics.NAME.temperature";
  Rows rows =
      temperature_law_rows(table, "laws of the fabric depend", "viscosities and relaxation times");
  for (KeyRow& row : rows)
    if (row.key == table + ".viscosity") row.otherwise = "none: the same at all temperatures";
  append(rows, {{.key = table + ".shear",
                 .kind = K::table,
                 .otherwise = "none: the same at all temperatures",
                 .meaning = "factor on the elastic torque of shear between families of yarns"},
                factor_table_row(table + ".shear.table", "elastic torque in any unit")});
  return rows;
}

void read_fabric_temperature(const TableView& section, Fabric& fabric, Diagnostics& diagnostics) {
  if (!given(section, "reference")) return;
  fabric.flow_reference = number(section, "reference");
  if (!given(section, "viscosity") && !given(section, "shear"))
    value_error(section, "reference", "has no law beside it",
                "give viscosity or shear, or take the table out", diagnostics);
  fabric.flow = read_temperature_law(section, diagnostics);
  const TableView shear = subsection(section, "shear");
  if (given(shear, "table"))
    fabric.shear_over_temperature = read_factor_table(shear, fabric.flow_reference, diagnostics);
}

} // namespace plyform
