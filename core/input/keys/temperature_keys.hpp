// SPDX-License-Identifier: GPL-3.0-or-later
// Keys of temperatures, of cooling, and of how a law depends on temperature.
#pragma once

#include "core/input/keys/schema_case.hpp"
#include "core/model/temperature.hpp"

namespace plyform {

/// degC
inline const Range temperature_range{.least = -270.0, .most = 3000.0};
inline const Range usual_temperature{.least = -50.0, .most = 450.0};

Rows ply_temperature_rows();
Rows tool_temperature_rows();
Rows heat_capacity_rows();
/// core/input/keys/temperature_laws.cpp: a table TABLE with a reference, and within it what follows
/// it: fabrics.NAME.temperature, friction.NAME.temperature. of: "laws of the fabric depend"; what:
/// the factor acts on, "viscosities".
Rows temperature_law_rows(const std::string& table, const std::string& of, const std::string& what);
/// Reads the law in `section`, TABLE; none if it is not given or wrong.
TemperatureFactor read_temperature_law(const TableView& section, Diagnostics& diagnostics);
/// The same of fabrics, fabrics.NAME.temperature, whose elastic shear may follow it too: of
/// viscosity and shear at least one.
Rows fabric_temperature_rows();
void read_fabric_temperature(const TableView& section, Fabric& fabric, Diagnostics& diagnostics);
/// process.temperature and process.cooling.
Rows process_temperature_rows();

/// Reads what these rows are of the case whose fabrics, plies, tools and other keys of [process]
/// have been read.
void read_temperatures(const TableView& root, Case& built, Diagnostics& diagnostics);
/// Checks what they need of the rest of a case without mistakes.
void check_temperatures(const TableView& root, const Case& built, Diagnostics& diagnostics);
/// core/input/keys/film_temperature.cpp: what laws of friction over temperature need of such a
/// case.
void check_films(const TableView& root, const Case& built, Diagnostics& diagnostics);

} // namespace plyform
