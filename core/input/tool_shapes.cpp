// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes of tools in a case file: for each the word of the key `shape`, its keys under tool[], and
// its reader.
#include "core/input/case_parts.hpp"
#include "core/input/key_member.hpp"
#include "core/input/overrides.hpp"
#include "core/input/schema_case.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plyform {

namespace {

using K = KeyKind;

/// Arguments of the readers of shapes.
struct ShapeSection {
  const TableView& tool;
  const std::filesystem::path& folder; ///< of the case file
  Diagnostics& diagnostics;
};

ToolShape read_sphere(const ShapeSection& s) {
  Sphere sphere{};
  read_members(s.tool, sphere);
  return sphere;
}

/// Checks that the edge radius is below half the smallest dimension, so that every side keeps a
/// flat part.
void check_edge(const ShapeSection& s, double edge, double smallest) {
  const std::string shape = text(s.tool, "shape");
  if (smallest > 0.0 && edge >= 0.5 * smallest)
    value_error(s.tool, "edge_radius",
                fmt::format("must be less than {:g}, half the smallest dimension of the {}",
                            0.5 * smallest, shape),
                "make it smaller or the " + shape + " larger", s.diagnostics);
}

ToolShape read_cylinder(const ShapeSection& s) {
  Cylinder cylinder{};
  read_members(s.tool, cylinder);
  check_edge(s, cylinder.edge_radius, std::min(2.0 * cylinder.radius, cylinder.length));
  return cylinder;
}

ToolShape read_box(const ShapeSection& s) {
  Box box{};
  read_members(s.tool, box);
  check_edge(s, box.edge_radius, box.size.minCoeff());
  return box;
}

ToolShape read_plane(const ShapeSection&) {
  return Plane{};
}

ToolShape read_ring(const ShapeSection& s) {
  Annulus ring{};
  read_members(s.tool, ring);
  if (ring.inner_radius >= ring.outer_radius)
    value_error(s.tool, "inner_radius",
                fmt::format("must be less than outer_radius, which is {:g}", ring.outer_radius),
                "exchange the two, or use shape disc for a ring without a hole", s.diagnostics);
  const bool disc = ring.inner_radius == 0.0;
  const double width = disc ? ring.outer_radius : (ring.outer_radius - ring.inner_radius) / 2.0;
  const double room = std::min(ring.thickness / 2.0, width); // largest edge radius
  if (room > 0.0 && ring.edge_radius > room)
    value_error(s.tool, "edge_radius",
                fmt::format("must be at most {:g}, for the roundings to fit the section", room),
                "make it smaller or the section larger", s.diagnostics);
  return ring;
}

/// Assembles a profile from points with fillets and arcs.
struct ProfileReader {
  const TableView& tool;
  Diagnostics& diagnostics;
  RevolvedProfile profile{};
  std::vector<std::array<double, 3>> run{};   ///< points of the current polyline
  std::vector<const TomlNode*> run_entries{}; ///< their entries in the file

  void fail(const TomlNode& at, std::size_t index, const std::string& rule,
            const std::string& remedy) {
    diagnostics.error(at.at, fmt::format("{}.{}", item_of(tool, "points"), index), at.source_text,
                      rule, remedy);
  }
  void straight(const TomlNode& entry);
  void arc(const TomlNode& entry, std::size_t index);
  void finish_run();
};

void ProfileReader::straight(const TomlNode& entry) {
  const double fillet = entry.children.size() > 2 ? entry.children[2].number : 0.0;
  run.push_back({entry.children[0].number, entry.children[1].number, fillet});
  run_entries.push_back(&entry);
}

/// Appends the current polyline to the profile; a fillet needs a line on both sides.
void ProfileReader::finish_run() {
  for (const std::size_t end : {std::size_t{0}, run.size() - 1}) {
    if (run[end][2] == 0.0) continue;
    const TomlNode& entry = *run_entries[end];
    const auto index = &entry - given(tool, "points")->children.data();
    return fail(entry, static_cast<std::size_t>(index),
                "rounds a corner that has no straight line on both sides",
                "take the third number out, or give the rounding as an arc");
  }
  if (run.size() < 2) return;
  try {
    const RevolvedProfile part = make_profile(run);
    profile.segments.insert(profile.segments.end(), part.segments.begin(), part.segments.end());
  } catch (const std::exception& error) {
    const TomlNode* points = given(tool, "points");
    diagnostics.error_from(points->at, item_of(tool, "points"), points->source_text, "",
                           error.what());
  }
}

/// Appends an arc {to = [r, z], centre = [r, z], turn = "left" or "right"} from the last point.
void ProfileReader::arc(const TomlNode& entry, std::size_t index) {
  const auto point = [&](const char* key) {
    const TomlNode* list = entry.find(key);
    return Vec2(list->children[0].number, list->children[1].number);
  };
  const Vec2 a(run.back()[0], run.back()[1]), b = point("to"), centre = point("centre");
  const double radius = (a - centre).norm();
  constexpr double tolerance = 1e-3; // of the radius: numbers rounded to some digits
  if (!(std::abs((b - centre).norm() - radius) <= tolerance * radius) || !(radius > 0.0))
    return fail(entry, index,
                fmt::format("is no arc: its start is {:g} mm from the centre, its end {:g} mm",
                            radius, (b - centre).norm()),
                "correct centre or to: both must have one distance");
  finish_run();
  const int turn = entry.find("turn")->text == "left" ? 1 : -1;
  profile.segments.push_back({ProfileSegment::Kind::arc, a, b, centre, turn});
  run = {{b.x(), b.y(), 0.0}};
  run_entries = {&entry};
}

ToolShape read_profile(const ShapeSection& s) {
  ProfileReader reader{s.tool, s.diagnostics};
  const TomlNode* points = given(s.tool, "points");
  if (!points) return RevolvedProfile{};
  for (std::size_t i = 0; i < points->children.size(); ++i) {
    const TomlNode& entry = points->children[i];
    if (entry.kind != TomlNode::Kind::table) {
      reader.straight(entry);
    } else if (i == 0) {
      reader.fail(entry, i, "is an arc without a point before it", "start with a point [r, z]");
      return RevolvedProfile{};
    } else {
      reader.arc(entry, i);
    }
  }
  reader.finish_run();
  return reader.profile;
}

ToolShape read_mesh(const ShapeSection& s) {
  const TomlNode* file = given(s.tool, "file");
  const double scale = number(s.tool, "scale");
  if (!file || std::isnan(scale)) return Plane{};
  try {
    return load_tool_mesh(resolve_path(*file, s.folder).lexically_normal(), scale, nullptr);
  } catch (const std::exception& error) {
    s.diagnostics.error_from(file->at, item_of(s.tool, "file"), file->source_text,
                             "cannot be used: ", error.what());
    return Plane{};
  }
}

struct ShapeInput {
  const char* word;
  ToolShape (*read)(const ShapeSection& section);
};

constexpr ShapeInput shapes[] = {{"sphere", read_sphere},   {"cylinder", read_cylinder},
                                 {"box", read_box},         {"plane", read_plane},
                                 {"disc", read_ring},       {"annulus", read_ring},
                                 {"profile", read_profile}, {"mesh", read_mesh}};

std::vector<std::string> shape_words() {
  std::vector<std::string> words;
  for (const ShapeInput& shape : shapes)
    words.emplace_back(shape.word);
  return words;
}

/// Row of a length that the shapes `of` have.
KeyRow length(const char* name, std::vector<std::string> of, Range range, const char* meaning,
              std::vector<KeyMember> members) {
  return {.key = std::string("tool[].") + name,
          .unit = "mm",
          .ranges = {range},
          .of = "shape",
          .with = std::move(of),
          .meaning = meaning,
          .members = std::move(members)};
}

} // namespace

