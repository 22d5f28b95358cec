// SPDX-License-Identifier: GPL-3.0-or-later
// Reads fabrics: laws of tension, shear and bending, as constants or tables.
#include "core/input/parts/fabric_file.hpp"

#include "base/text.hpp"
#include "core/input/checks/sense_checks.hpp"
#include "core/input/keys/key_member.hpp"
#include "core/input/keys/sheet_laws.hpp"
#include "core/input/parts/case_parts.hpp"
#include "core/model/fabric_estimates.hpp"

#include <cmath>
#include <fmt/format.h>
#include <string_view>

namespace plyform {

namespace {

/// Checks the table of a law: it must start at the origin with increasing first column; the second
/// column must not decrease if `rising`, its name in the message, is not empty.
void check_law(const TableView& law, const std::string& key, const std::vector<Vec2>& points,
               const std::string& rising, Diagnostics& diagnostics) {
  const TomlNode* table = given(law, key);
  if (!table || points.empty()) return;
  const auto fail = [&](std::size_t row, const std::string& rule, const std::string& remedy) {
    const TomlNode& entry = table->children[row];
    diagnostics.error(entry.at, fmt::format("{}.{}", item_of(law, key), row), entry.source_text,
                      rule, remedy);
  };
  if (points[0] != Vec2::Zero())
    return fail(0, "must be [0, 0], where the law starts", "put [0.0, 0.0] first");
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (!(points[i].x() > points[i - 1].x()))
      return fail(i, "must have a first number above that of the row before",
                  "put the rows in ascending order, each value once");
    if (!rising.empty() && !(points[i].y() >= points[i - 1].y()))
      return fail(i, fmt::format("must not have less {} than the row before", rising),
                  "take out what falls: a yarn that softens is not modelled");
  }
}

void split(const std::vector<Vec2>& points, std::vector<double>& first,
           std::vector<double>& second) {
  for (const Vec2& point : points) {
    first.push_back(point.x());
    second.push_back(point.y());
  }
}

/// Whether the file gives a compression stiffness of 0. A missing one is estimated if it is needed
/// (core/model/fabric_estimates.hpp).
bool tension_only(const TableView& yarn, const TensionLaw& law) {
  return given(yarn, "compression_stiffness") && law.compression == 0.0;
}

TensionLaw read_tension(const TableView& yarn, Diagnostics& diagnostics) {
  TensionLaw law;
  read_members(yarn, law);
  const std::vector<Vec2> points = pairs(yarn, "table");
  check_law(yarn, "table", points, "tension", diagnostics);
  split(points, law.strain, law.tension);
  if (const double most = law.largest_slope(); law.compression > most)
    value_error(yarn, "compression_stiffness",
                fmt::format("must be at most the largest stiffness in tension, {:g}", most),
                fmt::format("give {:g}, a hundredth of that, or so", usual_compression(law)),
                diagnostics);
  if (std::isfinite(law.buckling_force) && tension_only(yarn, law))
    value_error(yarn, "buckling_force",
                "needs a compression_stiffness of the same yarns above 0: yarns that carry tension "
                "only have no force to buckle at",
                fmt::format("give compression_stiffness = {:g}, 0.01 of the largest stiffness in "
                            "tension, or take buckling_force out",
                            usual_compression(law)),
                diagnostics);
  return law;
}

/// Reads the bending law of yarns whose law of tension is `tension`: bending needs yarns that bear
/// compression, as a moment shortens yarns that do not.
MomentLaw read_moments(const TableView& yarn, const TensionLaw& tension, Diagnostics& diagnostics) {
  MomentLaw law;
  read_members(yarn, law);
  const std::vector<Vec2> points = pairs(yarn, "bending_table");
  check_law(yarn, "bending_table", points, "moment", diagnostics);
  split(points, law.curvature, law.moment);
  if (law.largest_slope() > 0.0 && tension_only(yarn, tension))
    value_error(yarn, points.empty() ? "bending_stiffness" : "bending_table",
                "needs a compression_stiffness of the same yarns, or they shorten instead of "
                "bending",
                fmt::format("give compression_stiffness = {:g}, 0.01 of the largest stiffness in "
                            "tension, or so",
                            usual_compression(tension)),
                diagnostics);
  return law;
}

YarnSources sources_of(const TableView& yarn) {
  const auto source = [](bool is_given) {
    return is_given ? ValueSource::given : ValueSource::missing;
  };
  return {source(given(yarn, "compression_stiffness")),
          source(given(yarn, "bending_stiffness") || given(yarn, "bending_table")),
          source(given(yarn, "in_plane_bending_stiffness"))};
}

BendingLaw read_bending(const TableView& section, const Fabric& fabric, Diagnostics& diagnostics) {
  BendingLaw law;
  const TableView warp = subsection(section, "warp"), weft = subsection(section, "weft");
  law.warp = read_moments(warp, fabric.warp, diagnostics);
  law.weft = read_moments(weft, fabric.weft, diagnostics);
  if (given(warp, "in_plane_bending_stiffness"))
    law.in_plane[0] = number(warp, "in_plane_bending_stiffness");
  if (given(weft, "in_plane_bending_stiffness"))
    law.in_plane[1] = number(weft, "in_plane_bending_stiffness");
  law.twist = usual_twist(law);
  if (!fabric.twist_given) return law;
  law.twist = number(section, "twist_stiffness");
  if (law.twist > 0.0 && !(usual_twist(law) > 0.0))
    value_error(section, "twist_stiffness", "needs bending stiffness along warp and weft",
                "give bending_stiffness to both, or take twist_stiffness out", diagnostics);
  return law;
}

ShearLaw read_shear(const TableView& shear, Diagnostics& diagnostics) {
  ShearLaw law;
  const std::vector<Vec2> points = pairs(shear, "table");
  check_law(shear, "table", points, "", diagnostics);
  split(points, law.angle, law.torque);
  law.k = numbers(shear, "polynomial");
  if (!law.k.empty() && law.k[0] < 0.0)
    value_error(shear, "polynomial", "must start with a k1 of at least 0",
                "give k1, k3, k5 ...; a cell with k1 < 0 shears by itself", diagnostics);
  return law;
}

Fabric read_fabric(const TableView& section, const std::string& key, Diagnostics& diagnostics) {
  Fabric fabric;
  fabric.name = key;
  read_members(section, fabric);
  if (read_sheet(section, fabric)) return fabric;
  const TableView warp = subsection(section, "warp"), weft = subsection(section, "weft");
  read_members(warp, fabric);
  read_members(weft, fabric);
  fabric.warp = read_tension(warp, diagnostics);
  fabric.weft = read_tension(weft, diagnostics);
  fabric.shear = read_shear(subsection(section, "shear"), diagnostics);
  fabric.sources = {sources_of(warp), sources_of(weft)};
  fabric.twist_given = given(section, "twist_stiffness") != nullptr;
  fabric.bending = read_bending(section, fabric, diagnostics);
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

} // namespace

std::vector<Fabric> read_fabrics(const TableView& root, Diagnostics& diagnostics) {
  std::vector<Fabric> fabrics;
  for (const TableView& section : subsections(root, "fabrics")) {
    const std::size_t before = diagnostics.errors.size();
    fabrics.push_back(
        read_fabric(section, section.item.substr(std::string("fabrics.").size()), diagnostics));
    if (diagnostics.errors.size() == before)
      check_fabric_sense(section, fabrics.back(), diagnostics);
  }
  return fabrics;
}

FabricReading read_fabric_file(const std::filesystem::path& file, bool laws_may_miss) {
  FabricReading reading;
  Diagnostics diagnostics;
  const std::string name = file.string();
  std::string reason;
  const std::optional<std::string> content = read_text(file, reason);
  if (!content)
    diagnostics.error({name, 1, 1}, "", "", "the fabric file " + reason,
                      "give the path of a fabric file");
  std::optional<TomlNode> root =
      content ? parse_entries(*content, name, diagnostics) : std::nullopt;
  if (root) {
    reading.text = *content;
    root->at.file = name;
    for (const char* table : {"warp", "weft", "shear"}) {
      const bool shear = std::string_view(table) == "shear";
      if (laws_may_miss &&
          stand_in(*root, table, shear ? "polynomial" : "stiffness",
                   shear ? "[1.0]" : "1e9")) // larger than any compression_stiffness
        reading.missing.push_back(table);
    }
    const TableView section{&*root, "fabrics.NAME", ""};
    check_section(section, diagnostics);
    Fabric fabric = read_fabric(section, file.stem().string(), diagnostics);
    for (const std::string& table : reading.missing) {
      if (table == "warp") fabric.warp = {};
      if (table == "weft") fabric.weft = {};
      if (table == "shear") fabric.shear = {};
    }
    if (diagnostics.errors.empty()) reading.value = std::move(fabric);
  }
  reading.errors = std::move(diagnostics.errors);
  return reading;
}

} // namespace plyform
