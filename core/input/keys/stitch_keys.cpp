// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/keys/stitch_keys.hpp"

#include "core/input/keys/key_member.hpp"
#include "core/input/keys/sheet_laws.hpp"

namespace plyform {

namespace {

using K = KeyKind;

const Range angle_range{.least = -180.0, .most = 180.0};

/// Of one stitch.
Rows law_rows(const std::string& table) {
  return {{.key = table + ".stiffness",
           .unit = "N",
           .instead = {"table"},
           .ranges = {stiffness_range},
           .usual = {{.least = 0.1, .most = 1e4}},
           .meaning = "force of one stitch divided by the strain of the sheet along it, beyond "
                      "where it is taut; solver.fibre_softening leaves it as it is",
           .members = {to(&TensionLaw::stiffness)}},
          {.key = table + ".table",
           .kind = K::pairs,
           .unit = "-, N",
           .instead = {"stiffness"},
           .ranges = {{.least = 0.0, .most = 10.0}, yarn_force_range},
           .least_items = 2,
           .meaning =
               "[strain of the sheet along it beyond where it is taut, force of one stitch], "
               "ascending from [0, 0]"},
          {.key = table + ".slack",
           .otherwise = "taut from the start, without force",
           .instead = {"pretension"},
           .ranges = {{.least = 0.0, .most = 10.0}},
           .usual = {{.least = 0.0, .most = 0.5}},
           .meaning = "strain of the sheet along it at which it becomes taut",
           .members = {to(&StitchLaw::taut_at)}},
          {.key = table + ".pretension",
           .unit = "N",
           .otherwise = "taut from the start, without force",
           .instead = {"slack"},
           .ranges = {yarn_force_range},
           .usual = {{.least = 0.0, .most = 20.0}},
           .meaning = "force of one stitch in the unformed fabric"},
          {.key = table + ".breaking_force",
           .unit = "N",
           .otherwise = "never breaks",
           .ranges = {{.least = 0.0, .most = 1e9, .open_least = true}},
           .usual = {{.least = 0.1, .most = 200.0}},
           .meaning = "force of one stitch above which it breaks, for good",
           .members = {to(&StitchLaw::breaking_force)}}};
}

} // namespace

Rows stitch_rows() {
  const std::string table = "fabrics.NAME.stitch[]";
  Rows rows{
      {.key = "fabrics.NAME.stitch",
       .kind = K::tables,
       .fallback = "[]",
       .most_items = most_families,
       .of = "law",
       .with = {"woven", families_word},
       .meaning = "stitches that hold the yarns together, one [[stitch]] for each seam; they "
                  "bear tension alone and move with the sheet"},
      {.key = table + ".name",
       .kind = K::name,
       .otherwise = "stitch, then stitch_2, stitch_3 ...",
       .meaning = "name in columns of results: NAME_strain, NAME_broken; of a zigzag NAME_1 "
                  "and NAME_2"},
      {.key = table + ".pattern",
       .kind = K::choice,
       .fallback = "\"pillar\"",
       .choices = {"pillar", "chain", "tricot"},
       .meaning = "one direction (pillar, chain), or the two of a zigzag (tricot)"},
      {.key = table + ".direction",
       .unit = "deg",
       .ranges = {angle_range},
       .of = "pattern",
       .with = {"pillar", "chain"},
       .meaning = "angle from the ply's angle to the seam, before forming"},
      {.key = table + ".directions",
       .kind = K::numbers,
       .unit = "deg",
       .ranges = {angle_range},
       .count = 2,
       .of = "pattern",
       .with = {"tricot"},
       .meaning = "angles from the ply's angle to the two legs of the zigzag, before forming"},
      {.key = table + ".density",
       .unit = "stitches/mm",
       .ranges = {{.least = 1e-4, .most = 1e3}},
       .usual = {{.least = 0.02, .most = 5.0}},
       .meaning = "number of stitches per mm across them: of seams, or of each leg of a "
                  "zigzag"}};
  append(rows, law_rows(table));
  return rows;
}

} // namespace plyform