Rows shape_rows() {
  Rows rows{
      {.key = "tool[].shape",
       .kind = K::choice,
       .choices = shape_words(),
       .meaning = "shape; its own frame has the axis as z; cylinder and box are centred on the "
                  "position, disc and annulus stand on it, a plane has its material below it"},
      length("radius", {"sphere", "cylinder", "disc"}, length_range, "radius",
             {to(&Sphere::radius), to(&Cylinder::radius), to(&Annulus::outer_radius)}),
      length("length", {"cylinder"}, length_range, "length along the axis",
             {to(&Cylinder::length)}),
      {.key = "tool[].size",
       .kind = K::numbers,
       .unit = "mm",
       .ranges = {length_range},
       .count = 3,
       .of = "shape",
       .with = {"box"},
       .meaning = "full edge lengths",
       .members = {to(&Box::size)}},
      length("inner_radius", {"annulus"}, length_or_zero, "radius of the hole",
             {to(&Annulus::inner_radius)}),
      length("outer_radius", {"annulus"}, length_range, "outer radius",
             {to(&Annulus::outer_radius)}),
      length("thickness", {"disc", "annulus"}, length_range, "thickness along the axis",
             {to(&Annulus::thickness)}),
      length("edge_radius", {"cylinder", "box", "disc", "annulus"}, length_or_zero,
             "rounding of all edges; the outer dimensions stay",
             {to(&Cylinder::edge_radius), to(&Box::edge_radius), to(&Annulus::edge_radius)}),
      {.key = "tool[].points",
       .kind = K::profile,
       .unit = "mm",
       .ranges = {length_or_zero, place_range, length_or_zero},
       .least_items = 2,
       .of = "shape",
       .with = {"profile"},
       .meaning = "points [r, z] of the section, turned about the axis; material to the right in "
                  "walking order; a third number rounds the corner; a table is an arc from the "
                  "point before"},
      {.key = "tool[].points[].to",
       .kind = K::numbers,
       .unit = "mm",
       .ranges = {length_or_zero, place_range},
       .count = 2,
       .meaning = "end [r, z] of the arc"},
      {.key = "tool[].points[].centre",
       .kind = K::numbers,
       .unit = "mm",
       .ranges = {place_range},
       .count = 2,
       .meaning = "centre [r, z] of the arc"},
      {.key = "tool[].points[].turn",
       .kind = K::choice,
       .choices = {"left", "right"},
       .meaning = "side to which the arc bends, walking with r to the right and z up"},
      {.key = "tool[].file",
       .kind = K::path,
       .of = "shape",
       .with = {"mesh"},
       .meaning = "mesh file of the tool (STL, OBJ, PLY or OFF)"},
      {.key = "tool[].scale",
       .fallback = "1.0",
       .ranges = {{.least = 1e-9, .most = 1e9}},
       .usual = {{.least = 1e-3, .most = 1e3}},
       .of = "shape",
       .with = {"mesh"},
       .meaning = "mm per unit of the mesh file"}};
  for (KeyRow& row : rows)
    if (row.key == "tool[].edge_radius") row.fallback = "0.0";
  return rows;
}

ToolShape read_shape(const TableView& tool, const std::filesystem::path& folder,
                     Diagnostics& diagnostics) {
  for (const ShapeInput& shape : shapes)
    if (text(tool, "shape") == shape.word) return shape.read({tool, folder, diagnostics});
  return Plane{}; // an unknown word has been reported
}

} // namespace plyform
