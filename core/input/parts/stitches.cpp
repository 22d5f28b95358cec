// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/parts/stitches.hpp"

#include "base/format.hpp"
#include "core/input/keys/key_member.hpp"
#include "core/input/keys/stitch_keys.hpp"
#include "core/input/parts/yarn_families.hpp"
#include "core/model/ply_frame.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {

namespace {

/// The force over strain of a stitch, with what shifts it. Reports forces that it never has.
StitchLaw read_law(const TableView& section, Diagnostics& diagnostics) {
  StitchLaw law;
  read_members(section, law.tension);
  read_members(section, law);
  read_table(section, "table", law.tension.strain, law.tension.tension, diagnostics);
  if (!law.tension.linear() && !(law.tension.largest_slope() > 0.0))
    value_error(section, "table", "must rise somewhere", "give the stitch a force", diagnostics);
  if (!given(section, "pretension")) return law;
  const double pretension = number(section, "pretension");
  law.taut_at = -law.tension.strain_at(pretension);
  if (std::isinf(law.taut_at))
    value_error(section, "pretension", "must be a force that the table reaches",
                "give less, or a table that goes further", diagnostics);
  if (pretension >= law.breaking_force)
    value_error(section, "pretension", "must be less than the breaking_force",
                "give less pretension, or stitches that bear more", diagnostics);
  return law;
}

/// The names of a stitch table's directions: that of the table, or with _1 and _2 behind it.
std::vector<std::string> names_of(const TableView& section, std::size_t number,
                                  std::size_t directions) {
  std::string name = text(section, "name");
  if (name.empty()) name = stitch_name(number);
  if (directions == 1) return {name};
  return {name + "_1", name + "_2"};
}

/// Reports a name that stands twice, or that gives a column which there is already.
void check_name(const TableView& table, const Fabric& fabric, Diagnostics& diagnostics) {
  const std::string& name = fabric.stitches.back().name;
  const auto is = [&](const auto& other) { return other.name == name; };
  const char* key = given(table, "name") ? "name" : "density";
  const std::string remedy = "give the stitch a name of its own";
  if (std::any_of(fabric.families.begin(), fabric.families.end(), is) ||
      std::any_of(fabric.stitches.begin(), fabric.stitches.end() - 1, is))
    return value_error(table, key,
                       fmt::format("gives this fabric a second family or stitch called {}", name),
                       remedy, diagnostics);
  PlyFrame ply;
  for (const YarnFamily& family : fabric.families)
    ply.families.push_back({family.name, 0.0, {}, {}, {}});
  for (const Stitch& stitch : fabric.stitches)
    ply.stitches.push_back({{stitch.name, 0.0, {}, {}, {}}, {}});
  if (const std::string column = name_used_twice(ply); !column.empty())
    value_error(table, key, fmt::format("would give results two columns of one name, {}", column),
                remedy, diagnostics);
}

/// Reports the stitches that are one too many.
void check_number(const TableView& section, const Fabric& fabric, Diagnostics& diagnostics) {
  const std::size_t all = fabric.families.size() + fabric.stitches.size();
  if (all <= most_families) return;
  value_error(section, "stitch",
              fmt::format("has directions that make {} with the families, and {} are the most", all,
                          most_families),
              "put stitches of one direction together, with the sum of their densities",
              diagnostics);
}

} // namespace

std::string stitch_name(std::size_t number) {
  return number == 0 ? "stitch" : fmt::format("stitch_{}", number + 1);
}

void read_stitches(const TableView& section, Fabric& fabric, Diagnostics& diagnostics) {
  const std::vector<TableView> tables = subsections(section, "stitch");
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const StitchLaw law = read_law(tables[i], diagnostics);
    std::vector<double> angles = numbers(tables[i], "directions");
    if (angles.empty()) angles = {number(tables[i], "direction")};
    const std::vector<std::string> names = names_of(tables[i], i, angles.size());
    for (std::size_t k = 0; k < angles.size(); ++k) {
      fabric.stitches.push_back({names[k], angles[k], number(tables[i], "density"), law});
      const std::size_t before = diagnostics.errors.size();
      check_name(tables[i], fabric, diagnostics);
      if (diagnostics.errors.size() > before) break; // both of a zigzag at once
    }
    constexpr double least = 1e-3; // sine of the angle between them
    if (angles.size() == 2 && !(std::abs(std::sin(angles[1] - angles[0])) > least) &&
        given(tables[i], "directions"))
      value_error(tables[i], "directions", "must not be parallel: they are the legs of a zigzag",
                  "give pattern = \"pillar\" and one direction, or two that differ", diagnostics);
  }
  if (tables.empty()) return;
  if (fabric.families.empty() && is_sound(section, "family"))
    value_error(section, "stitch", "stands in a fabric without yarns",
                "give the [[family]] that it holds, or take it out", diagnostics);
  check_number(section, fabric, diagnostics);
}

} // namespace plyform
