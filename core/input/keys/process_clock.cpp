// SPDX-License-Identifier: GPL-3.0-or-later
// The clock of the process: [process].
#include "base/format.hpp"
#include "core/input/keys/key_member.hpp"
#include "core/input/keys/schema_case.hpp"
#include "core/input/keys/temperature_keys.hpp"
#include "core/model/yarn_law.hpp"

#include <algorithm>

namespace plyform {

Rows process_rows() {
  Rows rows{{.key = "process",
             .kind = KeyKind::table,
             .fallback = "{}",
             .meaning = "the real process, of which the simulation is a faster one"},
            {.key = "process.duration",
             .unit = "s",
             .otherwise = "not known; fabrics whose laws have rates, and cooling, need it",
             .ranges = {{.least = 1e-6, .most = 1e9}},
             .usual = {{.least = 0.1, .most = 1e5}},
             .meaning =
                 "time that the stroke takes in the real process, by which rates of materials "
                 "go; solver.duration is what is simulated of it",
             .members = {to(&ProcessOptions::duration)}}};
  append(rows, process_temperature_rows());
  return rows;
}

namespace {

/// A law of friction with rates that bodies of the case have, or null.
const FrictionLaw* rated_friction(const Case& built) {
  for (const int law : built.friction.law)
    if (law >= 0 && built.friction_laws[static_cast<std::size_t>(law)]->has_rates())
      return built.friction_laws[static_cast<std::size_t>(law)].get();
  return nullptr;
}

} // namespace

void check_clock(const TableView& root, const Case& built, bool (*rated)(const Fabric&),
                 Diagnostics& diagnostics) {
  const TableView process = subsection(root, "process");
  const auto fabric = std::find_if(built.fabrics.begin(), built.fabrics.end(), rated);
  const FrictionLaw* friction = rated_friction(built);
  const bool any = fabric != built.fabrics.end() || friction;
  if (const TomlNode* duration = given(process, "duration");
      duration && !any && !built.process.cooling)
    diagnostics.warning(duration->at,
                        fmt::format("process.duration = {}: does nothing, as no law of these "
                                    "fabrics depends on rates, nor any of friction",
                                    duration->source_text));
  if (!built.process.duration && any)
    diagnostics.error(
        root.entry->at, "process.duration", "",
        friction ? fmt::format("is missing, and friction.{} depends on the slip "
                               "speed",
                               friction->spec().name)
                 : fmt::format("is missing, and laws of fabric {} depend on rates", fabric->name),
        "give [process] a duration, the seconds that the real stroke takes");
}

void read_process(const TableView& root, Case& built, Diagnostics& diagnostics) {
  read_members(subsection(root, "process"), built.process);
  read_temperatures(root, built, diagnostics);
}

void check_process(const TableView& root, const Case& built, Diagnostics& diagnostics) {
  check_temperatures(root, built, diagnostics);
  check_clock(root, built, has_rates, diagnostics);
}

} // namespace plyform
