// SPDX-License-Identifier: GPL-3.0-or-later
// Keys of [[tool]]: shapes, places and motions.
#include "core/input/choices.hpp"
#include "core/input/schema_case.hpp"

namespace plyform {

using K = KeyKind;

Rows tool_rows() {
  const auto radial = [](const char* name, std::vector<std::string> shapes, Range range,
                         const char* meaning) {
    return KeyRow{.key = std::string("tool[].") + name,
                  .unit = "mm",
                  .ranges = {range},
                  .of = "shape",
                  .with = std::move(shapes),
                  .meaning = meaning};
  };
  Rows rows{
      {.key = "tool", .kind = K::tables, .fallback = "[]", .meaning = "tools, one [[tool]] each"},
      {.key = "tool[].name", .kind = K::name, .meaning = "tool's name, unlike all others"},
      {.key = "tool[].shape",
       .kind = K::choice,
       .choices = {"sphere", "cylinder", "box", "plane", "disc", "annulus", "profile", "mesh"},
       .meaning = "shape; its own frame has the axis as z; cylinder and box are centred on the "
                  "position, disc and annulus stand on it, a plane has its material below it"},
      radial("radius", {"sphere", "cylinder", "disc"}, positive, "radius"),
      radial("length", {"cylinder"}, positive, "length along the axis"),
      {.key = "tool[].size",
       .kind = K::numbers,
       .unit = "mm",
       .ranges = {positive},
       .count = 3,
       .of = "shape",
       .with = {"box"},
       .meaning = "full edge lengths"},
      radial("inner_radius", {"annulus"}, not_negative, "radius of the hole"),
      radial("outer_radius", {"annulus"}, positive, "outer radius"),
      radial("thickness", {"disc", "annulus"}, positive, "thickness along the axis"),
      radial("edge_radius", {"cylinder", "box", "disc", "annulus"}, not_negative,
             "rounding of all edges; the outer dimensions stay"),
      {.key = "tool[].points",
       .kind = K::profile,
       .unit = "mm",
       .ranges = {not_negative, {}, not_negative},
       .least_items = 2,
       .of = "shape",
       .with = {"profile"},
       .meaning = "points [r, z] of the section, turned about the axis; material to the right in "
                  "walking order; a third number rounds the corner; a table is an arc from the "
                  "point before"},
      {.key = "tool[].points[].to",
       .kind = K::numbers,
       .unit = "mm",
       .ranges = {not_negative, {}},
       .count = 2,
       .meaning = "end [r, z] of the arc"},
      {.key = "tool[].points[].centre",
       .kind = K::numbers,
       .unit = "mm",
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
       .ranges = {positive},
       .of = "shape",
       .with = {"mesh"},
       .meaning = "mm per unit of the mesh file"}};
  for (KeyRow& row : rows)
    if (row.key == "tool[].edge_radius") row.fallback = "0.0";
  return rows;
}

Rows motion_rows() {
  const std::vector<std::string> moving{"driven", "force"};
  return {{.key = "tool[].position",
           .kind = K::numbers,
           .unit = "mm",
           .fallback = "[0.0, 0.0, 0.0]",
           .count = 3,
           .meaning = "place of the tool's origin"},
          {.key = "tool[].axis",
           .kind = K::numbers,
           .fallback = "[0.0, 0.0, 1.0]",
           .count = 3,
           .meaning = "direction of the tool's own z, of any length; the tool is turned there "
                      "the shortest way (from z to -z about x)"},
          {.key = "tool[].turn",
           .unit = "deg",
           .fallback = "0.0",
           .ranges = {{.least = -360.0, .most = 360.0}},
           .meaning = "turn about the tool's own z, before z is brought to the axis"},
          {.key = "tool[].motion",
           .kind = K::choice,
           .fallback = "\"fixed\"",
           .choices = words_of(motion_choices),
           .meaning = "motion: none, a given stroke, or under a given force"},
          {.key = "tool[].direction",
           .kind = K::numbers,
           .fallback = "[0.0, 0.0, -1.0]",
           .count = 3,
           .of = "motion",
           .with = moving,
           .meaning = "direction of stroke or force, of any length"},
          {.key = "tool[].stroke",
           .unit = "mm",
           .ranges = {positive},
           .of = "motion",
           .with = {"driven"},
           .meaning = "stroke along the direction, over the duration"},
          {.key = "tool[].force",
           .unit = "N",
           .ranges = {not_negative},
           .of = "motion",
           .with = {"force"},
           .meaning = "force on the tool along the direction"},
          {.key = "tool[].mass",
           .unit = "kg",
           .fallback = "0.0",
           .ranges = {not_negative},
           .of = "motion",
           .with = {"force"},
           .meaning = "mass of the tool; 0 keeps it in equilibrium with its force at every step"}};
}

} // namespace plyform
