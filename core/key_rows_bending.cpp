// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of the table of keys: what yarns answer to compression and bending.
#include "core/key_rows.hpp"

namespace plyform {

Rows yarn_bending_rows(const std::string& yarn) {
  const std::string table = "fabrics.NAME." + yarn;
  return {{.key = table + ".compression_stiffness",
           .unit = "N/yarn",
           .fallback = "0.0",
           .ranges = {not_negative},
           .meaning = "compressive force of one yarn divided by its shortening, at most its "
                      "stiffness in tension; 0: yarns carry tension only. A yarn that bends needs "
                      "it, 0.01 of the stiffness will do. solver.fibre_softening leaves it as it "
                      "is, but for what is more than the softened stiffness"},
          {.key = table + ".bending_stiffness",
           .unit = "N mm",
           .otherwise = "no bending",
           .instead = "bending_table",
           .ranges = {not_negative},
           .meaning = "moment per width divided by curvature along the " + yarn + " (N mm2/mm)"},
          {.key = table + ".bending_table",
           .kind = KeyKind::pairs,
           .unit = "1/mm, N",
           .otherwise = "no bending",
           .instead = "bending_stiffness",
           .ranges = {not_negative, not_negative},
           .least_items = 2,
           .meaning = "[curvature along the " + yarn +
                      ", moment per width], ascending from [0, 0]; the same with minus sign for "
                      "negative curvatures"}};
}

Rows twist_rows() {
  return {{.key = "fabrics.NAME.twist_stiffness",
           .unit = "N mm",
           .otherwise = "root of the product of both bending stiffnesses (at small curvature)",
           .ranges = {not_negative},
           .of = "law",
           .with = {"woven"},
           .meaning = "sum of the twisting moments per width on both cuts, over the twist of the "
                      "surface between warp and weft (2 (1 - nu) D of an isotropic plate); "
                      "with 0 a ply bends freely to a saddle, and a strip cut at 45 degrees hangs "
                      "limp"}};
}

} // namespace plyform
