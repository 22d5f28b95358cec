// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of the table of keys: fabrics.NAME and fabric files; those of bending are in
// schema_bending.cpp.
#include "core/input/keys/compaction_keys.hpp"
#include "core/input/keys/key_member.hpp"
#include "core/input/keys/schema_case.hpp"
#include "core/input/keys/sheet_laws.hpp"
#include "core/input/keys/stitch_keys.hpp"
#include "core/input/keys/temperature_keys.hpp"
#include "core/input/keys/viscous_keys.hpp"

namespace plyform {

using K = KeyKind;

namespace {

/// Keys of a family of yarns in a table; it is called `yarn` in their meanings: "warp".
Rows yarn_rows(const std::string& table, const std::string& yarn) {
  Rows rows{{.key = table + ".density",
             .unit = "yarns/mm",
             .ranges = {{.least = 1e-4, .most = 1e3}},
             .usual = {{.least = 0.02, .most = 20.0}},
             .meaning = "number of " + yarn + " yarns per mm across them",
             .members = {to(&YarnFamily::density)}},
            {.key = table + ".stiffness",
             .unit = "N/yarn",
             .instead = {"table"},
             .ranges = {stiffness_range},
             .usual = {range_of(usual_stiffness)},
             .meaning = "tension of one yarn divided by its strain",
             .members = {to(&TensionLaw::stiffness)}},
            {.key = table + ".table",
             .kind = K::pairs,
             .unit = "-, N/yarn",
             .instead = {"stiffness"},
             .ranges = {{.least = 0.0, .most = 10.0}, yarn_force_range},
             .least_items = 2,
             .meaning = "[strain, tension] of one yarn, ascending from [0, 0]"},
            {.key = table + ".relaxation",
             .kind = K::pairs,
             .unit = "N/yarn, s",
             .otherwise = "none: tension does not depend on time",
             .ranges = {stiffness_range, {.least = 1e-6, .most = 1e9}},
             .usual = {range_of(usual_stiffness), {.least = 1e-3, .most = 1e6}},
             .least_items = 1,
             .most_items = 1,
             .meaning =
                 "[[k, theta]] of a Maxwell branch beside both, of yarns that creep: tension "
                 "by strain at once, and the time of the process in which it relaxes"}};
  append(rows, yarn_bending_rows(table, yarn));
  append(rows, {{.key = table + ".opening_limit",
                 .otherwise = "not known",
                 .ranges = {{.least = 0.0, .most = 10.0, .open_least = true}},
                 .usual = {{.least = 0.005, .most = 1.0}},
                 .meaning = "change of the distance between neighbouring yarns, over what it was, "
                            "beyond which they gape: results have a column for it, and say where "
                            "it is exceeded",
                 .members = {to(&YarnFamily::opening_limit)}}});
  return rows;
}

Rows shear_rows(const std::string& table) {
  Rows rows{{.key = table + ".polynomial",
             .kind = K::numbers,
             .unit = "N mm",
             .instead = {"table"},
             .ranges = {{.least = -1e9, .most = 1e9}},
             .least_items = 1,
             .meaning = "coefficients k1, k3, k5 ... of the torque of one unit cell, "
                        "k1 g + k3 g^3 + k5 g^5 ..., g the shear angle in rad"},
            {.key = table + ".negative_polynomial",
             .kind = K::numbers,
             .unit = "N mm",
             .otherwise = "that of polynomial",
             .ranges = {{.least = -1e9, .most = 1e9}},
             .least_items = 1,
             .meaning = "coefficients beside polynomial for negative shear angles, where the angle "
                        "between the families opens: k1 |g| + k3 |g|^3 ..., against them"},
            {.key = table + ".table",
             .kind = K::pairs,
             .unit = "deg, N mm",
             .instead = {"polynomial"},
             .ranges = {{.least = -90.0, .most = 90.0, .open_least = true, .open_most = true},
                        {.least = -1e9, .most = 1e9}},
             .least_items = 2,
             .meaning =
                 "[shear angle, torque of one unit cell], a smooth monotone curve through "
                 "these points; ascending from [0, 0], the same with minus sign for negative "
                 "angles, or from a negative angle through [0, 0], the law of both signs"}};
  append(rows, viscous_shear_rows(table));
  return rows;
}

/// Keys of the crimp of two families; `families` in their order: "warp and weft".
Rows crimp_rows(const std::string& table, const std::string& families) {
  return {{.key = table,
           .kind = K::table,
           .otherwise = "none: yarns lie straight",
           .of = table == "fabrics.NAME.crimp" ? "law" : "",
           .with = table == "fabrics.NAME.crimp" ? std::vector<std::string>{"woven"}
                                                 : std::vector<std::string>{},
           .meaning = "crimp of the yarns: pulling one family straightens it and lifts the other; "
                      "stiffness or table of the yarns is then that of the straight yarn"},
          {.key = table + ".ratio",
           .kind = K::numbers,
           .ranges = {{.least = 0.0, .most = 0.2}},
           .count = 2,
           .meaning =
               "crimp: length of a yarn over the distance that it spans, less 1, of " + families},
          {.key = table + ".height",
           .kind = K::numbers,
           .unit = "mm",
           .otherwise = "those of a plain weave",
           .ranges = {length_or_zero},
           .count = 2,
           .meaning = "height of a yarn's wave, from its axis where it is lowest to where it is "
                      "highest, of " +
                      families + "; greater than in a plain weave where yarns float over several"}};
}

/// Keys of a fabric by its families.
Rows family_rows() {
  Rows rows{{.key = "fabrics.NAME.family",
             .kind = K::tables,
             .fallback = "[]",
             .most_items = most_families,
             .of = "law",
             .with = {families_word},
             .meaning = "families of parallel yarns, one [[family]] each; "
                        "none of a foil"},
            {.key = "fabrics.NAME.family[].name",
             .kind = K::name,
             .meaning = "name in columns of results: NAME_strain",
             .members = {to(&YarnFamily::name)}},
            {.key = "fabrics.NAME.family[].angle",
             .unit = "deg",
             .ranges = {{.least = -180.0, .most = 180.0}},
             .meaning = "angle from the ply's angle to the yarns, before forming",
             .members = {to(&YarnFamily::angle)}}};
  append(rows, yarn_rows("fabrics.NAME.family[]", "family"));
  append(rows, {{.key = "fabrics.NAME.crossing",
                 .kind = K::tables,
                 .fallback = "[]",
                 .most_items = most_crossings,
                 .of = "law",
                 .with = {families_word},
                 .meaning = "two families that resist shear, one [[crossing]] each"},
                {.key = "fabrics.NAME.crossing[].families",
                 .kind = K::names,
                 .refers = {"fabrics.NAME.family"},
                 .count = 2,
                 .meaning = "names of the two families"}});
  append(rows, shear_rows("fabrics.NAME.crossing[]"));
  append(rows, crimp_rows("fabrics.NAME.crossing[].crimp", "its two families"));
  append(rows, sheet_beside_rows());
  return rows;
}

} // namespace

Rows fabric_rows() {
  Rows rows{
      {.key = "fabrics", .kind = K::map, .meaning = "fabrics, each under a name of your choice"},
      {.key = "fabrics.NAME", .kind = K::fabric, .meaning = "fabric file, or its keys in a table"},
      {.key = "fabrics.NAME.name",
       .kind = K::text,
       .otherwise = "the NAME",
       .meaning = "fabric's name in results",
       .members = {to(&Fabric::name)}},
      {.key = "fabrics.NAME.surface_density",
       .unit = "g/m2",
       .ranges = {{.least = 1e-3, .most = 1e6}},
       .usual = {{.least = 20.0, .most = 5000.0}},
       .meaning = "mass per area of the unformed fabric",
       .members = {to(&Fabric::surface_density)}},
      {.key = "fabrics.NAME.thickness",
       .unit = "mm",
       .ranges = {{.least = 1e-4, .most = 100.0}},
       .usual = {{.least = 0.02, .most = 20.0}},
       .meaning = "thickness of the unformed fabric",
       .members = {to(&Fabric::thickness)}},
      {.key = "fabrics.NAME.fibre_angle",
       .unit = "deg",
       .fallback = "90.0",
       .ranges = {{.least = 0.0, .most = 180.0, .open_least = true, .open_most = true}},
       .of = "law",
       .with = {"woven"},
       .meaning = "angle from warp to weft before forming"},
      {.key = "fabrics.NAME.law",
       .kind = K::choice,
       .fallback = "\"woven\"",
       .implied_by = {"family", "sheet"},
       .implied = "\"families\"",
       .choices = fabric_laws(),
       .meaning = "kind of sheet: yarns in two directions, warp and weft; any number of families "
                  "of yarns; or a foil without"}};
  append(rows, sheet_law_rows());
  for (const std::string yarn : {"warp", "weft"}) {
    const std::string table = "fabrics.NAME." + yarn;
    append(rows, {{.key = table,
                   .kind = K::table,
                   .of = "law",
                   .with = {"woven"},
                   .meaning = yarn + " yarns"}});
    append(rows, yarn_rows(table, yarn));
  }
  append(rows, {{.key = "fabrics.NAME.shear",
                 .kind = K::table,
                 .of = "law",
                 .with = {"woven"},
                 .meaning = "law of in-plane shear"}});
  append(rows, shear_rows("fabrics.NAME.shear"));
  append(rows, crimp_rows("fabrics.NAME.crimp", "warp and weft"));
  append(rows, family_rows());
  append(rows, stitch_rows());
  append(rows, heat_capacity_rows());
  append(rows, fabric_temperature_rows());
  append(rows, compaction_rows());
  append(rows, sheet_rows());
  return rows;
}

} // namespace plyform
