// SPDX-License-Identifier: GPL-3.0-or-later
// Reads fabrics: laws of tension, shear and bending, as constants or tables.
#include "core/input/parts/fabric_file.hpp"

#include "base/format.hpp"
#include "base/text.hpp"
#include "core/input/checks/sense_checks.hpp"
#include "core/input/keys/key_member.hpp"
#include "core/input/keys/schema_case.hpp"
#include "core/input/keys/sheet_laws.hpp"
#include "core/input/keys/temperature_keys.hpp"
#include "core/input/parts/case_parts.hpp"
#include "core/input/parts/compaction_file.hpp"
#include "core/input/parts/crimp_file.hpp"
#include "core/input/parts/stitches.hpp"
#include "core/input/parts/viscous_file.hpp"
#include "core/input/parts/yarn_families.hpp"
#include "core/model/fabric_estimates.hpp"

#include <algorithm>
#include <string_view>

namespace plyform {

namespace {

/// Reads the twist stiffness of a fabric whose families bend as they do.
void read_twist(const TableView& section, Fabric& fabric, Diagnostics& diagnostics) {
  fabric.twist_given = given(section, "twist_stiffness") != nullptr;
  if (fabric.has_yarns()) fabric.twist = usual_twist(fabric);
  if (!fabric.twist_given) return;
  fabric.twist = number(section, "twist_stiffness");
  const auto bends = [](const YarnFamily& family) { return family.bending.at(0.0).slope > 0.0; };
  if (fabric.twist > 0.0 && is_weave(fabric) &&
      !std::all_of(fabric.families.begin(), fabric.families.end(), bends))
    value_error(section, "twist_stiffness", "needs bending stiffness along warp and weft",
                "give bending_stiffness to both, or take twist_stiffness out", diagnostics);
}

/// The short form: warp, weft, shear.
void read_weave(const TableView& section, Fabric& fabric, Diagnostics& diagnostics) {
  for (const char* name : {"warp", "weft"}) {
    fabric.families.push_back(read_family(subsection(section, name), diagnostics));
    fabric.families.back().name = name;
  }
  fabric.families[1].angle = number(section, "fibre_angle");
  const TableView shear = subsection(section, "shear");
  fabric.crossings.push_back({0, 1, read_shear(shear, diagnostics)});
  fabric.crossings[0].viscous = read_viscous_shear(shear, diagnostics);
  read_crimp(subsection(section, "crimp"), fabric, fabric.crossings[0], diagnostics);
}

Fabric read_fabric(const TableView& section, const std::string& key, Diagnostics& diagnostics) {
  Fabric fabric;
  fabric.name = key;
  read_members(section, fabric);
  if (given(section, "thickness") && given(section, "surface_density") &&
      is_sound(section, "fibre_density") && check_fibre_volume(section, fabric, diagnostics))
    read_compaction(subsection(section, "compaction"), fabric, diagnostics);
  read_fabric_temperature(subsection(section, "temperature"), fabric, diagnostics);
  if (read_sheet(section, fabric, diagnostics)) return fabric;
  if (text(section, "law") == families_word)
    read_families(section, fabric, diagnostics);
  else
    read_weave(section, fabric, diagnostics);
  read_twist(section, fabric, diagnostics);
  read_stitches(section, fabric, diagnostics);
  return fabric;
}

/// Inserts a valid law into a table that has none; returns whether it did.
bool stand_in(TomlNode& root, const std::string& table, const std::string& key, const char* value) {
  TomlNode* section = root.find(table);
  if (section &&
      (section->kind != TomlNode::Kind::table || section->find(key) || section->find("table")))
    return false;
  if (!section) {
    TomlNode made;
    made.key = table;
    made.at = made.key_at = root.at;
    root.children.push_back(std::move(made));
    section = &root.children.back();
  }
  std::string reason;
  TomlNode law = *parse_value(value, root.at.file, 1, reason);
  law.key = key;
  law.at = law.key_at = section->at;
  section->children.push_back(std::move(law));
  return true;
}

/// Whether a file gives a fabric by warp, weft and shear.
bool is_short_form(const TomlNode& root) {
  const TomlNode* law = root.find("law");
  return !root.find("family") && !root.find("sheet") && (!law || law->text == "woven");
}

/// Each [[stitch]]; of a file with mistakes any.
std::vector<SeamReading> seams_of(const TomlNode& root) {
  std::vector<SeamReading> seams;
  const TomlNode* tables = root.find("stitch");
  if (!tables) return seams;
  std::size_t stitches = 0;
  for (const TomlNode& table : tables->children) {
    const TomlNode* name = table.find("name");
    const std::size_t number = seams.size();
    SeamReading seam{name ? name->text : stitch_name(number), {}};
    for (std::size_t leg = 0; leg < (table.find("directions") ? 2u : 1u); ++leg)
      seam.stitches.push_back(stitches++);
    seams.push_back(std::move(seam));
  }
  return seams;
}

} // namespace

std::vector<Fabric> read_fabrics(const TableView& root, Diagnostics& diagnostics) {
  std::vector<Fabric> fabrics;
  for (const TableView& section : subsections(root, "fabrics")) {
    const std::size_t before = diagnostics.errors.size();
    fabrics.push_back(
        read_fabric(section, section.item.substr(std::string("fabrics.").size()), diagnostics));
    if (is_sound(section) && diagnostics.errors.size() == before)
      check_fabric_sense(section, fabrics.back(), diagnostics);
  }
  return fabrics;
}

namespace {

/// What may be missing in a fabric file.
enum class MissingLaws { none, of_yarns, of_rubber };

/// Gives a file without a law that of rubber, and rubber without constants some.
void stand_in_rubber(TomlNode& root) {
  const TomlNode* law = root.find("law");
  if (!law) {
    for (const char* other : {"warp", "weft", "shear", "family", "sheet"})
      if (root.find(other)) return;
    std::string reason;
    TomlNode word = *parse_value("\"neo_hookean\"", root.at.file, 1, reason);
    word.key = "law";
    word.at = word.key_at = root.at;
    root.children.push_back(std::move(word));
    law = &root.children.back();
  }
  const std::string table = law->text;
  if (table == "neo_hookean") stand_in(root, table, "shear_modulus", "1.0");
  if (table == "mooney_rivlin") {
    stand_in(root, table, "c10", "1.0");
    stand_in(root, table, "c01", "0.0");
  }
}

/// Reads the text of a file, called `name` in messages; `key`: the fabric's name if it gives none.
void read_content(const std::string& content, const std::string& name, const std::string& key,
                  MissingLaws may_miss, FabricReading& reading, Diagnostics& diagnostics) {
  std::optional<TomlNode> root = parse_entries(content, name, diagnostics);
  if (!root) return;
  reading.text = content;
  root->at.file = name;
  reading.seams = seams_of(*root);
  reading.by_families = root->find("family") != nullptr;
  if (may_miss == MissingLaws::of_rubber) stand_in_rubber(*root);
  for (const char* table : {"warp", "weft", "shear"}) {
    if (!is_short_form(*root)) break; // has no laws of these names
    const bool shear = std::string_view(table) == "shear";
    if (may_miss == MissingLaws::of_yarns &&
        stand_in(*root, table, shear ? "polynomial" : "stiffness",
                 shear ? "[1.0]" : "1e9")) // larger than any compression_stiffness
      reading.missing.push_back(table);
  }
  const TableView section{&*root, "fabrics.NAME", ""};
  check_section(section, diagnostics);
  Fabric fabric = read_fabric(section, key, diagnostics);
  for (const std::string& table : reading.missing) {
    if (table == "warp") fabric.families[0].tension = {};
    if (table == "weft") fabric.families[1].tension = {};
    if (table == "shear") fabric.crossings[0].shear = {};
  }
  if (diagnostics.errors.empty()) reading.value = std::move(fabric);
}

FabricReading read_file(const std::filesystem::path& file, MissingLaws may_miss) {
  FabricReading reading;
  Diagnostics diagnostics;
  const std::string name = file.string();
  std::string reason;
  if (const std::optional<std::string> content = read_text(file, reason))
    read_content(*content, name, file.stem().string(), may_miss, reading, diagnostics);
  else
    diagnostics.error({name, 1, 1}, "", "", "the fabric file " + reason,
                      "give the path of a fabric file");
  reading.errors = std::move(diagnostics.errors);
  reading.warnings = std::move(diagnostics.warnings);
  return reading;
}

} // namespace

FabricReading read_fabric_file(const std::filesystem::path& file, bool laws_may_miss) {
  return read_file(file, laws_may_miss ? MissingLaws::of_yarns : MissingLaws::none);
}

FabricReading read_rubber_file(const std::filesystem::path& file) {
  return read_file(file, MissingLaws::of_rubber);
}

FabricReading read_fabric_text(const std::string& text, const std::string& name, bool rubber) {
  FabricReading reading;
  Diagnostics diagnostics;
  read_content(text, name, name, rubber ? MissingLaws::of_rubber : MissingLaws::of_yarns, reading,
               diagnostics);
  reading.errors = std::move(diagnostics.errors);
  reading.warnings = std::move(diagnostics.warnings);
  return reading;
}

Diagnostics check_friction_text(const std::string& text, const std::string& name) {
  Diagnostics diagnostics;
  std::optional<TomlNode> root = parse_entries(text, name, diagnostics);
  if (!root) return diagnostics;
  const TableView file{&*root, "", ""};
  for (const TableView& law : subsections(file, "friction"))
    check_section(law, diagnostics);
  read_friction_laws(file, diagnostics);
  return diagnostics;
}

std::string table_of_law(const FabricReading& reading, const std::string& short_form) {
  if (!reading.by_families) return short_form;
  if (short_form == "warp") return "family[0]";
  if (short_form == "weft") return "family[1]";
  if (short_form == "shear") return "crossing[0]";
  return short_form == "crimp" ? "crossing[0].crimp" : short_form;
}

} // namespace plyform
