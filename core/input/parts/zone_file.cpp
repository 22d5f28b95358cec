// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the zones of blanks: parts with smaller elements.
#include "base/format.hpp"
#include "core/input/keys/key_member.hpp"
#include "core/input/parts/case_parts.hpp"
#include "core/mesh/size_field.hpp"
#include "core/mesh/tool_zone.hpp"
#include "core/model/reach_ahead.hpp"

#include <algorithm>

namespace plyform {
namespace {

/// Reports keys that say more about a kind of zone that this one is not.
void check_zone_company(const TableView& section, Diagnostics& diagnostics) {
  const auto belongs = [&](const char* key, const char* with) {
    if (!given(section, key) || given(section, with)) return;
    value_error(section, key, fmt::format("belongs to {}, which is not given", with),
                fmt::format("take it out, or give {}", with), diagnostics);
  };
  if (number(section, "inner_radius") != 0.0) belongs("inner_radius", "radius");
  belongs("distance", "tool");
  belongs("below_radius", "tool");
  if (given(section, "tool") && vector2(section, "centre") != Vec2::Zero())
    value_error(section, "centre", "has no meaning for a zone along a tool",
                "take it out: the zone lies where the tool is", diagnostics);
}

void check_zone_size(const TableView& section, const MeshZone& zone, const BlankSpec& blank,
                     Diagnostics& diagnostics) {
  if (zone.inner_radius >= zone.radius && given(section, "radius"))
    value_error(section, "inner_radius",
                fmt::format("must be less than the radius, {:g}", zone.radius),
                "make it smaller, or the radius larger", diagnostics);
  if (blank.mesh != MeshKind::file && zone.element_size > blank.element_size)
    value_error(section, "element_size",
                fmt::format("must be at most the blank's, {:g}", blank.element_size),
                "make it smaller, or the blank's larger: zones refine", diagnostics);
}

/// Reports an outline of a zone that cannot be one; whether it can.
bool check_zone_outline(const TableView& section, const MeshZone& zone, Diagnostics& diagnostics) {
  if (!given(section, "outline")) return false;
  try {
    check_polygon(zone.outline, "the zone");
    return true;
  } catch (const std::runtime_error& error) {
    const TomlNode* outline = given(section, "outline");
    diagnostics.error_from(outline->at, item_of(section, "outline"), outline->source_text, "",
                           error.what());
    return false;
  }
}

/// Whether the blank's outline can be asked what lies on it; if not, that is reported elsewhere.
bool has_outline(const BlankSpec& blank) {
  return blank.mesh != MeshKind::file && takes_elements(blank);
}

MeshZone read_zone(const TableView& section, const Vec2& origin, const BlankSpec& blank,
                   Diagnostics& diagnostics) {
  MeshZone zone;
  read_members(section, zone);
  const std::size_t errors = diagnostics.errors.size();
  check_zone_company(section, diagnostics);
  check_zone_size(section, zone, blank, diagnostics);
  if (given(section, "tool")) {
    zone.kind = ZoneKind::tool;
    return zone;
  }
  const Vec2 place = origin + vector2(section, "centre");
  zone.centre = place;
  const char* shape = "radius";
  if (given(section, "outline")) {
    shape = "outline";
    zone.kind = ZoneKind::polygon;
    zone.outline = pairs(section, "outline");
    if (!check_zone_outline(section, zone, diagnostics)) return zone;
    for (Vec2& corner : zone.outline)
      corner += place;
  }
  if (is_sound(section) && diagnostics.errors.size() == errors && given(section, shape) &&
      has_outline(blank) && !lies_on(zone, blank.outline))
    value_error(section, shape, "makes a zone beside the blank",
                "move it onto the blank; it is seen from the blank's centre, as holes are",
                diagnostics);
  return zone;
}

/// Where the plies of a blank lie, seen from above; empty if it is not known.
Eigen::AlignedBox2d plan_of_blank(const Case& built, std::size_t blank) {
  Eigen::AlignedBox2d box;
  for (const Ply& ply : built.plies)
    if (at(ply.blank) == blank) box.extend(plan_of(built, ply));
  return box;
}

/// Fills in the places of a zone along a tool.
void place_zone(const TableView& section, Case& built, std::size_t blank, MeshZone& zone,
                Diagnostics& diagnostics) {
  const auto tool = std::find_if(
      built.tools.begin(), built.tools.end(),
      [name = text(section, "tool")](const Tool& candidate) { return candidate.name == name; });
  if (tool == built.tools.end()) {
    std::string names;
    for (const Tool& other : built.tools)
      names += (names.empty() ? "" : ", ") + other.name;
    value_error(section, "tool", "names no tool of this case",
                names.empty() ? "there are none" : "there are " + names, diagnostics);
    return;
  }
  zone.tool = static_cast<int>(tool - built.tools.begin());
  ToolZoneRule rule{{}, {}, zone.element_size, plan_of_blank(built, blank)};
  if (given(section, "below_radius")) rule.below_radius = number(section, "below_radius");
  if (given(section, "distance")) rule.distance = number(section, "distance");
  zone.places = tight_places(*tool, rule);
  if (zone.places.empty())
    value_error(section, "tool", "has no place that is rounded so tightly",
                "give a larger below_radius, or another tool", diagnostics);
  else if (has_outline(built.blanks[blank]))
    for (const Ply& ply : built.plies) {
      if (at(ply.blank) != blank ||
          lies_on(seen_from_blank(zone, ply), built.blanks[blank].outline))
        continue;
      value_error(section, "tool",
                  fmt::format("has no place so tightly rounded above or below ply {}", ply.name),
                  "give more distance or below_radius, or another tool", diagnostics);
      return;
    }
}

} // namespace

void read_zones(const TableView& section, BlankSpec& blank, Diagnostics& diagnostics) {
  const Vec2 origin =
      blank.mesh == MeshKind::file ? Vec2(Vec2::Zero()) : vector2(section, "centre");
  for (const TableView& zone : subsections(section, "zone"))
    blank.zones.push_back(read_zone(zone, origin, blank, diagnostics));
}

void place_tool_zones(const TableView& root, Case& built, Diagnostics& diagnostics) {
  if (!diagnostics.errors.empty()) return; // tools may be missing, plies without a blank
  const std::vector<TableView> blanks = subsections(root, "blanks");
  for (std::size_t b = 0; b < blanks.size(); ++b) {
    const std::vector<TableView> zones = subsections(blanks[b], "zone");
    for (std::size_t k = 0; k < zones.size(); ++k)
      if (built.blanks[b].zones[k].kind == ZoneKind::tool)
        place_zone(zones[k], built, b, built.blanks[b].zones[k], diagnostics);
  }
}

} // namespace plyform
