// SPDX-License-Identifier: GPL-3.0-or-later
// case.toml -> entries -> overrides -> check against the table of keys -> Case -> whole scene.
#include "core/input/case_file.hpp"

#include "base/format.hpp"
#include "base/text.hpp"
#include "core/input/checks/scene_checks.hpp"
#include "core/input/checks/sense_checks.hpp"
#include "core/input/keys/case_identity.hpp"
#include "core/input/keys/entries.hpp"
#include "core/input/keys/given_values.hpp"
#include "core/input/keys/key_member.hpp"
#include "core/input/keys/overrides.hpp"
#include "core/input/keys/schema_case.hpp"
#include "core/input/parts/case_parts.hpp"
#include "core/model/fabric_estimates.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

namespace plyform {

namespace {

using Numbers = std::map<std::string, int>; ///< index by name

/// Names of the tables of a map, with their numbers in the order of the file.
Numbers names_of(const TableView& root, const std::string& key) {
  Numbers names;
  for (const TableView& section : subsections(root, key))
    names.emplace(section.item.substr(key.size() + 1), static_cast<int>(names.size()));
  return names;
}

std::string known_names(const Numbers& names) {
  std::vector<std::string> words;
  for (const auto& [name, index] : names)
    words.push_back(name);
  return words.empty() ? "there are none" : "there are " + joined(words);
}

/// The number of the part that a key names; reports an error and returns 0 if there is none.
/// all_known: whether all names are.
int named_part(const TableView& section, const std::string& key, const Numbers& names,
               bool all_known, Diagnostics& diagnostics) {
  const auto it = names.find(text(section, key));
  if (it != names.end()) return it->second;
  if (all_known && given(section, key))
    value_error(section, key, "names no " + key + " of this case", known_names(names), diagnostics);
  return 0;
}

std::vector<Ply> read_plies(const TableView& root, const std::vector<Fabric>& fabrics,
                            Diagnostics& diagnostics) {
  const Numbers fabric_names = names_of(root, "fabrics"), blank_names = names_of(root, "blanks");
  const bool know_fabrics = knows_names(root, "fabrics"), know_blanks = knows_names(root, "blanks");
  double top = number(subsection(root, "stack"), "bottom");
  std::vector<Ply> plies;
  for (const TableView& section : subsections(root, "ply")) {
    Ply ply;
    read_members(section, ply);
    if (given(section, "seed")) ply.seed = vector2(section, "seed");
    ply.fabric = named_part(section, "fabric", fabric_names, know_fabrics, diagnostics);
    ply.blank = named_part(section, "blank", blank_names, know_blanks, diagnostics);
    const std::size_t fabric = static_cast<std::size_t>(ply.fabric);
    const double thickness = fabric < fabrics.size() ? fabrics[fabric].thickness : 0.0;
    ply.z = given(section, "z") ? number(section, "z") : top + 0.5 * thickness;
    // A sum of thicknesses, not z + t/2: n equal plies then are n t high up to very little
    // rounding.
    top = given(section, "z") ? ply.z + 0.5 * thickness : top + thickness;
    plies.push_back(ply);
  }
  return plies;
}

/// Numbers of the bodies by name: plies, then tools, then boundaries (which have no contact).
/// Reports names that are used twice.
Numbers number_bodies(const TableView& root, Diagnostics& diagnostics) {
  Numbers bodies;
  int count = 0;
  for (const char* key : {"ply", "tool", "boundary"})
    for (const TableView& section : subsections(root, key)) {
      const std::string name = text(section, "name");
      const int body = count++;
      if (name.empty()) continue;
      if (name == "plies" || name == "tools") // in contact.pair
        value_error(section, "name", "stands for all " + name, "choose another name", diagnostics);
      else if (!bodies.emplace(name, body).second)
        value_error(section, "name", "is the name of another ply, tool or boundary too",
                    "give each of them a name of its own", diagnostics);
    }
  return bodies;
}

/// What the names of a case's bodies stand for.
struct NamedBodies {
  Numbers bodies; ///< plies, then tools
  int plies, count;
  bool all_known; ///< the names
};

/// The bodies that one name of a contact pair denotes.
std::vector<int> bodies_named(const TomlNode& name, const std::string& item,
                              const NamedBodies& named, Diagnostics& diagnostics) {
  const auto& [bodies, plies, count, all_known] = named;
  std::vector<int> found;
  const bool all_plies = name.text == "plies", all_tools = name.text == "tools";
  if (all_plies || all_tools) {
    for (int body = all_plies ? 0 : plies; body < (all_plies ? plies : count); ++body)
      found.push_back(body);
  } else if (const auto it = bodies.find(name.text); it != bodies.end()) {
    found.push_back(it->second);
  } else if (all_known) {
    diagnostics.error(name.at, item, name.source_text, "names no ply or tool of this case",
                      known_names(bodies) + "; and plies and tools for all of them");
  }
  return found;
}

/// Number of the law that a table names, or -1 if it names none.
int friction_law_of(const TableView& section, const Numbers& laws, bool all_known,
                    Diagnostics& diagnostics) {
  if (!given(section, "friction_law")) return -1;
  if (const auto it = laws.find(text(section, "friction_law")); it != laws.end()) return it->second;
  if (all_known)
    value_error(section, "friction_law", "names no law in [friction]", known_names(laws),
                diagnostics);
  return -1;
}

/// Warns of laws that no pair has.
void warn_of_unused(const TableView& root, const FrictionTable& table, Diagnostics& diagnostics) {
  int number = 0;
  for (const TableView& law : subsections(root, "friction")) {
    if (std::find(table.law.begin(), table.law.end(), number++) == table.law.end() && law.entry)
      diagnostics.warning(law.entry->at,
                          fmt::format("{}: does nothing, as no pair has this law; name it in "
                                      "contact.friction_law or in a [[contact.pair]]",
                                      law.item));
  }
}

FrictionTable read_friction(const TableView& root, const NamedBodies& named,
                            Diagnostics& diagnostics) {
  const TableView contact = subsection(root, "contact");
  const Numbers laws = names_of(root, "friction");
  const bool know_laws = knows_names(root, "friction");
  const int plies = named.plies, count = named.count;
  FrictionTable table;
  table.bodies = count;
  table.mu.assign(static_cast<std::size_t>(count * count), number(contact, "friction"));
  table.law.assign(table.mu.size(), friction_law_of(contact, laws, know_laws, diagnostics));
  for (const TableView& pair : subsections(contact, "pair")) {
    const TomlNode* between = given(pair, "between");
    const double mu = number(pair, "friction");
    const int law = friction_law_of(pair, laws, know_laws, diagnostics);
    if (!between) continue;
    std::vector<int> sides[2];
    for (std::size_t i = 0; i < 2; ++i)
      sides[i] = bodies_named(between->children[i], fmt::format("{}.between.{}", pair.item, i),
                              named, diagnostics);
    const auto tool = [&](int body) { return body >= plies; };
    if (!sides[0].empty() && !sides[1].empty() && tool(sides[0][0]) && tool(sides[1][0]))
      value_error(pair, "between", "names two tools, which never touch each other here",
                  "name a ply, or plies for all of them", diagnostics);
    for (const int a : sides[0])
      for (const int b : sides[1])
        for (const int place : {a * count + b, b * count + a})
          table.mu[place] = mu, table.law[place] = law;
  }
  if (is_sound(contact) && named.all_known) warn_of_unused(root, table, diagnostics);
  return table;
}

Case build_case(const TableView& root, const std::filesystem::path& folder,
                Diagnostics& diagnostics) {
  Case built;
  read_members(root, built);
  built.fabrics = read_fabrics(root, diagnostics);
  for (const TableView& section : subsections(root, "blanks"))
    built.blanks.push_back(read_blank(section, folder, diagnostics));
  built.plies = read_plies(root, built.fabrics, diagnostics);
  built.tools = read_tools(root, folder, diagnostics);
  place_tool_zones(root, built, diagnostics);
  built.boundaries = read_boundaries(root, built.plies, built.tools, diagnostics);
  Numbers bodies = number_bodies(root, diagnostics);
  const TableView contact = subsection(root, "contact");
  const int plies = static_cast<int>(built.plies.size());
  const int count = plies + static_cast<int>(built.tools.size());
  // boundaries have no contact
  std::erase_if(bodies, [&](const auto& body) { return body.second >= count; });
  built.friction_laws = read_friction_laws(root, diagnostics);
  const bool all_known = knows_names(root, "ply") && knows_names(root, "tool");
  built.friction = read_friction(root, {std::move(bodies), plies, count, all_known}, diagnostics);
  read_members(contact, built.contact);
  read_members(subsection(root, "solver"), built.solver);
  read_members(subsection(root, "accuracy"), built.accuracy);
  read_further_parts(root, built, diagnostics);
  check_further_parts(root, built, diagnostics);
  return built;
}

SourceLocation locate(const TableView& root, const TableView& section) {
  SourceLocation part{section.entry ? section.entry->at : root.entry->at, section.item};
  const TomlNode* scale = section.entry ? section.entry->find("scale") : nullptr;
  if (!scale || !scale->is_number()) return part;
  part.scale = scale->number;
  const Place &at = scale->at, &table = section.entry->at; // a default has the place of its table
  part.scale_given = at.file != table.file || at.line != table.line || at.column != table.column;
  return part;
}

CaseParts locate_parts(const TableView& root) {
  const auto all = [&](const char* key) {
    std::vector<SourceLocation> places;
    for (const TableView& section : subsections(root, key))
      places.push_back(locate(root, section));
    return places;
  };
  const TomlNode* gravity = given(root, "gravity");
  return {all("blanks"),
          all("ply"),
          all("tool"),
          all("boundary"),
          {gravity ? gravity->at : root.entry->at, "gravity"},
          locate(root, subsection(root, "solver"))};
}

CaseWords words_in(const TableView& root) {
  const auto all = [&](const char* table, const char* key) {
    std::vector<std::string> words;
    for (const TableView& section : subsections(root, table)) {
      const TomlNode* word = section.entry ? section.entry->find(key) : nullptr;
      words.push_back(word && word->kind == TomlNode::Kind::string ? word->text : std::string());
    }
    return words;
  };
  return {all("ply", "fabric"), all("ply", "blank"), all("tool", "shape"), all("boundary", "kind")};
}

/// Sorts errors: those of the case file first, then of the files that it names, then of overrides,
/// each by line and column. Removes duplicates (a fabric file may be used under two names).
void put_in_order(std::vector<CaseError>& errors, const std::string& case_name) {
  const auto rank = [&](const CaseError& error) {
    const int file = error.file == case_name ? 0 : error.file == override_file ? 2 : 1;
    return std::tuple(file, error.file, error.line, error.column);
  };
  std::stable_sort(errors.begin(), errors.end(),
                   [&](const CaseError& a, const CaseError& b) { return rank(a) < rank(b); });
  std::set<std::tuple<std::string, int, int, std::string, std::string>> seen;
  std::erase_if(errors, [&](const CaseError& e) {
    return !seen.emplace(e.file, e.line, e.column, last_part(e.item), e.rule).second;
  });
}

} // namespace

CaseReading read_case(const std::filesystem::path& file, const std::vector<Override>& overrides) {
  Diagnostics diagnostics;
  CaseReading reading;
  reading.file = file;
  for (const Override& change : overrides)
    reading.overridden.insert(change.first);
  if (std::optional<TomlNode> entries = read_entries(file, overrides, diagnostics)) {
    const std::filesystem::path folder = folder_of(file);
    const TableView root{&*entries, "", ""};
    Case built = build_case(root, folder, diagnostics);
    reading.parts = locate_parts(root);
    reading.words = words_in(root);
    if (!diagnostics.errors.empty()) {
      reading.sketch.data = std::move(built);
      for (const CaseError& error : diagnostics.errors)
        reading.sketch.mistaken.insert(error.item);
    } else {
      estimate_missing(built);
      reading.identity = identity_of(*entries, folder);
      reading.given = given_values(*entries, folder);
      reading.value = std::move(built);
    }
  }
  put_in_order(diagnostics.errors, file.string());
  reading.errors = std::move(diagnostics.errors);
  reading.warnings = std::move(diagnostics.warnings);
  return reading;
}

std::vector<BlankMesh> check_case(CaseReading& reading) {
  if (!reading.value) return {};
  Diagnostics diagnostics;
  std::vector<BlankMesh> meshes = check_scene(*reading.value, reading.parts, diagnostics);
  if (diagnostics.errors.empty()) {
    check_case_sense(*reading.value, reading.parts, diagnostics);
    check_resolution(*reading.value, reading.parts, meshes, diagnostics);
  }
  put_in_order(diagnostics.errors, reading.file.string());
  if (!diagnostics.errors.empty()) reading.value.reset();
  reading.errors.insert(reading.errors.end(), diagnostics.errors.begin(), diagnostics.errors.end());
  reading.warnings.insert(reading.warnings.end(), diagnostics.warnings.begin(),
                          diagnostics.warnings.end());
  return meshes;
}

} // namespace plyform
