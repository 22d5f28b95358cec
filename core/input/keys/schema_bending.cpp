// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of the table of keys: compression and bending of yarns.
#include "core/input/keys/key_member.hpp"
#include "core/input/keys/schema_case.hpp"
#include "core/input/keys/sheet_laws.hpp"

namespace plyform {

Rows yarn_bending_rows(const std::string& table, const std::string& yarn) {
  const std::string bending = "none of a ply alone, in a stack an estimate for yarns that bear "
                              "compression: a bending length of 70 mm";
  return {{.key = table + ".compression_stiffness",
           .unit = "N/yarn",
           .otherwise = "0 of a ply alone, in a stack an estimate: 0.01 of the stiffness",
           .ranges = {yarn_force_range},
           .meaning = "compressive force of one yarn divided by its shortening, at most its "
                      "stiffness in tension; 0: yarns carry tension only, and nothing is "
                      "estimated. A yarn that bends needs it. solver.fibre_softening leaves it as "
                      "it is, and softens tension no further than that",
           .members = {to(&TensionLaw::compression)}},
          {.key = table + ".buckling_force",
           .unit = "N/yarn",
           .otherwise = "yarns do not buckle",
           .ranges = {yarn_force_range},
           .meaning = "compressive force of one yarn above which it gives way: shortening further "
                      "it takes 0.01 of its compression stiffness",
           .members = {to(&TensionLaw::buckling_force)}},
          {.key = table + ".bending_stiffness",
           .unit = "N mm",
           .otherwise = bending,
           .instead = {"bending_table"},
           .ranges = {bending_range},
           .usual = {range_of(usual_bending_stiffness)},
           .meaning = "moment per width divided by curvature along the " + yarn + " (N mm2/mm)",
           .members = {to(&MomentLaw::stiffness)}},
          {.key = table + ".bending_table",
           .kind = KeyKind::pairs,
           .unit = "1/mm, N",
           .otherwise = bending,
           .instead = {"bending_stiffness"},
           .ranges = {{.least = 0.0, .most = 1e3}, bending_range},
           .least_items = 2,
           .meaning = "[curvature along the " + yarn +
                      ", moment per width], ascending from [0, 0]; the same with minus sign for "
                      "negative curvatures"},
          {.key = table + ".bending_viscosity",
           .unit = "N mm s",
           .fallback = "0.0",
           .ranges = {bending_range},
           .meaning = "moment per width along the " + yarn +
                      " by the rate of curvature of the process, beside bending_stiffness or "
                      "bending_table",
           .members = {to(&YarnFamily::bending_viscosity)}},
          {.key = table + ".in_plane_bending_stiffness",
           .unit = "N mm",
           .otherwise = "0 of a ply alone, in a stack an estimate for yarns that bear "
                        "compression: zones of 2.5 cells of the weave",
           .ranges = {bending_range},
           .meaning = "moment per width divided by the curvature of the " + yarn +
                      " within the cloth's surface (N mm2/mm): what makes the zones between "
                      "regions of different shear as wide as they are",
           .members = {to(&YarnFamily::in_plane_bending)}}};
}

Rows sheet_rows() {
  return {{.key = "fabrics.NAME.locking_angle",
           .unit = "deg",
           .otherwise = "not known",
           .ranges = {{.least = 0.0, .most = 90.0, .open_least = true}},
           .of = "law",
           .with = {"woven", families_word},
           .meaning = "shear angle beyond which the fabric wrinkles; results say where it is "
                      "exceeded, forces do not depend on it",
           .members = {to(&Fabric::locking_angle)}},
          {.key = "fabrics.NAME.twist_stiffness",
           .unit = "N mm",
           .otherwise = "root of the product of the bending stiffnesses along both axes (at small "
                        "curvature); 0 of fabrics of three families and more, which resist twist "
                        "by bending",
           .ranges = {bending_range},
           .of = "law",
           .with = {"woven", families_word},
           .meaning = "sum of the twisting moments per width on both cuts, over the twist of the "
                      "surface between warp and weft (2 (1 - nu) D of an isotropic plate); "
                      "with 0 a ply bends freely to a saddle, and a strip cut at 45 degrees hangs "
                      "limp"}};
}

} // namespace plyform
