// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of the table of keys: [[boundary]], and its grips, frames and planes of symmetry.
#include "core/input/keys/boundary_kinds.hpp"
#include "core/input/keys/key_member.hpp"
#include "core/input/keys/schema_case.hpp"

namespace plyform {

namespace {

using K = KeyKind;

/// Row of a list of `count` points that some kinds of boundaries have.
KeyRow points(const char* name, std::vector<std::string> kinds, std::size_t count,
              const char* meaning) {
  return {.key = std::string("boundary[].") + name,
          .kind = K::pairs,
          .unit = "mm",
          .ranges = {place_range},
          .least_items = count,
          .of = "kind",
          .with = std::move(kinds),
          .meaning = meaning};
}

} // namespace

Rows boundary_rows() {
  const std::vector<std::string> placed{"grip", "spring", "gripper"};
  const std::vector<std::string> moved{"grip", "frame", "gripper"};
  Rows rows{
      {.key = "boundary",
       .kind = K::tables,
       .fallback = "[]",
       .meaning = "boundaries, one [[boundary]] each: nodes whose motion is given, or that springs "
                  "and grippers pull"},
      {.key = "boundary[].name",
       .kind = K::name,
       .meaning = "boundary's name, unlike those of plies, tools and other boundaries",
       .members = {to(&Boundary::name)}},
      {.key = "boundary[].kind",
       .kind = K::choice,
       .choices = boundary_words(),
       .meaning = "kind of boundary: a rigid grip that moves (or stays) as one piece; four "
                  "hinged bars pulled along a diagonal; a vertical plane of symmetry; a "
                  "tension spring to an anchor; a gripper pulled by a force or a drive"},
      {.key = "boundary[].ply",
       .kind = K::text,
       .otherwise = "all plies",
       .refers = {"ply"},
       .meaning = "name of the one ply that is held"},
      points("box", placed, 2,
             "two corners [x, y] of a rectangle; it holds all nodes of the unformed ply "
             "inside and on its rim"),
      points("edge", placed, 2, "two ends [x, y] of a line; it holds all nodes on it"),
      points("hinges", {"frame"}, 4,
             "four hinges [x, y] in order, a parallelogram; the first stays, the third moves "
             "away from it; the bars hold all nodes on them"),
      {.key = "boundary[].hold",
       .kind = K::choice,
       .fallback = "\"xyz\"",
       .choices = {"xyz", "xy", "xz", "yz", "x", "y", "z"},
       .of = "kind",
       .with = {"grip"},
       .meaning = "directions in which the nodes are held; they are free in the others"},
      {.key = "boundary[].direction",
       .kind = K::numbers,
       .fallback = "[1.0, 0.0, 0.0]",
       .ranges = {direction_range},
       .count = 3,
       .of = "kind",
       .with = {"grip", "gripper"},
       .meaning = "direction of stroke, pull and measured force, of any length"},
      {.key = "boundary[].stroke",
       .unit = "mm",
       .otherwise = "0",
       .instead = {"stroke_programme"},
       .ranges = {stroke_or_zero},
       .of = "kind",
       .with = moved,
       .meaning = "stroke over the duration; of a grip and of a gripper's drive along the "
                  "direction, of a frame along the diagonal from the first hinge to the third",
       .members = {to(&Grip::stroke), to(&HingedFrame::stroke), to(&Gripper::stroke)}},
      {.key = "boundary[].stroke_programme",
       .kind = K::pairs,
       .unit = "-, mm",
       .otherwise = "as stroke says",
       .instead = {"stroke"},
       .ranges = {programme_share, stroke_or_zero},
       .least_items = 1,
       .of = "kind",
       .with = moved,
       .meaning = "stages [share of the duration, stroke reached by then], from rest to rest"},
      {.key = "boundary[].point",
       .kind = K::numbers,
       .unit = "mm",
       .fallback = "[0.0, 0.0]",
       .ranges = {place_range},
       .count = 2,
       .of = "kind",
       .with = {"symmetry"},
       .meaning = "point [x, y] on the plane"},
      {.key = "boundary[].normal",
       .kind = K::numbers,
       .ranges = {direction_range},
       .count = 2,
       .of = "kind",
       .with = {"symmetry"},
       .meaning = "direction [x, y] at right angles to the plane, of any length"}};
  for (KeyRow& row : rows) {
    if (row.key == "boundary[].box") row.instead = {"edge"};
    if (row.key == "boundary[].edge") row.instead = {"box"};
  }
  return rows;
}

} // namespace plyform
