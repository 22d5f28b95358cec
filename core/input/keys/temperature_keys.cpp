// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/keys/temperature_keys.hpp"

#include "base/format.hpp"
#include "core/input/keys/key_member.hpp"
#include "core/model/reachable_temperature.hpp"
#include "core/model/yarn_law.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {

namespace {

using K = KeyKind;

KeyRow temperature_row(const std::string& key, const std::string& meaning) {
  return {.key = key,
          .unit = "degC",
          .ranges = {temperature_range},
          .usual = {usual_temperature},
          .meaning = meaning};
}

KeyRow course_row(const std::string& key, const std::string& of) {
  return {.key = key,
          .kind = K::pairs,
          .unit = "s, degC",
          .ranges = {{.least = 0.0, .most = 1e9}, temperature_range},
          .usual = {{.least = 0.0, .most = 1e5}, usual_temperature},
          .least_items = 1,
          .meaning = "[time of the process, temperature of " + of +
                     " then], straight from one to the next, and constant before and after"};
}

KeyRow conductance_row(const std::string& key, double most_usual, const std::string& meaning) {
  return {.key = "process.cooling." + key,
          .unit = "W/(m2 K)",
          .ranges = {{.least = 0.0, .most = 1e7}},
          .usual = {{.least = 0.0, .most = most_usual}},
          .meaning = meaning};
}

/// Stages of a programme; reports those that are not in order of time.
std::vector<TemperatureStage> read_stages(const TableView& section, const std::string& key,
                                          Diagnostics& diagnostics) {
  std::vector<TemperatureStage> stages;
  for (const Vec2& row : pairs(section, key)) {
    if (!stages.empty() && row.x() <= stages.back().time) {
      value_error(section, key,
                  fmt::format("has row {} at {:g} s after one at {:g} s", stages.size() + 1,
                              row.x(), stages.back().time),
                  "give the rows in order of time", diagnostics);
      break;
    }
    stages.push_back({row.x(), row.y()});
  }
  return stages;
}

/// One temperature or a programme of it; empty if neither is given.
std::vector<TemperatureStage> read_course(const TableView& section, const std::string& key,
                                          Diagnostics& diagnostics) {
  if (given(section, key)) return {{0.0, number(section, key)}};
  return read_stages(section, key + "_programme", diagnostics);
}

/// Whether every ply has a temperature, if any has: reports those that have none.
void check_all_plies(const TableView& root, const Case& built, Diagnostics& diagnostics) {
  if (!has_temperature(built)) return;
  const std::vector<TableView> sections = subsections(root, "ply");
  for (std::size_t p = 0; p < sections.size() && p < built.plies.size(); ++p)
    if (!start_temperature(built, built.plies[p]))
      diagnostics.error(sections[p].entry ? sections[p].entry->at : root.entry->at,
                        item_of(sections[p], "temperature"), "",
                        "is missing, and other plies have one",
                        "give it, or [process] a temperature, that of all that have none");
}

/// What cooling needs of the rest of the case.
void check_cooling(const TableView& root, const TableView& section, const Case& built,
                   Diagnostics& diagnostics) {
  const auto missing = [&](const Place& at, const std::string& item, const std::string& rule,
                           const std::string& remedy) {
    diagnostics.error(at, item, "", "is missing, " + rule, remedy);
  };
  const Place& here = section.entry->at;
  if (!has_temperature(built))
    missing(here, "process.temperature", "from which plies cool",
            "give it, the temperature of the plies at the start");
  if (!built.process.duration)
    missing(here, "process.duration", "the time that plies have to cool in",
            "give [process] a duration, the seconds that the real stroke takes");
  for (const Ply& ply : built.plies) {
    const auto fabric = static_cast<std::size_t>(ply.fabric);
    if (fabric >= built.fabrics.size() || built.fabrics[fabric].heat_capacity) continue;
    missing(here, fmt::format("fabrics.{}.heat_capacity", built.fabrics[fabric].name),
            fmt::format("without which nobody knows how fast ply {} cools", ply.name),
            fmt::format("give it in fabric {}, 0.9 to 1.8 J/(g K) of prepregs",
                        built.fabrics[fabric].name));
    break;
  }
  if (!(built.process.cooling->to_tools > 0.0)) return;
  const std::vector<TableView> tools = subsections(root, "tool");
  for (std::size_t t = 0; t < tools.size() && t < built.tools.size(); ++t)
    if (built.tools[t].temperature.empty() && !given(tools[t], "temperature_programme"))
      missing(tools[t].entry ? tools[t].entry->at : here, item_of(tools[t], "temperature"),
              "and plies give it their heat", "give the tool a temperature");
}

/// Reports a start outside of what a law of the ply's fabric is known for, where it is given.
void check_start(const TableView& root, const TableView& ply, const Fabric& fabric,
                 const LawOverTemperature& law, double celsius, Diagnostics& diagnostics) {
  const TemperatureRange known = law.factor.range();
  if (known.holds(celsius)) return;
  const TableView section = given(ply, "temperature") ? ply : subsection(root, "process");
  value_error(section, "temperature",
              fmt::format("is outside of what the {} of fabric {} is known for, {}", law.of,
                          fabric.name, known.text()),
              "give a temperature inside, or a law that reaches it", diagnostics);
}

/// Warns of laws over temperature that have nothing to act on.
void check_use(const TableView& root, const Case& built, Diagnostics& diagnostics) {
  const std::vector<TableView> sections = subsections(root, "fabrics");
  for (std::size_t f = 0; f < sections.size() && f < built.fabrics.size(); ++f) {
    const Fabric& fabric = built.fabrics[f];
    const TomlNode* table = given(sections[f], "temperature");
    if (!table) continue;
    const auto warn = [&](const std::string& of, const std::string& why) {
      diagnostics.warning(
          table->at, fmt::format("{} of fabric {}: does nothing, as {}", of, fabric.name, why));
    };
    const bool shear = fabric.shear_over_temperature.depends();
    if (fabric.flow.depends() && !has_rates(fabric))
      warn(shear ? "temperature.viscosity" : "temperature", "no law of it depends on rates");
    if (shear && fabric.crossings.empty())
      warn("temperature.shear", "it has no law of shear between two families of yarns");
  }
}

/// Warns of a ply that may leave what a law of its fabric is known for.
void check_reach(const TableView& ply, const Ply& of, const Fabric& fabric,
                 const LawOverTemperature& law, const TemperatureRange& may, double celsius,
                 Diagnostics& diagnostics) {
  const TemperatureRange known = law.factor.range();
  if (!known.holds(celsius) || (known.holds(may.least) && known.holds(may.most))) return;
  diagnostics.warning(
      ply.entry->at,
      fmt::format("ply {} may come to {:.4g} to {:.4g} degC, and the {} of fabric {} is known for "
                  "{}: beyond, it stays as at the end",
                  of.name, may.least, may.most, law.of, fabric.name, known.text()));
}

/// What laws that depend on temperature need of the case. To be called when all else was read.
void check_laws(const TableView& root, const Case& built, Diagnostics& diagnostics) {
  const std::vector<TableView> sections = subsections(root, "ply");
  for (std::size_t p = 0; p < built.plies.size() && p < sections.size(); ++p) {
    const auto index = static_cast<std::size_t>(built.plies[p].fabric);
    if (index >= built.fabrics.size()) continue;
    const Fabric& fabric = built.fabrics[index];
    const auto laws = laws_over_temperature(fabric);
    if (std::none_of(laws.begin(), laws.end(),
                     [](const LawOverTemperature& law) { return law.factor.depends(); }))
      continue;
    const auto celsius = start_temperature(built, built.plies[p]);
    if (!celsius && has_temperature(built)) continue; // told
    if (!celsius)
      return diagnostics.error(
          root.entry->at, "process.temperature", "",
          fmt::format("is missing, and laws of fabric {} depend on it", fabric.name),
          "give [process] a temperature, degC");
    const TemperatureRange may = *reachable_temperatures(built, built.plies[p]);
    for (const LawOverTemperature& law : laws) {
      if (!law.factor.depends()) continue;
      check_start(root, sections[p], fabric, law, *celsius, diagnostics);
      check_reach(sections[p], built.plies[p], fabric, law, may, *celsius, diagnostics);
    }
  }
}

} // namespace

