// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/keys/tool_shapes.hpp"

#include "base/format.hpp"
#include "contact/shapes/self_meeting.hpp"
#include "core/input/keys/key_member.hpp"
#include "core/input/keys/overrides.hpp"
#include "core/input/keys/point_list.hpp"
#include "core/input/keys/schema_case.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {

namespace {

using K = KeyKind;

/// Arguments of the readers of shapes.
struct ShapeSection {
  const TableView& tool;
  const ToolMeshes& meshes;
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

/// Keys of shapes that become a profile.
struct ConeKeys {
  double radius, top_radius, length, edge_radius;
};
struct TorusKeys {
  double major_radius, minor_radius;
};

ToolShape read_cone(const ShapeSection& s) {
  ConeKeys cone{};
  read_members(s.tool, cone);
  const double sum = cone.radius + cone.top_radius + cone.length + cone.edge_radius;
  if (std::isnan(sum)) return Plane{};
  try {
    return make_cone(cone.radius, cone.top_radius, cone.length, cone.edge_radius);
  } catch (const std::exception& error) {
    const TomlNode* edge = given(s.tool, "edge_radius");
    s.diagnostics.error_from(edge->at, item_of(s.tool, "edge_radius"), edge->source_text, "",
                             error.what());
    return Plane{};
  }
}

ToolShape read_torus(const ShapeSection& s) {
  TorusKeys torus{};
  read_members(s.tool, torus);
  if (torus.minor_radius >= torus.major_radius)
    value_error(s.tool, "minor_radius",
                fmt::format("must be less than major_radius, which is {:g}", torus.major_radius),
                "make it smaller, or use shape sphere or profile", s.diagnostics);
  return make_torus(torus.major_radius, torus.minor_radius);
}

Profile read_section(const ShapeSection& s, const PointWords& words) {
  const TomlNode* points = given(s.tool, "points");
  if (!points) return {};
  const std::size_t errors = s.diagnostics.errors.size();
  Profile section = read_points(*points, item_of(s.tool, "points"), words, false, s.diagnostics);
  if (s.diagnostics.errors.size() > errors) return section;
  if (const std::optional<Vec2> place = self_meeting(section))
    value_error(
        s.tool, "points",
        fmt::format("cross or touch each other at ({:.6g}, {:.6g})", place->x(), place->y()),
        "list the points in order along the section, each once", s.diagnostics);
  return section;
}

ToolShape read_profile(const ShapeSection& s) {
  const TomlNode* points = given(s.tool, "points");
  for (std::size_t i = 0; points && i < points->children.size(); ++i) {
    const TomlNode& entry = points->children[i];
    const bool arc = entry.kind == TomlNode::Kind::table;
    const TomlNode& r = (arc ? *entry.find("to") : entry).children[0];
    if (r.number < 0.0)
      s.diagnostics.error(r.at,
                          fmt::format("{}.{}{}.0", item_of(s.tool, "points"), i, arc ? ".to" : ""),
                          r.source_text, "must be at least 0, as the profile is turned about r = 0",
                          "give r from the axis outwards, or use shape extrusion");
  }
  return RevolvedProfile{read_section(s, {"profile point", "r", "z"})};
}

ToolShape read_extrusion(const ShapeSection& s) {
  return ExtrudedProfile{read_section(s, {"section point", "x", "z"}), number(s.tool, "length")};
}

ToolShape read_mesh(const ShapeSection& s) {
  try {
    if (MeshShapePtr mesh = s.meshes.of(s.tool)) return mesh;
  } catch (const std::exception& error) {
    const TomlNode* file = given(s.tool, "file");
    s.diagnostics.error_from(file->at, item_of(s.tool, "file"), file->source_text,
                             "cannot be used: ", error.what());
  }
  return Plane{};
}

struct ShapeInput {
  const char* word;
  ToolShape (*read)(const ShapeSection& section);
};

constexpr ShapeInput shapes[] = {{"sphere", read_sphere},
                                 {"cylinder", read_cylinder},
                                 {"cone", read_cone},
                                 {"torus", read_torus},
                                 {"box", read_box},
                                 {"plane", read_plane},
                                 {"disc", read_ring},
                                 {"annulus", read_ring},
                                 {"profile", read_profile},
                                 {"mesh", read_mesh},
                                 {"extrusion", read_extrusion}};

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
       .meaning = "shape; its own frame has the axis as z; cylinder, cone, torus and box are "
                  "centred on the position, disc and annulus stand on it, a plane has its material "
                  "below it"},
      length("radius", {"sphere", "cylinder", "cone", "disc"}, length_range,
             "radius; of a cone's lower end",
             {to(&Sphere::radius), to(&Cylinder::radius), to(&ConeKeys::radius),
              to(&Annulus::outer_radius)}),
      length("top_radius", {"cone"}, length_or_zero, "radius of the upper end; 0 for a tip",
             {to(&ConeKeys::top_radius)}),
      length("length", {"cylinder", "cone", "extrusion"}, length_range,
             "length along the axis; of an extrusion along its own y, with sharp ends",
             {to(&Cylinder::length), to(&ConeKeys::length)}),
      length("major_radius", {"torus"}, length_range, "radius from the axis to the tube's middle",
             {to(&TorusKeys::major_radius)}),
      length("minor_radius", {"torus"}, length_range, "radius of the tube",
             {to(&TorusKeys::minor_radius)}),
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
      length("edge_radius", {"cylinder", "cone", "box", "disc", "annulus"}, length_or_zero,
             "rounding of all edges; faces stay where they are, and so the outer dimensions, but "
             "those of a cone",
             {to(&Cylinder::edge_radius), to(&ConeKeys::edge_radius), to(&Box::edge_radius),
              to(&Annulus::edge_radius)}),
      {.key = "tool[].points",
       .kind = K::profile,
       .unit = "mm",
       .ranges = {place_range, place_range, length_or_zero},
       .least_items = 2,
       .most_items = 2000, // half a megabyte each, as each goes round the axis
       .of = "shape",
       .with = {"profile", "extrusion"},
       .meaning = "points [r, z] of a profile, turned about the axis, or [x, z] of an extrusion, "
                  "drawn out along y; material to the right in walking order; a third number "
                  "rounds the corner; a table is an arc from the point before"},
      {.key = "tool[].points[].to",
       .kind = K::numbers,
       .unit = "mm",
       .ranges = {place_range},
       .count = 2,
       .meaning = "end [r, z] or [x, z] of the arc"},
      {.key = "tool[].points[].centre",
       .kind = K::numbers,
       .unit = "mm",
       .ranges = {place_range},
       .count = 2,
       .meaning = "centre [r, z] or [x, z] of the arc"},
      {.key = "tool[].points[].turn",
       .kind = K::choice,
       .choices = {"left", "right"},
       .meaning = "side to which the arc bends, walking with r or x to the right and z up"},
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
    if (row.key == "tool[].edge_radius" || row.key == "tool[].top_radius") row.fallback = "0.0";
  return rows;
}

ToolShape read_shape(const TableView& tool, const ToolMeshes& meshes, Diagnostics& diagnostics) {
  for (const ShapeInput& shape : shapes)
    if (text(tool, "shape") == shape.word) return shape.read({tool, meshes, diagnostics});
  return Plane{}; // an unknown word has been reported
}

} // namespace plyform
