// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of the table of keys: outline and mesh of blanks.
#include "core/input/keys/key_member.hpp"
#include "core/input/keys/schema_case.hpp"

namespace plyform {
namespace {

using K = KeyKind;

const std::vector<std::string> meshed{"diagonal", "alternating", "crossed", "fibres", "free"};

/// Row of a key that says, or helps to say, what the outline is.
KeyRow of_outline(KeyRow row) {
  row.key = "blanks.NAME." + row.key;
  row.of = "mesh";
  row.with = meshed;
  return row;
}

/// Row of one of the keys of which a blank has one.
KeyRow outline(KeyRow row) {
  for (const char* other : {"size", "radius", "outline", "outline_file"})
    if (row.key != other) row.instead.emplace_back(other);
  return of_outline(row);
}

/// Rows of arcs in a list of points.
void append_arcs(Rows& rows, const std::string& list) {
  rows.push_back({.key = list + ".to",
                  .kind = K::numbers,
                  .unit = "mm",
                  .ranges = {place_range},
                  .count = 2,
                  .meaning = "end [x, y] of the arc"});
  rows.push_back({.key = list + ".centre",
                  .kind = K::numbers,
                  .unit = "mm",
                  .ranges = {place_range},
                  .count = 2,
                  .meaning = "centre [x, y] of the arc"});
  rows.push_back({.key = list + ".turn",
                  .kind = K::choice,
                  .choices = {"left", "right"},
                  .meaning = "side to which the arc bends, walking along the outline"});
}

Rows drawing_rows() {
  return {of_outline({.key = "layer",
                      .kind = K::text,
                      .otherwise = "all layers",
                      .meaning = "layer of the drawing that has the outline; others are left out"}),
          of_outline({.key = "scale",
                      .otherwise = "from the drawing's unit; 1 if it has none",
                      .ranges = {{.least = 1e-9, .most = 1e9}},
                      .usual = {{.least = 1e-3, .most = 1e3}},
                      .meaning = "mm per unit of the drawing"})};
}

/// Row of one of the keys of which a zone has one.
KeyRow zone_kind(KeyRow row) {
  for (const char* other : {"radius", "outline", "tool"})
    if (row.key != other) row.instead.emplace_back(other);
  row.key = "blanks.NAME.zone[]." + row.key;
  return row;
}

Rows zone_rows() {
  return {{.key = "blanks.NAME.zone",
           .kind = K::tables,
           .fallback = "[]",
           .meaning = "parts of the blank with smaller elements, one [[blanks.NAME.zone]] each; "
                      "where several lie, the smallest hold"},
          {.key = "blanks.NAME.zone[].element_size",
           .unit = "mm",
           .ranges = {length_range},
           .meaning = "element size in the zone, at most the blank's, to 2^(1/4); elements around "
                      "grow at once",
           .members = {to(&MeshZone::element_size)}},
          zone_kind({.key = "radius",
                     .unit = "mm",
                     .ranges = {length_range},
                     .meaning = "radius of a round zone",
                     .members = {to(&MeshZone::radius)}}),
          {.key = "blanks.NAME.zone[].inner_radius",
           .unit = "mm",
           .fallback = "0.0",
           .ranges = {length_or_zero},
           .meaning = "radius inside which a round zone does not lie, so that it is a ring",
           .members = {to(&MeshZone::inner_radius)}},
          {.key = "blanks.NAME.zone[].centre",
           .kind = K::numbers,
           .unit = "mm",
           .fallback = "[0.0, 0.0]",
           .ranges = {place_range},
           .count = 2,
           .meaning = "place of the middle of a round zone; of [0, 0] of an outline; as that of "
                      "holes"},
          zone_kind({.key = "outline",
                     .kind = K::pairs,
                     .unit = "mm",
                     .ranges = {place_range},
                     .least_items = 3,
                     .meaning = "corners [x, y] of a zone, in order"}),
          zone_kind({.key = "tool",
                     .kind = K::name,
                     .refers = {"tool"},
                     .meaning = "name of a tool, along whose tight radii the zone lies, seen from "
                                "above, with all where it is at the start"}),
          {.key = "blanks.NAME.zone[].below_radius",
           .unit = "mm",
           .otherwise = "twice the tool's tightest rounding, or a tenth of its diagonal if that is "
                        "more",
           .ranges = {length_range},
           .meaning = "largest outward radius of the tool that counts"},
          {.key = "blanks.NAME.zone[].distance",
           .unit = "mm",
           .otherwise = "twice the tool's radius there, at least two elements",
           .ranges = {length_range},
           .meaning = "distance to which the zone reaches from the tool's tight radii, in plan"}};
}

} // namespace

Rows blank_rows() {
  Rows rows{
      {.key = "blanks", .kind = K::map, .meaning = "blanks, each under a name of your choice"},
      {.key = "blanks.NAME", .kind = K::table, .meaning = "outline and mesh of an unformed ply"},
      {.key = "blanks.NAME.mesh",
       .kind = K::choice,
       .fallback = "\"diagonal\"",
       .choices = words_of(mesh_choices),
       .meaning = "kind of mesh: squares with one diagonal (all the same way, or alternating) or "
                  "with both, cells along both fibre "
                  "directions, free triangles, or triangles from a file",
       .members = {to(&BlankSpec::mesh, mesh_choices)}},
      outline({.key = "size",
               .kind = K::numbers,
               .unit = "mm",
               .ranges = {length_range},
               .usual = {{.least = 5.0, .most = 20000.0}},
               .count = 2,
               .meaning = "side lengths of a rectangular blank, along x and y"}),
      of_outline({.key = "corner_radius",
                  .unit = "mm",
                  .fallback = "0.0",
                  .ranges = {length_or_zero},
                  .meaning = "rounding of the corners of a rectangular blank (size)"}),
      outline({.key = "radius",
               .unit = "mm",
               .ranges = {length_range},
               .usual = {{.least = 2.5, .most = 10000.0}},
               .meaning = "radius of a round blank"}),
      outline({.key = "outline",
               .kind = K::profile,
               .unit = "mm",
               .ranges = {place_range, place_range, length_or_zero},
               .least_items = 3,
               .meaning = "corners [x, y] of the blank, in order; a third number rounds the "
                          "corner; a table is an arc from the corner before"})};
  append_arcs(rows, "blanks.NAME.outline[]");
  rows.push_back(outline({.key = "outline_file",
                          .kind = K::path,
                          .meaning = "drawing of the blank, with holes (ASCII "
                                     "DXF)"}));
  append(rows, drawing_rows());
  append(rows, {of_outline({.key = "holes",
                            .kind = K::outlines,
                            .unit = "mm",
                            .otherwise = "none",
                            .ranges = {place_range, place_range, length_or_zero},
                            .least_items = 3,
                            .meaning = "holes, each as an outline or as a circle, a table"}),
                {.key = "blanks.NAME.holes[].centre",
                 .kind = K::numbers,
                 .unit = "mm",
                 .ranges = {place_range},
                 .count = 2,
                 .meaning = "centre [x, y] of a round hole"},
                {.key = "blanks.NAME.holes[].radius",
                 .unit = "mm",
                 .ranges = {length_range},
                 .meaning = "radius of a round hole"}});
  append_arcs(rows, "blanks.NAME.holes[][]");
  append(rows, {of_outline({.key = "centre",
                            .kind = K::numbers,
                            .unit = "mm",
                            .fallback = "[0.0, 0.0]",
                            .ranges = {place_range},
                            .count = 2,
                            .meaning = "place of the centre of rectangle or circle; of [0, 0] of "
                                       "outline, drawing and holes"}),
                of_outline({.key = "element_size",
                            .unit = "mm",
                            .ranges = {length_range},
                            .meaning = "side of a square or cell, mean edge of a free mesh",
                            .members = {to(&BlankSpec::element_size)}}),
                of_outline({.key = "mesh_from",
                            .kind = K::text,
                            .fallback = "\"element_size\"",
                            .meaning = "what makes elements smaller beside zones: \"scene\", where "
                                       "tools are round and shear bends sharply, found by a fast "
                                       "run with coarse elements; or the folder of a run whose "
                                       "sizes are taken; \"element_size\": nothing"}),
                {.key = "blanks.NAME.file",
                 .kind = K::path,
                 .of = "mesh",
                 .with = {"file"},
                 .meaning = "mesh file of the flat blank (STL, OBJ, PLY or OFF, in mm, z "
                            "constant)"}});
  append(rows, zone_rows());
  return rows;
}

} // namespace plyform