Rows ply_temperature_rows() {
  KeyRow row = temperature_row("ply[].temperature", "temperature of the ply, at the start if it "
                                                    "cools");
  row.otherwise = "that of process.temperature";
  row.members = {to(&Ply::temperature)};
  return {row};
}

Rows tool_temperature_rows() {
  KeyRow one = temperature_row("tool[].temperature", "temperature of the tool"),
         programme = course_row("tool[].temperature_programme", "the tool");
  one.instead = {"temperature_programme"}, programme.instead = {"temperature"};
  one.otherwise = programme.otherwise = "that of process.temperature";
  return {one, programme};
}

Rows heat_capacity_rows() {
  return {{.key = "fabrics.NAME.heat_capacity",
           .unit = "J/(g K)",
           .otherwise = "not known; needed by process.cooling",
           .ranges = {{.least = 0.01, .most = 100.0}},
           .usual = {{.least = 0.4, .most = 4.5}},
           .meaning = "specific heat capacity of the ply, fibres with matrix",
           .members = {to(&Fabric::heat_capacity)}}};
}

Rows process_temperature_rows() {
  KeyRow all = temperature_row("process.temperature",
                               "temperature of all plies and tools that have none of their own");
  all.otherwise = "not known";
  all.members = {to(&ProcessOptions::temperature)};
  KeyRow one = temperature_row("process.cooling.surroundings", "temperature of the air around"),
         programme = course_row("process.cooling.surroundings_programme", "the air around");
  one.instead = {"surroundings_programme"}, programme.instead = {"surroundings"};
  const std::string half = "; half of the ply's own resistance is in it";
  KeyRow plies = conductance_row("ply_conductance", 1e4,
                                 "conductance between the faces of two plies that touch" + half);
  plies.fallback = "0.0";
  plies.members = {to(&Cooling::to_plies)};
  KeyRow tools = conductance_row("tool_conductance", 1e4,
                                 "conductance of a ply's face to a tool that it touches" + half);
  tools.members = {to(&Cooling::to_tools)};
  KeyRow air = conductance_row("air_conductance", 200.0,
                               "conductance of a face that touches nothing to the air, radiation "
                               "included");
  air.members = {to(&Cooling::to_air)};
  return {all,
          {.key = "process.cooling",
           .kind = K::table,
           .otherwise = "none: plies keep their temperatures",
           .meaning = "cooling or heating of plies by tools, air and each other, over the time of "
                      "the process; each place of a ply has one temperature through its thickness, "
                      "and nothing flows within its plane"},
          tools,
          air,
          plies,
          one,
          programme};
}

void read_temperatures(const TableView& root, Case& built, Diagnostics& diagnostics) {
  const std::vector<TableView> tools = subsections(root, "tool");
  for (std::size_t t = 0; t < tools.size() && t < built.tools.size(); ++t)
    built.tools[t].temperature = read_course(tools[t], "temperature", diagnostics);
  const TableView section = subsection(subsection(root, "process"), "cooling");
  if (!section.entry) return;
  Cooling& cooling = built.process.cooling.emplace();
  read_members(section, cooling);
  cooling.surroundings = read_course(section, "surroundings", diagnostics);
}

void check_temperatures(const TableView& root, const Case& built, Diagnostics& diagnostics) {
  check_all_plies(root, built, diagnostics);
  const TableView section = subsection(subsection(root, "process"), "cooling");
  if (section.entry) check_cooling(root, section, built, diagnostics);
  check_use(root, built, diagnostics);
  check_laws(root, built, diagnostics);
  check_films(root, built, diagnostics);
}

} // namespace plyform
