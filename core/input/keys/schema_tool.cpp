// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of the table of keys: position and motion of [[tool]]; those of shapes are in
// tool_shapes.cpp.
#include "core/input/keys/key_member.hpp"
#include "core/input/keys/schema_case.hpp"

namespace plyform {

using K = KeyKind;

Rows tool_rows() {
  return {
      {.key = "tool", .kind = K::tables, .fallback = "[]", .meaning = "tools, one [[tool]] each"},
      {.key = "tool[].name",
       .kind = K::name,
       .meaning = "tool's name, unlike all others",
       .members = {to(&Tool::name)}}};
}

Rows motion_rows() {
  const std::vector<std::string> moving{"driven", "force"};
  return {{.key = "tool[].position",
           .kind = K::numbers,
           .unit = "mm",
           .fallback = "[0.0, 0.0, 0.0]",
           .ranges = {place_range},
           .count = 3,
           .meaning = "place of the tool's origin",
           .members = {to(&Tool::position)}},
          {.key = "tool[].axis",
           .kind = K::numbers,
           .fallback = "[0.0, 0.0, 1.0]",
           .ranges = {direction_range},
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
           .meaning = "motion: none, a given stroke, or under a given force",
           .members = {to(&Tool::motion, motion_choices)}},
          {.key = "tool[].direction",
           .kind = K::numbers,
           .fallback = "[0.0, 0.0, -1.0]",
           .ranges = {direction_range},
           .count = 3,
           .of = "motion",
           .with = moving,
           .meaning = "direction of stroke or force, of any length"},
          {.key = "tool[].stroke",
           .unit = "mm",
           .instead = {"stroke_programme"},
           .ranges = {length_range},
           .usual = {{.least = 0.01, .most = 5000.0}},
           .of = "motion",
           .with = {"driven"},
           .meaning = "stroke along the direction, over the duration",
           .members = {to(&Tool::stroke)}},
          {.key = "tool[].stroke_programme",
           .kind = K::pairs,
           .unit = "-, mm",
           .instead = {"stroke"},
           .ranges = {programme_share, {.least = 0.0, .most = length_range.most}},
           .least_items = 1,
           .of = "motion",
           .with = {"driven"},
           .meaning = "stages [share of the duration, stroke reached by then], from rest to rest"},
          {.key = "tool[].force",
           .unit = "N",
           .instead = {"force_programme"},
           .ranges = {force_range},
           .usual = {{.least = 0.0, .most = 1e6}},
           .of = "motion",
           .with = {"force"},
           .meaning = "force on the tool along the direction",
           .members = {to(&Tool::force)}},
          {.key = "tool[].force_programme",
           .kind = K::pairs,
           .unit = "-, N",
           .instead = {"force"},
           .ranges = {programme_share, force_range},
           .least_items = 1,
           .of = "motion",
           .with = {"force"},
           .meaning = "stages [share of the duration, force reached by then]"},
          {.key = "tool[].mass",
           .unit = "kg",
           .fallback = "0.0",
           .ranges = {{.least = 0.0, .most = 1e6}},
           .usual = {{.least = 0.0, .most = 5000.0}},
           .of = "motion",
           .with = {"force"},
           .meaning = "mass of the tool; 0 keeps it in equilibrium with its force at every step",
           .members = {to(&Tool::mass)}}};
}

} // namespace plyform
