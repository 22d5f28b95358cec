// SPDX-License-Identifier: GPL-3.0-or-later
// Loads of plies: [[load]], its keys and its reading.
#include "base/format.hpp"
#include "base/text.hpp"
#include "core/input/keys/key_member.hpp"
#include "core/input/keys/schema_case.hpp"

#include <algorithm>
#include <array>
#include <optional>

namespace plyform {

namespace {

using K = KeyKind;

constexpr Choice<PlyFace> side_choices[] = {{"above", PlyFace::above}, {"below", PlyFace::below}};
const Range pressure_range{.least = 0.0, .most = 1e4};

constexpr const char* amounts[] = {"pressure", "pressure_programme", "vacuum", "vacuum_programme"};

std::vector<std::string> amounts_but(const std::string& one) {
  std::vector<std::string> others;
  for (const char* other : amounts)
    if (one != other) others.emplace_back(other);
  return others;
}

// N/mm2: in presses and autoclaves; a vacuum cannot be more than an atmosphere.
constexpr double usual_pressure = 10.0, atmosphere = 0.1014;

KeyRow amount_row(const std::string& key, double usual_most, const std::string& meaning) {
  return {.key = "load[]." + key,
          .unit = "N/mm2",
          .instead = amounts_but(key),
          .ranges = {{.least = 0.0, .most = pressure_range.most, .open_least = true}},
          .usual = {{.least = 1e-6, .most = usual_most}},
          .meaning = meaning,
          .members = {to(&PressureLoad::pressure)}};
}

KeyRow programme_row(const std::string& key, double usual_most, const std::string& meaning) {
  return {.key = "load[]." + key,
          .kind = K::pairs,
          .unit = "-, N/mm2",
          .instead = amounts_but(key),
          .ranges = {programme_share, pressure_range},
          .usual = {{.least = 1e-6, .most = 1.0}, {.least = 0.0, .most = usual_most}},
          .least_items = 1,
          .meaning = meaning};
}

/// Index of the ply of that name, or nothing.
std::optional<int> ply_named(const std::string& name, const std::vector<Ply>& plies) {
  const auto it =
      std::find_if(plies.begin(), plies.end(), [&](const Ply& ply) { return ply.name == name; });
  if (it == plies.end()) return std::nullopt;
  return static_cast<int>(it - plies.begin());
}

std::string names_of(const std::vector<Ply>& plies) {
  std::vector<std::string> names;
  for (const Ply& ply : plies)
    names.push_back(ply.name);
  return "give the name of a ply: " + joined(names);
}

PlyFace opposite(PlyFace side) {
  return side == PlyFace::above ? PlyFace::below : PlyFace::above;
}

/// A [[load]] with what is the same for its plies.
struct LoadSection {
  const TableView& section;
  const std::vector<Ply>& plies;
  PressureLoad load;
  bool vacuum;    ///< draws at what it acts on
  bool all_known; ///< the names of plies
  Diagnostics& diagnostics;

