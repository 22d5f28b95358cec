// SPDX-License-Identifier: GPL-3.0-or-later
// Loads of plies: [[load]], its keys and its reading.
#include "base/text.hpp"
#include "core/input/keys/key_member.hpp"
#include "core/input/keys/schema_case.hpp"

#include <algorithm>

namespace plyform {

namespace {

using K = KeyKind;

constexpr Choice<PlyFace> side_choices[] = {{"above", PlyFace::above}, {"below", PlyFace::below}};
const Range pressure_range{.least = 0.0, .most = 1e4};

int read_ply(const TableView& section, const std::vector<Ply>& plies, Diagnostics& diagnostics) {
  const auto it = std::find_if(plies.begin(), plies.end(),
                               [&](const Ply& ply) { return ply.name == text(section, "ply"); });
  if (it != plies.end()) return static_cast<int>(it - plies.begin());
  std::vector<std::string> names;
  for (const Ply& ply : plies)
    names.push_back(ply.name);
  if (given(section, "ply"))
    value_error(section, "ply", "names no ply of this case",
                "give the name of a ply: " + joined(names), diagnostics);
  return 0;
}

} // namespace

Rows load_rows() {
  return {{.key = "load",
           .kind = K::tables,
           .fallback = "[]",
           .meaning = "loads, one [[load]] each: pressures on faces of plies"},
          {.key = "load[].ply", .kind = K::text, .meaning = "name of the ply that it acts on"},
          {.key = "load[].side",
           .kind = K::choice,
           .choices = words_of(side_choices),
           .meaning = "face that it acts on and pushes against, as the ply lies at the start",
           .members = {to(&PressureLoad::side, side_choices)}},
          {.key = "load[].pressure",
           .unit = "N/mm2",
           .instead = {"pressure_programme"},
           .ranges = {{.least = 0.0, .most = pressure_range.most, .open_least = true}},
           .usual = {{.least = 1e-6, .most = 10.0}},
           .meaning = "pressure, normal to the surface as it deforms; it rises over the duration",
           .members = {to(&PressureLoad::pressure)}},
          {.key = "load[].pressure_programme",
           .kind = K::pairs,
           .unit = "-, N/mm2",
           .instead = {"pressure"},
           .ranges = {programme_share, pressure_range},
           .least_items = 1,
           .meaning = "stages [share of the duration, pressure reached by then]"}};
}

void read_loads(const TableView& root, Case& built, Diagnostics& diagnostics) {
  const char* programme = "pressure_programme";
  for (const TableView& section : subsections(root, "load")) {
    PressureLoad load;
    read_members(section, load);
    load.ply = read_ply(section, built.plies, diagnostics);
    if (given(section, programme)) {
      load.programme = read_programme(section, programme, load.pressure, diagnostics);
      if (load.pressure == 0.0)
        value_error(section, programme, "has no pressure above 0",
                    "give it a pressure, or take the load out", diagnostics);
    }
    built.loads.push_back(load);
  }
}

} // namespace plyform