  PressureLoad on(int ply, PlyFace side) const {
    PressureLoad one = load;
    one.ply = ply;
    one.side = vacuum ? opposite(side) : side; // air on the other side pushes
    return one;
  }
};

void read_on_face(const LoadSection& s, std::vector<PressureLoad>& loads) {
  const std::optional<int> ply = ply_named(text(s.section, "ply"), s.plies);
  if (given(s.section, "ply") && !ply && s.all_known)
    value_error(s.section, "ply", "names no ply of this case", names_of(s.plies), s.diagnostics);
  loads.push_back(s.on(ply.value_or(0), s.load.side));
}

/// The faces of two plies that look at each other, with all plies that lie between.
void read_between(const LoadSection& s, const TomlNode& between, std::vector<PressureLoad>& loads) {
  std::array<int, 2> ends{};
  for (std::size_t i = 0; i < 2; ++i) {
    const TomlNode& name = between.children[i];
    const std::optional<int> ply = ply_named(name.text, s.plies);
    if (!ply && !s.all_known) return;
    if (!ply)
      return s.diagnostics.error(name.at, fmt::format("{}.between.{}", s.section.item, i),
                                 name.source_text, "names no ply of this case", names_of(s.plies));
    ends[i] = *ply;
  }
  const auto error = [&](const std::string& rule, const std::string& remedy) {
    value_error(s.section, "between", rule, remedy, s.diagnostics);
  };
  if (ends[0] == ends[1])
    return error("names one ply twice, which has nothing between its faces",
                 "give the lowest and the highest ply of what is enclosed");
  const auto height = [&](int ply) { return s.plies[static_cast<std::size_t>(ply)].z; };
  const bool swapped = height(ends[0]) > height(ends[1]) ||
                       (height(ends[0]) == height(ends[1]) && ends[0] > ends[1]);
  const int lower = ends[swapped ? 1 : 0], upper = ends[swapped ? 0 : 1];
  for (const Ply& ply : s.plies) {
    const bool above = ply.z > height(upper);
    if (above || ply.z < height(lower))
      return error(
          fmt::format("leaves out ply {}, which lies {} both", ply.name, above ? "above" : "below"),
          "give the lowest and the highest ply of the stack, which enclose all others");
  }
  loads.push_back(s.on(lower, PlyFace::above));
  loads.push_back(s.on(upper, PlyFace::below));
}

} // namespace

Rows load_rows() {
  return {{.key = "load",
           .kind = K::tables,
           .fallback = "[]",
           .meaning = "loads, one [[load]] each: pressure or vacuum at faces of plies"},
          {.key = "load[].ply",
           .kind = K::text,
           .instead = {"between"},
           .refers = {"ply"},
           .meaning = "name of the ply that it acts on"},
          {.key = "load[].side",
           .kind = K::choice,
           .instead = {"between"},
           .choices = words_of(side_choices),
           .meaning = "face that it acts on, as the ply lies at the start",
           .members = {to(&PressureLoad::side, side_choices)}},
          {.key = "load[].between",
           .kind = K::names,
           .instead = {"ply", "side"},
           .refers = {"ply"},
           .count = 2,
           .meaning =
               "names of the lowest and the highest ply of an enclosed stack: it acts on the "
               "faces of these two that look at each other"},
          amount_row("pressure", usual_pressure,
                     "pressure, which pushes against the face, normal to the surface "
                     "as it deforms; it rises over the duration"),
          programme_row("pressure_programme", usual_pressure,
                        "stages [share of the duration, pressure reached by then]"),
          amount_row("vacuum", atmosphere,
                     "vacuum, by how much the pressure at the face is below that of the air "
                     "around, which pushes on the other face"),
          programme_row("vacuum_programme", atmosphere,
                        "stages [share of the duration, vacuum reached by then]")};
}

void read_loads(const TableView& root, Case& built, Diagnostics& diagnostics) {
  std::size_t entry = 0;
  for (const TableView& section : subsections(root, "load")) {
    const bool vacuum = given(section, "vacuum") || given(section, "vacuum_programme");
    PressureLoad load;
    read_members(section, load);
    load.entry = entry++;
    const char* programme = vacuum ? "vacuum_programme" : "pressure_programme";
    if (given(section, programme)) {
      load.programme = read_programme(section, programme, load.pressure, diagnostics);
      if (load.pressure == 0.0)
        value_error(
            section, programme, fmt::format("has no {} above 0", vacuum ? "vacuum" : "pressure"),
            fmt::format("give it a {}, or take the load out", vacuum ? "vacuum" : "pressure"),
            diagnostics);
    }
    const LoadSection read{section,    built.plies, load, vacuum, knows_names(root, "ply"),
                           diagnostics};
    if (const TomlNode* between = given(section, "between"))
      read_between(read, *between, built.loads);
    else
      read_on_face(read, built.loads);
  }
}

} // namespace plyform
